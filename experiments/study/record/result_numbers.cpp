// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/result_numbers.hpp"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/study/record/metric_table.hpp"

namespace polhode::study::inline record {
namespace {

/// Replaces −0 by 0. Returns false if x is not finite.
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

void settle(std::map<std::string, double>& numbers) {
  for (auto one = numbers.begin(); one != numbers.end();)
    one = settle(one->second) ? std::next(one) : numbers.erase(one);
}

}  // namespace

void keep_finite(RunResult& result) {
  for (const Metric& metric : metric_table()) {
    if (metric.may_be_infinite) continue;
    with_value(metric, result, []<class Value>(Value& value) {
      if constexpr (!std::is_same_v<Value, std::string> && !std::is_same_v<Value, std::int64_t>) settle(value);
    });
  }
  settle(result.further);
  keep_points(result.series, [](SeriesPoint& p) {
    return settle_all({&p.t, &p.energy_drift_rel, &p.linear_momentum_drift_rel, &p.angular_momentum_drift_rel,
                       &p.orientation_defect});
  });
  keep_points(result.attitude_errors, [](AttitudeError& e) { return settle_all({&e.t, &e.error_rad}); });
}

}  // namespace polhode::study::record
