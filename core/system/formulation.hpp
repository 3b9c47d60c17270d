// SPDX-License-Identifier: BSD-3-Clause
// A formulation of the equations of motion: the variables for the orientation and the rotation of a body, and their
// differential equations.
#pragma once

#include <string_view>

namespace polhode::inline core::inline system {

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

/// Correction of states that have drifted off the equations of the joints.
enum class Stabilization {
  none,
  baumgarte,            ///< g̈ + 2α ġ + β² g = 0 in place of g̈ = 0
  position,             ///< projection of the configuration onto g(q) = 0 after each step
  velocity,             ///< projection of the velocity onto G v = 0 after each step
  both,                 ///< projection of the configuration, then of the velocity
  penalty,              ///< Baumgarte's equation with multipliers −a (g̈ + 2α ġ + β² g), a the penalty
  augmented_lagrangian  ///< the same with iterations, after which λ changes no more
};

/// The metric in which a projection is orthogonal.
enum class ProjectionMetric {
  mass,  ///< metric of the kinetic energy
  unit   ///< 1 for each m and rad of the reference points and rotations
};

/// Method by which the equations of the joints are solved.
struct JointTreatment {
  Stabilization stabilization = Stabilization::none;
  double alpha = 0, beta = 0;  ///< coefficients of Baumgarte's equation, 1/s; 0 for projections
  double penalty = 0;          ///< a of penalty methods, in multiples of the mean mass of the bodies; 0 for the others
  ProjectionMetric metric = ProjectionMetric::mass;

  bool projects_position() const {
    return stabilization == Stabilization::position || stabilization == Stabilization::both;
  }
  bool projects_velocity() const {
    return stabilization == Stabilization::velocity || stabilization == Stabilization::both;
  }
  /// Baumgarte's equation takes the place of g̈ = 0.
  bool has_baumgarte_terms() const { return stabilization == Stabilization::baumgarte || is_soft(); }
  /// λ does not satisfy the equations, but is proportional to what is left of them.
  bool is_soft() const {
    return stabilization == Stabilization::penalty || stabilization == Stabilization::augmented_lagrangian;
  }
  bool projects() const { return projects_position() || projects_velocity(); }
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
constexpr std::string_view name(Stabilization s) {
  switch (s) {
    case Stabilization::none: return "none";
    case Stabilization::baumgarte: return "baumgarte";
    case Stabilization::position: return "position";
    case Stabilization::velocity: return "velocity";
    case Stabilization::both: return "both";
    case Stabilization::penalty: return "penalty";
    default: return "augmented_lagrangian";
  }
}
constexpr std::string_view name(ProjectionMetric m) { return m == ProjectionMetric::mass ? "mass" : "unit"; }
constexpr std::string_view name(RotationFrom r) { return r == RotationFrom::normalized ? "normalized" : "stored"; }

/// Choice of variables and equations.
struct Formulation {
  Orientation orientation = Orientation::quaternion;
  AngularState angular_state = AngularState::velocity_world;
  bool gyroscopic = true;  ///< include the term ω × Iω; both source documents omit it. momentum_world has no such term.
  RotationFrom rotation_from = RotationFrom::normalized;  ///< rotation matrix of a quaternion whose length is not 1
  JointTreatment joints{};                                ///< treatment of joints, if the problem has any
};

}  // namespace polhode::core::system
