// SPDX-License-Identifier: BSD-3-Clause
// Lists, sorts, groups and exports runs.
#pragma once

#include <string>
#include <vector>

#include "experiments/results/options.hpp"
#include "experiments/study/plan/where.hpp"
#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/query/selection.hpp"

namespace polhode::study::results {

constexpr int damaged_runs = 1;  ///< exit status if damaged runs were left out

/// Writes the runs, or the groups, that the options choose. Returns the exit status. Throws InputError and WriteError.
int list_runs(const ResultStores& stores, const ResultsOptions& options);

/// The conditions of --where. Throws InputError.
std::vector<Where> conditions_of(const ResultsOptions& options);

/// Prints on stderr how many runs are damaged and left out, if any. Returns the exit status.
int say_damage(const Damage& damage);

}  // namespace polhode::study::results
