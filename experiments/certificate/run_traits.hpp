// SPDX-License-Identifier: BSD-3-Clause
// Traits measured by the runs of a study: orders, from its ladders of steps, and drifts.
#pragma once

#include <vector>

#include "experiments/certificate/finding.hpp"
#include "experiments/certificate/test_case.hpp"
#include "experiments/study/curves/curves.hpp"

namespace polhode::study::certificate {

/// Findings on the traits order_free, order_forced, energy_free, energy_forced, angular_momentum and orientation, in
/// this order, which is that of trait_columns(). The order is measured on the curve of shortest duration, among those
/// with at least three steps, of each motion; drifts are measured on the motions of longest duration, at their largest
/// step. curves: curves of the subject on motions of the test cases.
std::vector<Finding> run_traits(const Subject& subject, const std::vector<const Curve*>& curves,
                                const std::vector<TestCase>& test_cases, const std::vector<Scenario>& scenarios);

}  // namespace polhode::study::certificate
