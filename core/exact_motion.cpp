// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact_motion.hpp"

#include <algorithm>

namespace polhode {
namespace {

bool torque_free(const System<double>& system, std::size_t body) {
  return std::none_of(system.forces().begin(), system.forces().end(),
                      [&](const auto& force) { return force->effect_on(body).torque; });
}

/// The constant force on a body in N, or nothing if a force on it varies.
std::optional<Vector3<double>> constant_force(const System<double>& system, std::size_t body) {
  Vector3<double> total = Vector3<double>::Zero();
  for (const auto& force : system.forces()) {
    const auto f = force->effect_on(body).constant_force;
    if (!f) return std::nullopt;
    total += *f;
  }
  return total;
}

}  // namespace

ExactMotion::ExactMotion(const System<double>& system) {
  const Problem& problem = system.problem();
  for (std::size_t i = 0; i < system.moving(); ++i) has_attitude_ = has_attitude_ && torque_free(system, i);
  double fastest = 0;
  bool all_paths = true;
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const Body& body = problem.bodies[i];
    const BodyStart& start = problem.starts[i];
    if (has_attitude_) {
      const Quaternion<double> q = start.orientation / start.orientation.norm();
      const Vector3<double> w = start.angular_velocity_in_body
                                    ? start.angular_velocity
                                    : Vector3<double>(rotation_matrix(q).transpose() * start.angular_velocity);
      tops_.emplace_back(body.inertia, q, w);
    }
    fastest = std::max(fastest, start.angular_velocity.norm());
    if (body.pinned) {
      paths_.emplace_back();
      continue;
    }
    const auto force = constant_force(system, i);
    all_paths = all_paths && force.has_value();
    has_position_ = true;
    if (force) paths_.push_back(Path{start.position, start.velocity, *force / body.mass});
    else paths_.emplace_back();
  }
  has_position_ = has_position_ && all_paths;
  if (fastest > 0) speed_scale_ = fastest;
}

ExactMotion::Error ExactMotion::error(const System<double>& system, const State<double>& state) const {
  Error error;
  const auto raise = [](std::optional<double>& worst, double e) {
    if (!worst || !(e <= *worst)) worst = e;
  };
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const BodySnapshot<double> now = system.snapshot(state.y, i);
    if (has_attitude_) {
      const FreeTop::Motion exact = tops_[i].at(state.t);
      raise(error.attitude, angle_between(now.orientation, exact.orientation));
      const Vector3<double> w = rotation_matrix(exact.orientation) * exact.angular_velocity_body;
      raise(error.angular_velocity, (now.angular_velocity - w).norm() / speed_scale_);
    }
    if (has_position_ && paths_[i]) {
      const Path& path = *paths_[i];
      const Vector3<double> p = path.position + state.t * (path.velocity + 0.5 * state.t * path.acceleration);
      raise(error.position, (now.position - p).norm());
    }
  }
  return error;
}

ConservedMomenta conserved_momenta(const System<double>& system) {
  const auto& forces = system.forces();
  const bool internal = std::all_of(forces.begin(), forces.end(), [](const auto& f) { return f->internal(); });
  bool any_pinned = false;
  for (std::size_t i = 0; i < system.moving(); ++i) any_pinned = any_pinned || system.problem().bodies[i].pinned;
  ConservedMomenta conserved;
  conserved.linear = internal && !any_pinned;
  if (system.moving() == 1) {
    conserved.angular = torque_free(system, 0);
  } else {
    conserved.angular = internal && !any_pinned;
  }
  return conserved;
}

}  // namespace polhode
