// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/characteristic_rate.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::study::inline scenario {
namespace {

double inverse_mass(const Problem& problem, std::size_t body) {
  const Body& b = problem.bodies[body];
  return b.fixed || b.pinned ? 0 : 1 / b.mass;
}

double largest_moment(const Body& body) {
  return Eigen::SelfAdjointEigenSolver<Matrix3<double>>(body.inertia, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

double of_spring(const Problem& problem, const ForceParameters& force) {
  double inverse = 0;
  for (const std::size_t i : force.bodies) inverse += inverse_mass(problem, i);
  return std::sqrt(force.number("stiffness") * inverse);
}

double of_pendulums(const Problem& problem, const ForceParameters& force) {
  double largest = 0;
  for (const std::size_t i : force.bodies) {
    const Body& b = problem.bodies[i];
    if (!b.pinned) continue;
    const double torque = b.mass * force.vector("acceleration").norm() * b.center_of_mass.norm();
    largest = std::max(largest, std::sqrt(torque / largest_moment(b)));
  }
  return largest;
}

double of_pair(const Problem& problem, const ForceParameters& force) {
  const std::size_t a = force.bodies.front(), b = force.bodies.back();
  const double r = (problem.starts[a].position - problem.starts[b].position).norm();
  const double mass = problem.bodies[a].mass + problem.bodies[b].mass;
  return r > 0 ? std::sqrt(force.number("gravitational_constant") * mass / (r * r * r)) : 0;
}

}  // namespace

std::optional<double> characteristic_rate(const Problem& problem) {
  double rate = 0;
  for (std::size_t i = 0; i < problem.moving(); ++i) {
    rate = std::max(rate, problem.starts[i].angular_velocity.norm());
  }
  for (const ForceParameters& force : problem.forces) {
    if (force.kind == "spring") rate = std::max(rate, of_spring(problem, force));
    if (force.kind == "uniform_gravity") rate = std::max(rate, of_pendulums(problem, force));
    if (force.kind == "point_gravity") rate = std::max(rate, of_pair(problem, force));
  }
  if (!(rate > std::numeric_limits<double>::min())) return std::nullopt;
  return rate;
}

}  // namespace polhode::study::scenario
