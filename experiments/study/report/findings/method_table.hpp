// SPDX-License-Identifier: BSD-3-Clause
// Table with one row for each curve: declared properties of the method, and its behaviour as the step decreases.
#pragma once

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline report::inline findings {

/// Final energy of a run: "gains", "loses", "comes back" (the final drift is below a tenth of the largest) or
/// "round-off"; empty for a run that was not completed.
std::string energy_trend(const RunRecord& run);
/// The same for all runs of a curve: "gains or loses" if they differ; empty if none was completed.
std::string energy_trend(const Curve& curve);

Table method_table(const Grouping& grouping);

}  // namespace polhode::study::report::findings
