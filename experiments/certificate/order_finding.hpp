// SPDX-License-Identifier: BSD-3-Clause
// A ladder of errors as a line of a certificate.
#pragma once

#include <string>
#include <vector>

#include "experiments/certificate/finding.hpp"
#include "experiments/study/statistics/order_estimate.hpp"

namespace polhode::study::certificate {

/// Settings for the errors of one run after another; those of methods that choose their steps follow a line less
/// closely, so that the whole ladder counts.
OrderSettings order_settings(bool adaptive);

/// Against a step: the declared order (Declaration::exact_order: exact) to within 0.25, from both sides. Against a
/// tolerance: an error in proportion to it, the slope 1 to within 0.4.
Finding order_finding(std::string trait, bool adaptive, int declared, std::vector<LadderPoint> ladder,
                      OrderSettings settings);
inline Finding order_finding(std::string trait, bool adaptive, int declared, std::vector<LadderPoint> ladder) {
  return order_finding(std::move(trait), adaptive, declared, std::move(ladder), order_settings(adaptive));
}

}  // namespace polhode::study
