// SPDX-License-Identifier: BSD-3-Clause
// A free body for tests of polhode errors.
#pragma once

#include "core/problem/problem.hpp"

namespace polhode::study {

/// One free body at the origin. moments: principal moments of inertia, kg m²; omega: ω at the start, body axes, rad/s.
inline Problem free_body(const Vector3<double>& moments, const Vector3<double>& omega) {
  Problem problem;
  problem.bodies.resize(1);
  problem.bodies[0].inertia = moments.asDiagonal();
  problem.starts.resize(1);
  problem.starts[0].angular_velocity = omega;
  problem.starts[0].angular_velocity_in_body = true;
  return problem;
}

}  // namespace polhode::study
