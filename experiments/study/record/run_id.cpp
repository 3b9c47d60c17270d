// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/run_id.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace polhode::study::inline record {

std::uint64_t number_of_id(const std::string& id) {
  std::uint64_t number = 0;
  const auto read = std::from_chars(id.data(), id.data() + id.size(), number, 16);
  if (id.size() != 16 || read.ec != std::errc() || read.ptr != id.data() + id.size()) {
    throw std::logic_error("\"" + id + "\" is not the id of a run");
  }
  return number;
}

std::string id_of_number(std::uint64_t number) { return fmt::format("{:016x}", number); }

}  // namespace polhode::study::record
