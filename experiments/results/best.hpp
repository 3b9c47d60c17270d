// SPDX-License-Identifier: BSD-3-Clause
// Which method reaches the least error for a cost, or the least cost for an error?
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/results/options.hpp"
#include "experiments/study/query/result_stores.hpp"

namespace polhode::study::results {

/// A run as a point of work against precision. Less is better in both.
struct WorkPoint {
  double cost = 0, error = 0;
};

/// Indices of the points that no other point beats: none has at most the same cost and error and less of one of them.
/// Ascending by cost; of equal points the first.
std::vector<std::size_t> pareto_front(const std::vector<WorkPoint>& points);

/// Prints the best run of each method on each motion, or with no bound the Pareto front of each method. Returns the
/// exit status. Throws InputError.
int list_best(const ResultStores& stores, const ResultsOptions& options);

}  // namespace polhode::study::results
