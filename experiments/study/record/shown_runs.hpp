// SPDX-License-Identifier: BSD-3-Clause
// Choice of the runs of a large study that are shown one by one: as curves against time and as rows of tables.
// Statements and runs.csv always cover all runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace polhode::study::inline record {

/// Number of runs whose curves against time a study keeps if none is given.
inline constexpr std::size_t most_curves = 2000;
/// A study with more runs has rows of `rows_of_large_tables` runs in its tables, all others of all runs.
inline constexpr std::size_t most_table_rows = 10'000, rows_of_large_tables = 1000;

/// Indices of at most `most` runs, ascending; all if there are not more. `motions`: for each run a number that is the
/// same for runs of the same motion (a scenario with values of its varied keys). Whole motions are chosen, evenly
/// spread in the order of the runs, so that methods and steps can be compared on each. Only where a single motion has
/// more runs than that are runs of a motion left out.
std::vector<std::size_t> shown_runs(std::span<const std::uint64_t> motions, std::size_t most);

/// Indices of 0 … n−1, ascending, evenly spread, the ends among them; all if n is not larger than `wanted`.
std::vector<std::size_t> evenly_spread(std::size_t n, std::size_t wanted);

}  // namespace polhode::study::record
