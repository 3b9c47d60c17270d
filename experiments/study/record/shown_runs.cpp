// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/shown_runs.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace polhode::study::inline record {
namespace {

/// The number of the motion of each run, in the order of their first runs. `count`: receives the number of motions.
/// `largest`: that of the runs of the motion that has most. Takes 8 bytes a run.
std::vector<std::uint32_t> numbers_of_motions(std::span<const std::uint64_t> runs, std::size_t& count,
                                              std::size_t& largest) {
  std::vector<std::uint32_t> sorted(runs.size());
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::sort(sorted.begin(), sorted.end(),
            [&](std::uint32_t a, std::uint32_t b) { return runs[a] != runs[b] ? runs[a] < runs[b] : a < b; });
  std::vector<std::uint32_t> motions(runs.size());  // first the first run of the same motion, then its number
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto end = std::find_if(first, sorted.end(), [&](std::uint32_t run) { return runs[run] != runs[*first]; });
    for (auto run = first; run != end; ++run) motions[*run] = *first;
    largest = std::max(largest, static_cast<std::size_t>(end - first));
    first = end;
  }
  for (std::uint32_t run = 0; run < motions.size(); ++run)
    motions[run] = motions[run] == run ? static_cast<std::uint32_t>(count++) : motions[motions[run]];
  return motions;
}

}  // namespace

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
  std::size_t count = 0, largest = 0;
  const std::vector<std::uint32_t> motions = numbers_of_motions(runs, count, largest);
  std::vector<bool> chosen(count);
  for (const std::size_t i : evenly_spread(count, std::max<std::size_t>(most / largest, 1))) chosen[i] = true;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (chosen[motions[i]]) shown.push_back(i);
  }
  std::vector<std::size_t> thinned;
  for (const std::size_t i : evenly_spread(shown.size(), most)) thinned.push_back(shown[i]);
  return thinned;
}

}  // namespace polhode::study::record
