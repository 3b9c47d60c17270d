// SPDX-License-Identifier: BSD-3-Clause
// The joints of a system: their equations, the reactions that satisfy them, and corrections of drifted states.
//
// With the masses M, the rows G of all joints, the free accelerations a (those without joints) and the prescribed
// accelerations b, the multipliers solve
//   G M⁻¹ Gᵀ λ = b − G a,   b = γ − 2α G v − β² g,
// which is the index-1 form of the constrained equations of motion. α = β = 0 without stabilization; else the method is
// Baumgarte's. Sources: Hairer & Wanner, Solving Ordinary Differential Equations II, section VII.1; Baumgarte, Comput.
// Methods Appl. Mech. Eng. 1 (1972).
//
// With a penalty a the multipliers are λ = −a (G v̇ − b), which makes the matrix G M⁻¹ Gᵀ + 1/a: no rank is needed. The
// augmented Lagrangian method iterates λ ← λ − a (G v̇(λ) − b) until G v̇ = b. Source: Bayo, García de Jalón & Serna,
// Comput. Methods Appl. Mech. Eng. 71 (1988).
//
// A method that solves for the multipliers itself prescribes them instead (PrescribedMultipliers).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/problem/joint.hpp"
#include "core/problem/problem.hpp"
#include "core/system/formulation.hpp"

namespace polhode::inline core::inline system {

template <class S>
class ConstraintSolver;

/// The rank of the constraint equations at one state.
struct ConstraintRank {
  std::size_t rows = 0, rank = 0;
  double condition = 1;  ///< condition of the independent rows, scaled to unit length in the mass metric
  std::vector<std::string> dependent{};  ///< names of the joints with a row that depends on others
};

/// Functions of one state evaluate the joints first and refer to the last evaluation. Not reentrant: a system serves
/// one run on one thread. Twists and displacements (v, ω) of the moving bodies are kept as wrenches: the linear part
/// (m/s, m) as `force`, the angular part (rad/s, rad) as `torque`. All vectors are in world axes.
template <class S>
class Constraints {
 public:
  using Motions = std::span<const BodyMotion<S>>;
  using Wrenches = std::span<Wrench<S>>;

  Constraints(const Problem& problem, const Formulation& formulation);
  ~Constraints();

  std::size_t count() const;  ///< number of joints
  std::size_t rows() const;   ///< number of equations
  bool dependent() const;     ///< equations depend on each other at the start
  const JointModel<S>& joint(std::size_t i) const;
  const std::string& name(std::size_t i) const;

  /// Adds the reactions to the wrenches of the forces, at the motions of all bodies.
  void add_reactions(Motions motions, Wrenches wrenches) const;

  /// Number of linear systems solved since construction.
  std::int64_t solved() const;

  /// λ of the last add_reactions(), in the order of the rows: N or N m.
  const VectorX<S>& multipliers() const;
  /// G v in the last add_reactions(), m/s or rad/s.
  const VectorX<S>& rates() const;
  /// Power (W) of the last reactions on the bodies, λᵀ G v. It vanishes where G v = 0.
  S power() const;
  /// Power (W) of the same reactions at other velocities of the same configuration.
  S power_at(Motions motions) const;

  /// Reaction of a joint on its first body in the last add_reactions(): force (N), and torque (N m) about the anchor.
  Wrench<S> reaction(std::size_t joint, Motions motions) const;

  /// True if a joint has equations between angles.
  bool has_angles(std::size_t joint) const;

  /// The largest |g| and |G v| of a joint.
  struct Violation {
    double position = 0;  ///< m
    double angle = 0;     ///< rad
    double velocity = 0;  ///< m/s
    double rate = 0;      ///< rad/s
  };
  Violation violation(std::size_t joint, Motions motions) const;

  /// The smallest displacement, in the metric of the formulation, that satisfies the linearized position equations: of
  /// the masses, ξ = −M⁻¹ Gᵀ (G M⁻¹ Gᵀ)⁻¹ g, or with 1 in place of M. Returns the largest |g| before it, m or rad.
  S position_correction(Motions motions, Wrenches displacements) const;
  /// The impulses (N s, N m s) of the smallest change of velocities, in the same metric, after which G v = 0. Returns
  /// the largest |G v| before them, m/s or rad/s.
  S velocity_correction(Motions motions, Wrenches impulses) const;

  ConstraintRank rank(Motions motions) const;

  // ---- for methods that solve the equations of the joints themselves ------------------------------------------------

  /// Evaluates all rows at the motions, which must live until the last call of a function below.
  void evaluate(Motions motions) const;
  const std::vector<ConstraintRow<S>>& equations() const;
  /// G u for a twist of each moving body.
  void multiply(std::span<const Wrench<S>> twists, VectorX<S>& product) const;
  /// Adds Gᵀ λ to the wrenches.
  void add_transposed(const VectorX<S>& lambda, Wrenches wrenches) const;
  /// M⁻¹ w of each moving body.
  void divide_by_masses(Wrenches wrenches) const;
  /// λ from G M⁻¹ Gᵀ λ = right.
  void solve(const VectorX<S>& right, VectorX<S>& lambda) const;
  /// The solver of these equations, for methods that treat them row by row or make them soft.
  ConstraintSolver<S>& solver() const;
  /// G v̇ − γ in the last add_reactions() with prescribed multipliers, m/s² or rad/s².
  VectorX<S> acceleration_defects() const;

 private:
  template <class T>
  friend class PrescribedMultipliers;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// While it lives, the reactions have these multipliers; they are not solved for.
template <class S>
class PrescribedMultipliers {
 public:
  PrescribedMultipliers(const Constraints<S>& constraints, const VectorX<S>& multipliers);
  ~PrescribedMultipliers();
  PrescribedMultipliers(const PrescribedMultipliers&) = delete;
  PrescribedMultipliers& operator=(const PrescribedMultipliers&) = delete;

 private:
  const Constraints<S>& constraints_;
};

}  // namespace polhode::core::system
