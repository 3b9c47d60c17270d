// SPDX-License-Identifier: BSD-3-Clause
// The port of joints: a joint states the equations that two bodies, or a body and the world, satisfy.
//
// A joint between bodies 1 and 2 has the position equations g(q) = 0 and the velocity equations G v = 0, where
// v = (v₁, ω₁, v₂, ω₂) holds the velocities of the reference points and the angular velocities, all in world axes. For
// a holonomic joint G v = dg/dt. A differentiation gives G v̇ = γ with γ = −Ġ v. The joint exerts the wrench Gᵀλ, where
// the multipliers λ are solved for. Source: Hairer & Wanner, Solving Ordinary Differential Equations II, section VII.1.
#pragma once

#include <optional>
#include <span>

#include "core/problem/force.hpp"

namespace polhode::inline core::inline problem {

/// One equation of a joint at one instant.
template <class S>
struct ConstraintRow {
  S residual{};             ///< g, in m or rad; 0 if the equation is not holonomic
  bool holonomic = true;    ///< the velocity equation is the derivative of a position equation
  Wrench<S> first, second;  ///< row of G for each body; also the wrench on it for the multiplier λ = 1
  S gamma{};                ///< γ = −Ġ v, in m/s² or rad/s²
  bool angular = false;     ///< g is an angle (rad) or its sine, λ a torque (N m); else a length (m) and a force (N)
};

/// A joint between a body and the world or a second body. The spans hold the moving bodies in the scenario's order,
/// then the static ones.
template <class S>
class JointModel {
 public:
  JointModel() = default;
  JointModel(const JointModel&) = delete;
  JointModel& operator=(const JointModel&) = delete;
  virtual ~JointModel() = default;

  virtual std::size_t first() const = 0;
  /// Index of the second body. Absent: the world.
  virtual std::optional<std::size_t> second() const = 0;
  /// Number of equations.
  virtual std::size_t rows() const = 0;
  /// Fills rows() equations under the motions of the bodies.
  virtual void evaluate(std::span<const BodyMotion<S>> bodies, std::span<ConstraintRow<S>> rows) const = 0;
  /// Point of the first body at which the reaction is reported, world axes, m.
  virtual Vector3<S> anchor(std::span<const BodyMotion<S>> bodies) const = 0;
};

}  // namespace polhode::core::problem
