// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/result_numbers.hpp"

#include <cmath>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <vector>

namespace polhode::study {
namespace {

/// False where x is not finite; −0 becomes 0.
bool settle(double& x) {
  x += 0.0;
  return std::isfinite(x);
}

bool settle_all(std::initializer_list<double*> numbers) {
  bool finite = true;
  for (double* x : numbers) finite = settle(*x) && finite;
  return finite;
}

/// Keeps the points for which settled(point) is true.
template <class Point, class Settled>
void keep_points(std::vector<Point>& points, const Settled& settled) {
  auto end = points.begin();
  for (Point& point : points) {
    if (settled(point)) *end++ = point;
  }
  points.erase(end, points.end());
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
  keep_points(result.series, [](SeriesPoint& p) {
    return settle_all({&p.t, &p.energy_drift_rel, &p.linear_momentum_drift_rel, &p.angular_momentum_drift_rel,
                       &p.orientation_defect});
  });
  keep_points(result.attitude_errors, [](AttitudeError& e) { return settle_all({&e.t, &e.error_rad}); });
}

}  // namespace polhode::study
