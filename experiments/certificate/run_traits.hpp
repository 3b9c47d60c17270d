// SPDX-License-Identifier: BSD-3-Clause
// Traits that the runs of a study show: orders, by its ladders of steps, and drifts.
#pragma once

#include <vector>

#include "experiments/certificate/finding.hpp"
#include "experiments/certificate/stage.hpp"
#include "experiments/study/curves/curves.hpp"

namespace polhode::study {

/// Of each motion the shortest curve with three steps or more shows the order; the motions that last longest show the
/// drifts, at their largest step. `curves`: those of the subject, on motions of the stages. The findings are in the
/// order of trait_columns(): order_free, order_forced, energy_free, energy_forced, angular_momentum, orientation.
std::vector<Finding> run_traits(const Subject& subject, const std::vector<const report::Curve*>& curves,
                                const std::vector<Stage>& stages, const std::vector<Scenario>& scenarios);

}  // namespace polhode::study
