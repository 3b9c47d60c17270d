// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/result_numbers.hpp"

#include <cmath>
#include <iterator>

namespace polhode::study {
namespace {

/// False where x is not finite; −0 becomes 0.
bool settle(double& x) {
  x += 0.0;
  return std::isfinite(x);
}

void settle(std::optional<double>& x) {
  if (x && !settle(*x)) x.reset();
}

}  // namespace

void keep_finite(RunResult& result) {
  for (const auto member : run_members) settle(result.*member);
  for (const auto member : drift_members) settle(result.*member);
  for (const auto member : energy_members) settle(result.*member);
  for (const auto member : contact_members) settle(result.contact.*member);
  for (auto drift = result.invariant_drift_max_rel.begin(); drift != result.invariant_drift_max_rel.end();) {
    drift = settle(drift->second) ? std::next(drift) : result.invariant_drift_max_rel.erase(drift);
  }
  std::erase_if(result.series, [](SeriesPoint& p) {
    return !(settle(p.t) & settle(p.energy_drift_rel) & settle(p.linear_momentum_drift_rel) &
             settle(p.angular_momentum_drift_rel) & settle(p.orientation_defect));
  });
  std::erase_if(result.attitude_errors, [](AttitudeError& e) { return !(settle(e.t) & settle(e.error_rad)); });
}

}  // namespace polhode::study
