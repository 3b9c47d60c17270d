// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/shard.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include "experiments/study/text/input_error.hpp"

namespace polhode::study::inline plan {

Shard read_shard(const std::string& text, const std::string& label) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool slash = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  const auto count = slash ? std::from_chars(number.ptr + 1, end, shard.count) : number;
  if (!slash || count.ec != std::errc() || count.ptr != end) {
    throw InputError(fmt::format("{}: '{}' is no shard; give its number and the number of shards: 3/16", label, text));
  }
  if (shard.number < 1 || shard.number > shard.count || shard.count > most_shards) {
    throw InputError(fmt::format("{}: {}: the number must be from 1 to the number of shards, which is at most {}",
                                 label, text, most_shards));
  }
  return shard;
}

}  // namespace polhode::study::plan
