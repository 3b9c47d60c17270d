// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/shards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <numeric>
#include <queue>
#include <system_error>
#include <utility>

#include "experiments/study/text/input_error.hpp"

namespace polhode::study::inline plan {
namespace {

namespace fs = std::filesystem;

constexpr const char* folder_of_shards = "shards";

}  // namespace

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

std::vector<std::size_t> deal(const Plan& plan, std::size_t count) {
  std::vector<std::size_t> order(plan.runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const PlannedRun &one = plan.runs[a], &other = plan.runs[b];
    return one.cost != other.cost ? one.cost > other.cost : one.id < other.id;
  });
  using Load = std::pair<double, std::size_t>;  // cost, number of the shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::size_t number = 1; number <= count; ++number) loads.emplace(0.0, number);
  std::vector<std::size_t> numbers(plan.runs.size());
  for (const std::size_t i : order) {
    if (!plan.runs[i].refusal.empty()) continue;
    auto [cost, number] = loads.top();
    loads.pop();
    numbers[i] = number;
    loads.emplace(cost + plan.runs[i].cost, number);
  }
  return numbers;
}

fs::path shard_folder(const fs::path& study, const Shard& shard) {
  return study / folder_of_shards / fmt::format("{}_of_{}", shard.number, shard.count);
}

std::vector<fs::path> shard_folders(const fs::path& study) {
  std::vector<fs::path> folders;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(study / folder_of_shards, none)) {
    if (entry.is_directory(none)) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace polhode::study::plan
