// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/exact_motion.hpp"

#include <algorithm>

#include "core/exact/joined_motion.hpp"

namespace polhode::inline core::inline exact {
namespace {

bool has_joint(const Problem& problem, std::size_t body) {
  return std::any_of(problem.joints.begin(), problem.joints.end(), [&](const JointParameters& joint) {
    return std::find(joint.of.bodies.begin(), joint.of.bodies.end(), body) != joint.of.bodies.end();
  });
}

/// True if a joint ends in the world or on a static body.
bool held_by_the_world(const Problem& problem) {
  return std::any_of(problem.joints.begin(), problem.joints.end(), [&](const JointParameters& joint) {
    const auto& ends = joint.of.bodies;
    return ends.size() == 1 || problem.bodies[ends[0]].fixed || problem.bodies[ends[1]].fixed;
  });
}

bool torque_free(const System<double>& system, std::size_t body) {
  return std::none_of(system.forces().begin(), system.forces().end(),
                      [&](const auto& force) { return force->effect_on(body).torque; });
}

}  // namespace

ExactMotion::ExactMotion(const System<double>& system) {
  const Problem& problem = system.problem();
  double fastest = 0;
  bool all_paths = true;
  for (std::size_t i = 0; i < system.moving(); ++i) {
    if (has_joint(problem, i)) {
      JoinedMotion joined = joined_motion(system, i);
      rotations_.push_back(std::move(joined.rotation));
      paths_.push_back(std::move(joined.path));
    } else {
      rotations_.push_back(exact_rotation(system, i));
      paths_.push_back(exact_path(system, i));
    }
    has_angular_velocity_ = has_angular_velocity_ && rotations_[i];
    has_attitude_ = has_attitude_ && rotations_[i] && rotations_[i](0).orientation;
    fastest = std::max(fastest, problem.starts[i].angular_velocity.norm());
    if (problem.bodies[i].pinned) continue;
    any_path_ = true;
    all_paths = all_paths && paths_[i];
  }
  has_position_ = any_path_ && all_paths;
  if (fastest > 0) speed_scale_ = fastest;
}

ExactMotion::BodyAt ExactMotion::at(double t, std::size_t body) const {
  BodyAt known;
  known.path = path_at(t, body);
  if (rotations_[body]) known.rotation = rotations_[body](t);
  return known;
}

std::optional<PathAt> ExactMotion::path_at(double t, std::size_t body) const {
  return paths_[body] ? std::optional(paths_[body](t)) : std::nullopt;
}

VectorX<double> ExactMotion::state(const System<double>& system, const State<double>& near) const {
  VectorX<double> y = near.y;
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const Body& body = system.problem().bodies[i];
    const RotationAt exact = rotations_[i](near.t);
    const BodySnapshot<double> now = system.snapshot(y, i);
    const Vector3<double> turn =
        rotation_vector<double>(product<double>(*exact.orientation, conjugate<double>(now.orientation)));
    Vector3<double> shift = Vector3<double>::Zero(), change = shift;
    if (!body.pinned) {
      const PathAt path = paths_[i](near.t);
      shift = path.position - now.position;
      change = body.mass * (path.velocity - now.velocity);
    }
    system.displace(y, i, shift, turn);
    const BodySnapshot<double> turned = system.snapshot(y, i);
    const Matrix3<double> inertia = turned.rotation * system.inverse_inertia(i).inverse() * turned.rotation.transpose();
    system.apply_impulse(y, i, change, inertia * (exact.angular_velocity - turned.angular_velocity));
  }
  return y;
}

ExactMotion::BodyError ExactMotion::error(double t, std::size_t body, const BodySnapshot<double>& now) const {
  BodyError one;
  if (has_angular_velocity_) {
    const RotationAt exact = rotations_[body](t);
    if (has_attitude_) one.error.attitude = angle_between(now.orientation, *exact.orientation);
    one.error.angular_velocity = (now.angular_velocity - exact.angular_velocity).norm() / speed_scale_;
    one.angular_velocity_body = exact.angular_velocity_body;
  }
  if (has_position_ && paths_[body]) one.error.position = (now.position - paths_[body](t).position).norm();
  return one;
}

void ExactMotion::Error::raise(const Error& other) {
  const auto keep = [](std::optional<double>& worst, const std::optional<double>& now) {
    if (now && !(worst && *now <= *worst)) worst = now;
  };
  keep(position, other.position);
  keep(attitude, other.attitude);
  keep(angular_velocity, other.angular_velocity);
}

ExactMotion::Error ExactMotion::error(const System<double>& system, const State<double>& state) const {
  Error worst;
  for (std::size_t i = 0; i < system.moving(); ++i) {
    worst.raise(error(state.t, i, system.snapshot(state.y, i)).error);
  }
  return worst;
}

ConservedMomenta conserved_momenta(const System<double>& system) {
  const auto& forces = system.forces();
  const bool internal = std::all_of(forces.begin(), forces.end(), [](const auto& f) { return f->internal(); });
  bool any_pinned = false;
  for (std::size_t i = 0; i < system.moving(); ++i) any_pinned = any_pinned || system.problem().bodies[i].pinned;
  ConservedMomenta conserved;
  if (held_by_the_world(system.problem())) return conserved;
  conserved.linear = internal && !any_pinned;
  if (system.moving() == 1) {
    conserved.angular = torque_free(system, 0);
  } else {
    conserved.angular = internal && !any_pinned;
  }
  return conserved;
}

}  // namespace polhode::core::exact
