// SPDX-License-Identifier: BSD-3-Clause
// A formulation of the equations of motion: the variables for the orientation and the rotation of a body, and their
// differential equations.
#pragma once

#include <string_view>

namespace polhode {

/// Representation of the orientation (body to world): unit quaternion or rotation matrix.
enum class Orientation { quaternion, matrix };

/// Variable for the angular part of the velocity v.
enum class AngularState {
  velocity_world,  ///< ω in world axes, rad/s; used by both source documents
  velocity_body,   ///< Ω = Rᵀω in body axes, rad/s
  momentum_world   ///< L in world axes about the mass centre or the pivot, kg m²/s
};

/// Rotation matrix of a quaternion q that is not of unit length.
enum class RotationFrom {
  normalized,  ///< rotation of q/|q|
  stored       ///< formula 1 − 2(y² + z²) … applied to q without normalization
};

/// Names in options, tables and files.
constexpr std::string_view name(Orientation o) { return o == Orientation::quaternion ? "quaternion" : "matrix"; }
constexpr std::string_view name(AngularState a) {
  switch (a) {
    case AngularState::velocity_world: return "velocity_world";
    case AngularState::velocity_body: return "velocity_body";
    default: return "momentum_world";
  }
}
constexpr std::string_view name(RotationFrom r) { return r == RotationFrom::normalized ? "normalized" : "stored"; }

/// Choice of variables and equations.
struct Formulation {
  Orientation orientation = Orientation::quaternion;
  AngularState angular_state = AngularState::velocity_world;
  bool gyroscopic = true;  ///< include the term ω × Iω; both source documents omit it. momentum_world has no such term.
  RotationFrom rotation_from = RotationFrom::normalized;  ///< for quaternions only
};

}  // namespace polhode
