// SPDX-License-Identifier: BSD-3-Clause
// The port through which forces and torques enter: a ForceModel adds its wrench on the bodies that it acts on.
// Source: the engine slides, "Adding Forces and Torques": f = Σ f_i, τ = Σ τ_i, τ = (p_point − p) × f.
#pragma once

#include <optional>
#include <span>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline core::inline problem {

/// Position and motion of a body as forces read them, world axes. The reference point is the mass centre, or the pivot
/// of a pinned body.
template <class S>
struct BodyMotion {
  Vector3<S> position;          ///< position of the reference point, m
  Matrix3<S> rotation;          ///< body to world
  Vector3<S> velocity;          ///< velocity of the reference point, m/s
  Vector3<S> angular_velocity;  ///< angular velocity, rad/s

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

/// The effect of a force on the momenta of one body; it decides which momenta are conserved.
struct Effect {
  bool torque = false;  ///< it may exert a torque about the body's reference point
  /// Force on the body (N, world) if it is the same at all times and places; absent if it varies.
  std::optional<Vector3<double>> constant_force = Vector3<double>::Zero();
};

/// A force or torque generator. The spans hold the moving bodies in the scenario's order, then the static ones. A force
/// may have a potential in part: work counted in potential_energy() must not be counted in power() too.
template <class S>
class ForceModel {
 public:
  ForceModel() = default;
  ForceModel(const ForceModel&) = delete;
  ForceModel& operator=(const ForceModel&) = delete;
  virtual ~ForceModel() = default;

  virtual void add_wrench(S t, std::span<const BodyMotion<S>> bodies, std::span<Wrench<S>> wrenches) const = 0;

  /// Potential energy (J) of the part of the force that has a potential.
  virtual S potential_energy(std::span<const BodyMotion<S>>) const { return S(0); }

  /// True when power() is not identically zero.
  virtual bool does_work() const { return false; }

  /// Power (W) with which the part of the force without a potential does work on the bodies.
  virtual S power(S, std::span<const BodyMotion<S>>) const { return S(0); }

  /// True if the force acts between moving bodies in equal and opposite forces along the line between their points.
  /// Total linear momentum and angular momentum about the world's origin are then conserved.
  virtual bool internal() const { return false; }

  /// False if neither wrench nor energy depends on rotation or angular velocity of the bodies. BodyMotion may then
  /// leave them out, which saves a third of an RK4 step in body axes.
  virtual bool reads_rotation() const { return true; }

  /// False if the wrench does not depend on velocities; a kick then takes one evaluation.
  virtual bool reads_velocity() const { return true; }

  /// The effect of the force on one body, by index.
  virtual Effect effect_on(std::size_t body) const = 0;
};

}  // namespace polhode::core::problem
