// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/exact_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/exact/lagrange_top.hpp"
#include "core/exact/linear_motion.hpp"
#include "core/math/directions.hpp"

namespace polhode::inline core::inline exact {
namespace {

/// A body in its initial state and the forces of the problem that exert a torque on it.
struct Torques {
  const Body& body;
  Quaternion<double> orientation;
  Vector3<double> omega_body;
  std::vector<const ForceParameters*> forces;
  bool all_known = true;  ///< false: some such force was added with add_force()

  Torques(const System<double>& system, std::size_t i) : body(system.problem().bodies[i]) {
    const Problem& problem = system.problem();
    const BodyStart& start = problem.starts[i];
    orientation = start.orientation / start.orientation.norm();
    omega_body = start_omega_body(start);
    for (std::size_t k = 0; k < system.forces().size(); ++k) {
      if (!system.forces()[k]->effect_on(i).torque) continue;
      if (k < problem.forces.size()) forces.push_back(&problem.forces[k]);
      else all_known = false;
    }
  }

  bool all_of(std::initializer_list<std::string_view> kinds) const {
    for (const ForceParameters* f : forces) {
      if (std::find(kinds.begin(), kinds.end(), f->kind) == kinds.end()) return false;
    }
    return true;
  }
};

template <class Top>
struct InWorld {
  Top top;

  RotationAt operator()(double t) const {
    const auto motion = top.at(t);
    return {motion.orientation, rotation_matrix(motion.orientation) * motion.angular_velocity_body,
            motion.angular_velocity_body};
  }
};

ExactRotation heavy_top(const Torques& at) {
  double mass = at.body.mass;
  Vector3<double> center = at.body.center_of_mass, gravity = Vector3<double>::Zero();
  if (at.all_of({"uniform_gravity"})) {
    for (const ForceParameters* f : at.forces) gravity += f->vector("acceleration");
  } else if (at.forces.size() == 1 && at.all_of({"constant_force"}) && at.forces[0]->text("frame") == "world") {
    mass = 1;
    center = at.forces[0]->vector("anchor_body");
    gravity = at.forces[0]->vector("force");
  } else {
    return {};
  }
  if (!LagrangeTop::applies(at.body.inertia, center, gravity, at.orientation, at.omega_body)) return {};
  return InWorld<LagrangeTop>{{mass, at.body.inertia, center, gravity, at.orientation, at.omega_body}};
}

bool isotropic(const Matrix3<double>& inertia) {
  constexpr double few_roundings = 8 * std::numeric_limits<double>::epsilon();
  const double mean = inertia.trace() / 3;
  return (inertia - mean * Matrix3<double>::Identity()).cwiseAbs().maxCoeff() <= few_roundings * mean;
}

ExactRotation about_an_axis(const Torques& at) {
  const Matrix3<double> r = rotation_matrix(at.orientation);
  Vector3<double> in_body = Vector3<double>::Zero(), torque_world = in_body;
  double drag = 0;
  for (const ForceParameters* f : at.forces) {
    if (f->kind == "drag") drag += f->number("angular");
    else if (f->text("frame") == "body") in_body += f->vector("torque");
    else torque_world += f->vector("torque");
  }
  const Vector3<double> torque = in_body + r.transpose() * torque_world;
  Vector3<double> axis = at.omega_body.isZero(0) ? torque : at.omega_body;
  if (axis.isZero(0)) axis = Vector3<double>::UnitX();
  axis.stableNormalize();
  const bool still = at.omega_body.isZero(0) && torque.isZero(0);
  const double moment = axis.dot(at.body.inertia * axis);
  constexpr double roundings = 4;
  const bool one_axis = is_parallel(in_body, axis, roundings) &&
                        is_parallel(r.transpose() * torque_world, axis, roundings) &&
                        (still || is_parallel(at.body.inertia * axis, axis, roundings));
  if (one_axis) {
    const LinearMotion motion(0, drag / moment);
    const double speed = axis.dot(at.omega_body), acceleration = axis.dot(torque) / moment;
    const Vector3<double> axis_world = r * axis;
    return [=, q = at.orientation](double t) -> RotationAt {
      const LinearMotion::Response response = motion.at(t);
      const double angle = speed * response.by_velocity + acceleration * response.by_acceleration;
      const double s = std::sin(angle / 2);
      const Quaternion<double> turn(std::cos(angle / 2), s * axis[0], s * axis[1], s * axis[2]);
      return {product(q, turn), (speed * response.rate_by_velocity + acceleration * response.by_velocity) * axis_world};
    };
  }
  if (isotropic(at.body.inertia) && in_body.isZero(0)) {
    const LinearMotion motion(0, drag / moment);
    return [=, omega = Vector3<double>(r * at.omega_body), a = Vector3<double>(torque_world / moment)](double t) {
      const LinearMotion::Response response = motion.at(t);
      return RotationAt{std::nullopt, response.rate_by_velocity * omega + response.by_velocity * a};
    };
  }
  return {};
}

}  // namespace

Vector3<double> start_omega_body(const BodyStart& start) {
  if (start.angular_velocity_in_body) return start.angular_velocity;
  const Quaternion<double> orientation = start.orientation / start.orientation.norm();
  return rotation_matrix(orientation).transpose() * start.angular_velocity;
}

ExactRotation exact_rotation(const System<double>& system, std::size_t body) {
  const Torques at(system, body);
  if (!at.all_known) return {};
  if (at.forces.empty()) return InWorld<FreeTop>{{at.body.inertia, at.orientation, at.omega_body}};
  if (at.all_of({"constant_torque", "drag"})) return about_an_axis(at);
  return heavy_top(at);
}

const FreeTop* free_top_of(const ExactRotation& rotation) {
  const auto* in_world = rotation.target<InWorld<FreeTop>>();
  return in_world ? &in_world->top : nullptr;
}

}  // namespace polhode::core::exact
