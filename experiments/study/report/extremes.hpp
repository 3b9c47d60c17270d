// SPDX-License-Identifier: BSD-3-Clause
// Which method has the least and which the most of a quantity, at the largest and at the smallest step.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/report/curves.hpp"

namespace polhode::study::report {

/// A sentence for each end of the steps and of the tolerances, of each motion and formulation; where there are many of
/// those, sentences that count over them. Methods whose value is at round-off are named together.
std::vector<std::string> extremes(const Grouping& grouping, const Quantity& quantity);

/// Curves that are at round-off in every completed run, and those that are not; without the curves for which the
/// quantity is not defined.
struct RoundOff {
  std::vector<const Curve*> kept, not_kept;
};
RoundOff at_round_off(const Grouping& grouping, const Quantity& quantity);

/// Names of methods, each once: "rk4 and dmv"; with the variant where a method is among the curves in some variants only.
std::string method_names(const Grouping& grouping, const std::vector<const Curve*>& curves);

}  // namespace polhode::study::report
