// SPDX-License-Identifier: BSD-3-Clause
// Observed order of a ladder of errors as a line of a certificate.
#pragma once

#include <string>
#include <vector>

#include "experiments/certificate/finding.hpp"
#include "experiments/study/statistics/order_estimate.hpp"

namespace polhode::study::certificate {

/// Settings of the order estimate for errors of single runs. For adaptive methods, whose errors scatter more about a
/// line, the whole ladder is used.
OrderSettings order_settings(bool adaptive);

/// The finding on the order. A fixed-step method must have the declared order to within ±0.25
/// (Declaration::exact_order: the method is exact). The error of an adaptive method must be proportional to the
/// tolerance: slope 1 ± 0.4.
Finding order_finding(std::string trait, bool adaptive, int declared, std::vector<LadderPoint> ladder,
                      OrderSettings settings);
inline Finding order_finding(std::string trait, bool adaptive, int declared, std::vector<LadderPoint> ladder) {
  return order_finding(std::move(trait), adaptive, declared, std::move(ladder), order_settings(adaptive));
}

}  // namespace polhode::study::certificate
