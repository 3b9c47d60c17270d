// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/error_ladder.hpp"

#include <limits>

namespace polhode::study::report {

std::vector<LadderPoint> error_ladder(const Curve& curve, const Quantity& quantity) {
  std::vector<LadderPoint> points;
  for (const auto* run : curve.runs) {
    if (!completed(*run) && !ended_early(*run)) continue;  // refused
    points.push_back({abscissa(*run).value_or(0),
                      value(*run, quantity).value_or(std::numeric_limits<double>::quiet_NaN()),
                      round_off_level(*run, quantity)});
  }
  return points;
}

}  // namespace polhode::study::report
