// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/drawing/view.hpp"

#include <cmath>
#include <numbers>

namespace polhode::study::inline report::inline drawing {

Vector3<double> gravity_of(const Problem& problem) {
  Vector3<double> sum = Vector3<double>::Zero();
  for (const ForceParameters& force : problem.forces) {
    if (force.kind == "uniform_gravity") sum += force.vector("acceleration");
  }
  return sum;
}

View::View(const Vector3<double>& up) {
  constexpr double degree = std::numbers::pi / 180, elevation = 22 * degree, azimuth = -62 * degree;
  const Vector3<double> u = up.normalized();
  // Horizontal axes: world axis x, or y where x is nearly vertical, and the one to the left of it.
  const Vector3<double> start = std::abs(u.x()) < 0.9 ? Vector3<double>::UnitX() : Vector3<double>::UnitY();
  const Vector3<double> e1 = (start - u.dot(start) * u).normalized(), e2 = u.cross(e1);
  toward_ = std::cos(elevation) * (std::cos(azimuth) * e1 + std::sin(azimuth) * e2) + std::sin(elevation) * u;
  right_ = u.cross(toward_).normalized();
  above_ = toward_.cross(right_);
}

}  // namespace polhode::study::report::drawing
