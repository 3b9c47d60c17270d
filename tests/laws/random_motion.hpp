// SPDX-License-Identifier: BSD-3-Clause
// Arbitrary states of a problem: on the manifold of orientations, and off it.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/problem/problem.hpp"
#include "core/system/system.hpp"

namespace polhode::laws {

/// Count of numbers in [−1, 1] that give the place and the motion of a body.
constexpr std::size_t numbers_per_body = 13;

inline std::vector<double> random_numbers(std::size_t count, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> numbers(count);
  for (double& x : numbers) x = uniform(generator);
  return numbers;
}

/// The problem with other starts: positions up to 0.2 m from where they were (so that no two bodies meet), any
/// orientation, velocities up to 2 m/s and angular velocities up to 3 rad/s an axis. Pivots and static bodies stay.
inline Problem moved(Problem p, const std::vector<double>& numbers) {
  for (std::size_t i = 0; i < p.moving(); ++i) {
    const double* u = numbers.data() + i * numbers_per_body;
    BodyStart& s = p.starts[i];
    if (!p.bodies[i].pinned) {
      s.position += 0.2 * Vector3<double>(u[0], u[1], u[2]);
      s.velocity = 2 * Vector3<double>(u[3], u[4], u[5]);
    }
    const Quaternion<double> q(u[6], u[7], u[8], u[9]);
    s.orientation = q.norm() > 1e-3 ? Quaternion<double>(q.normalized()) : identity_quaternion<double>();
    s.angular_velocity = 3 * Vector3<double>(u[10], u[11], u[12]);
    s.angular_velocity_in_body = false;
  }
  return p;
}
inline Problem moved(const Problem& p, std::uint32_t seed) {
  return moved(p, random_numbers(p.bodies.size() * numbers_per_body, seed));
}

/// The state with every number of every orientation moved by up to `distance`.
template <class S>
VectorX<S> off_manifold(const System<S>& system, VectorX<S> y, double distance, std::uint32_t seed) {
  const int chart = system.formulation().orientation == Orientation::quaternion ? 4 : 9;
  const std::vector<double> numbers = random_numbers(system.moving() * 9, seed);
  auto u = numbers.begin();
  for (const Layout::Slot& slot : system.layout().slots) {
    for (int k = 0; k < chart; ++k) y[slot.orientation + k] += S(distance * *u++);
  }
  return y;
}

}  // namespace polhode::laws
