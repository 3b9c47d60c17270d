// SPDX-License-Identifier: BSD-3-Clause
// The port through which forces and torques enter: a ForceModel adds its wrench on the bodies that it acts on.
// Source: the engine slides, "Adding Forces and Torques": f = Σ f_i, τ = Σ τ_i, τ = (p_point − p) × f.
#pragma once

#include <optional>
#include <span>

#include "core/math/linear_algebra.hpp"

namespace polhode {

/// A body as forces see it, all in world axes: the reference point is the mass centre, or the pivot when pinned.
template <class S>
struct BodyMotion {
  Vector3<S> position;          ///< m, of the reference point
  Matrix3<S> rotation;          ///< body to world
  Vector3<S> velocity;          ///< m/s, of the reference point
  Vector3<S> angular_velocity;  ///< rad/s

  Vector3<S> point(const Vector3<S>& body_point) const { return position + rotation * body_point; }
  Vector3<S> point_velocity(const Vector3<S>& world_point) const {
    return velocity + angular_velocity.cross(world_point - position);
  }
};

/// Force (N) and torque (N m) about the reference point, both in world axes: a body's two accumulators.
template <class S>
struct Wrench {
  Vector3<S> force = Vector3<S>::Zero();
  Vector3<S> torque = Vector3<S>::Zero();

  /// Force f at a point: f += f, τ += (p_point − p) × f.
  void add_at_point(const BodyMotion<S>& body, const Vector3<S>& world_point, const Vector3<S>& f) {
    force += f;
    torque += (world_point - body.position).cross(f);
  }
};

/// What a force can do to a momentum; decides which momenta a run may call invariants.
struct Effect {
  bool torque = false;  ///< it may exert a torque about the body's reference point
  /// N, world: the force on the body where it is the same at all times and places; absent where it varies.
  std::optional<Vector3<double>> constant_force = Vector3<double>::Zero();
};

/// A force or torque generator. The spans hold the moving bodies in the scenario's order, then the static ones.
/// A force is conservative in part or whole: what potential_energy covers must not be in power.
template <class S>
class ForceModel {
 public:
  ForceModel() = default;
  ForceModel(const ForceModel&) = delete;
  ForceModel& operator=(const ForceModel&) = delete;
  virtual ~ForceModel() = default;

  virtual void add_wrench(S t, std::span<const BodyMotion<S>> bodies, std::span<Wrench<S>> wrenches) const = 0;

  /// J; of the part of the force that has a potential.
  virtual S potential_energy(std::span<const BodyMotion<S>>) const { return S(0); }

  /// True when power() is not identically zero.
  virtual bool does_work() const { return false; }

  /// W; the rate at which the part without a potential does work on the bodies.
  virtual S power(S, std::span<const BodyMotion<S>>) const { return S(0); }

  /// True when it acts between moving bodies in equal and opposite forces along the line between their points, so
  /// that total linear momentum and angular momentum about the world's origin are conserved.
  virtual bool internal() const { return false; }

  /// False when neither wrench nor energy depends on rotation or angular velocity of the bodies: they may then be left
  /// out of the BodyMotions, which saves a third of an RK4 step in body axes.
  virtual bool reads_rotation() const { return true; }

  /// False when the wrench does not depend on velocities: a kick then takes one evaluation.
  virtual bool reads_velocity() const { return true; }

  /// What it does to the body of that index.
  virtual Effect effect_on(std::size_t body) const = 0;
};

}  // namespace polhode
