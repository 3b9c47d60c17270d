// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/joined_motion.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/math/directions.hpp"

namespace polhode::inline core::inline exact {
namespace {

using Vector = Vector3<double>;
using Matrix = Matrix3<double>;

/// The only joint of the body, if it ends in the world or on a static body; else null.
const JointParameters* only_joint(const Problem& problem, std::size_t body) {
  const JointParameters* found = nullptr;
  for (const JointParameters& joint : problem.joints) {
    const auto& ends = joint.of.bodies;
    if (std::find(ends.begin(), ends.end(), body) == ends.end()) continue;
    const bool fixed = ends.size() == 1 || problem.bodies[ends[0]].fixed || problem.bodies[ends[1]].fixed;
    if (found || !fixed || ends[0] != body) return nullptr;
    found = &joint;
  }
  return found;
}

/// A body and its pivot.
struct Pinned {
  Problem problem;    ///< the body alone, pinned
  Vector pivot, arm;  ///< world, m; from the pivot to the mass centre, axes of the pinned body, m
};

/// The body pinned at a point of it, `from_center` (m, body axes) from its mass centre.
Pinned pinned_at(const Problem& all, std::size_t body, const Vector& from_center) {
  Pinned p;
  Body b = all.bodies[body];
  BodyStart start = all.starts[body];
  p.arm = -from_center;
  p.pivot = start.position + rotation_matrix<double>(start.orientation) * from_center;
  b.inertia += b.mass * (p.arm.squaredNorm() * Matrix::Identity() - p.arm * p.arm.transpose());
  b.pinned = true;
  b.center_of_mass = p.arm;
  start.position = p.pivot;
  p.problem.bodies = {b};
  p.problem.starts = {start};
  return p;
}

/// The mass centre as a point that an arm carries around the world: orientation identity at the start.
Pinned arm_around(const Problem& all, std::size_t body, const Vector& pivot) {
  Pinned p;
  const BodyStart& start = all.starts[body];
  Body b = all.bodies[body];
  p.arm = start.position - pivot;
  p.pivot = pivot;
  b.inertia = b.mass * p.arm.squaredNorm() * Matrix::Identity();
  b.pinned = true;
  b.center_of_mass = p.arm;
  BodyStart turned;
  turned.position = pivot;
  turned.angular_velocity = p.arm.cross(start.velocity) / p.arm.squaredNorm();
  p.problem.bodies = {b};
  p.problem.starts = {turned};
  return p;
}

ExactPath carried(const Pinned& pinned, const ExactRotation& rotation) {
  if (!rotation || !rotation(0).orientation) return {};
  return [=, arm = pinned.arm, pivot = pinned.pivot](double t) -> PathAt {
    const RotationAt now = rotation(t);
    const Vector r = rotation_matrix<double>(*now.orientation) * arm;
    return {pivot + r, now.angular_velocity.cross(r)};
  };
}

}  // namespace

JoinedMotion joined_motion(const System<double>& system, std::size_t body) {
  const Problem& problem = system.problem();
  const JointParameters* joint = only_joint(problem, body);
  if (!joint || problem.bodies[body].pinned || system.forces().size() != problem.forces.size()) return {};
  Vector gravity = Vector::Zero();
  for (std::size_t k = 0; k < problem.forces.size(); ++k) {
    const ForceParameters& f = problem.forces[k];
    if (std::find(f.bodies.begin(), f.bodies.end(), body) == f.bodies.end()) continue;
    if (f.kind != "uniform_gravity") return {};
    gravity += f.vector("acceleration");
  }
  const BodyStart& start = problem.starts[body];
  const Matrix r = rotation_matrix<double>(start.orientation);
  const Vector anchor = joint->of.vector("anchor_body");
  Pinned pinned;
  if (joint->of.kind == "ball" || joint->of.kind == "hinge") {
    pinned = pinned_at(problem, body, anchor);
  } else if (joint->of.kind == "distance" && anchor.isZero(0)) {
    Vector pivot = joint->of.vector("anchor_world");
    if (joint->of.bodies.size() == 2) {
      const BodyStart& other = problem.starts[joint->of.bodies[1]];
      pivot = other.position + rotation_matrix<double>(other.orientation) * joint->of.vector("anchor_body_2");
    }
    pinned = arm_around(problem, body, pivot);
  } else {
    return {};
  }
  if (joint->of.kind == "hinge") {
    constexpr double roundings = 16;
    const Vector axis = joint->of.vector("axis_body").normalized();
    const Matrix& inertia = pinned.problem.bodies[0].inertia;
    if (!is_parallel(inertia * axis, axis, roundings) || !is_perpendicular(r * axis, gravity, roundings) ||
        !is_perpendicular(axis, pinned.arm, roundings))
      return {};
  }
  if (!gravity.isZero(0)) pinned.problem.forces = {{"uniform_gravity", {0}, {{"acceleration", gravity}}}};
  const auto top = make_system<double>(pinned.problem, {});
  const ExactRotation rotation = exact_rotation(*top, 0);
  JoinedMotion motion{rotation, carried(pinned, rotation)};
  if (joint->of.kind == "distance") {  // gravity and the rod act at the mass centre
    Problem free;
    free.bodies = {problem.bodies[body]};
    free.starts = {start};
    motion.rotation = exact_rotation(*make_system<double>(free, {}), 0);
  }
  return motion;
}

}  // namespace polhode::core::exact
