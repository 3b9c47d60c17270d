// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/shown_runs.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace polhode::study::inline record {

std::vector<std::size_t> evenly_spread(std::size_t n, std::size_t wanted) {
  std::vector<std::size_t> chosen(std::min(n, wanted));
  if (wanted >= n) {
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  } else if (wanted > 1) {
    for (std::size_t i = 0; i < wanted; ++i) chosen[i] = (i * (n - 1) + (wanted - 1) / 2) / (wanted - 1);
  }
  return chosen;
}

std::vector<std::size_t> shown_runs(std::span<const std::uint64_t> runs, std::size_t most) {
  if (runs.size() <= most) return evenly_spread(runs.size(), most);
  if (most == 0) return {};
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;  // numbers of the motions, in the order of their first runs
  std::vector<std::uint32_t> motions;                        // motions of the runs
  for (const std::uint64_t run : runs)
    motions.push_back(numbers.try_emplace(run, static_cast<std::uint32_t>(numbers.size())).first->second);
  std::vector<std::size_t> runs_of(numbers.size());
  for (const std::uint32_t motion : motions) ++runs_of[motion];

  const std::size_t largest = *std::max_element(runs_of.begin(), runs_of.end());
  std::vector<bool> chosen(numbers.size());
  for (const std::size_t i : evenly_spread(numbers.size(), std::max<std::size_t>(most / largest, 1))) chosen[i] = true;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (chosen[motions[i]]) shown.push_back(i);
  }
  std::vector<std::size_t> thinned;
  for (const std::size_t i : evenly_spread(shown.size(), most)) thinned.push_back(shown[i]);
  return thinned;
}

}  // namespace polhode::study::record
