// SPDX-License-Identifier: BSD-3-Clause
// Groups of runs with equal values in some columns, and a few numbers for each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/results/options.hpp"
#include "experiments/study/plan/where.hpp"
#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/query/run_columns.hpp"

namespace polhode::study::results {

/// A number that stands for many: "median".
enum class Measure { count, min, max, mean, median, sum };

/// The measure of the values. Equal values in any order give the same digits. Absent if there are none, except for
/// count. `values` is sorted afterwards.
std::optional<double> measured(Measure measure, std::vector<double>& values);

/// Order of rows of values, by their columns (compare() in selection.hpp). The rows are of one length.
struct RowLess {
  bool operator()(const std::vector<OptionValue>& a, const std::vector<OptionValue>& b) const;
};

/// Writes one row for each group, in the order of the groups' values or of --sort. Returns the exit status.
int list_groups(const ResultStores& stores, const RunColumns& columns, std::span<const Where> conditions,
                const ResultsOptions& options);

}  // namespace polhode::study::results
