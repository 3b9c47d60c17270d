// SPDX-License-Identifier: BSD-3-Clause
// One row for each curve: what a method does as its step shrinks, beside what it declares.
#pragma once

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline report::inline findings {

/// Where a run's energy ends: "gains", "loses", "comes back" (its final drift is below a tenth of the largest),
/// "round-off"; empty for a run that was not completed.
std::string energy_trend(const RunRecord& run);
/// The same for all runs of a curve: "gains or loses" where they differ; empty if none was completed.
std::string energy_trend(const Curve& curve);

Table method_table(const Grouping& grouping);

}  // namespace polhode::study::report
