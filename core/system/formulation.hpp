// SPDX-License-Identifier: BSD-3-Clause
// A formulation: which numbers stand for a body's orientation and rotation, and which equations move them.
#pragma once

#include <string_view>

namespace polhode {

/// The chart of SO(3) in which the orientation is stored, body to world.
enum class Orientation { quaternion, matrix };

/// The angular part of the velocity v.
enum class AngularState {
  velocity_world,  ///< ω in world axes, rad/s, as in both source documents
  velocity_body,   ///< Ω = Rᵀω in body axes, rad/s
  momentum_world   ///< L in world axes, kg m²/s, about the mass centre or the pivot
};

/// The rotation that a quaternion off the unit sphere stands for.
enum class RotationFrom {
  normalised,  ///< that of q/|q|
  stored       ///< the formula 1 − 2(y² + z²) … with q as it is
};

/// The names that options, tables and files use.
constexpr std::string_view name(Orientation o) { return o == Orientation::quaternion ? "quaternion" : "matrix"; }
constexpr std::string_view name(AngularState a) {
  switch (a) {
    case AngularState::velocity_world: return "velocity_world";
    case AngularState::velocity_body: return "velocity_body";
    default: return "momentum_world";
  }
}
constexpr std::string_view name(RotationFrom r) { return r == RotationFrom::normalised ? "normalised" : "stored"; }

struct Formulation {
  Orientation orientation = Orientation::quaternion;
  AngularState angular_state = AngularState::velocity_world;
  bool gyroscopic = true;  ///< the term ω × Iω; both source documents leave it out. momentum_world has no such term.
  RotationFrom rotation_from = RotationFrom::normalised;  ///< read by the quaternion chart only
};

}  // namespace polhode
