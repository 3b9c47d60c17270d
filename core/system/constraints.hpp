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
// The matrix is factorized by Cholesky: dense for few rows, sparse for many, so that a chain of n bodies costs O(n). If
// rows depend on each other, a rank-revealing factorization of G M^(−1/2) takes its place: accelerations are then those
// of the independent rows, and λ has the least norm.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/problem/joint.hpp"
#include "core/problem/problem.hpp"
#include "core/system/body_constants.hpp"
#include "core/system/formulation.hpp"

namespace polhode {

/// The rank of the constraint equations at one state.
struct ConstraintRank {
  std::size_t rows = 0, rank = 0;
  double condition = 1;                  ///< of the independent rows, scaled to unit length in the metric of the masses
  std::vector<std::string> dependent{};  ///< names of the joints with a row that depends on others
};

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

  /// Adds the reactions to the wrenches of the forces, at the motions of all bodies. Not reentrant: a system serves one
  /// run on one thread.
  void add_reactions(Motions motions, Wrenches wrenches) const;

  /// Power (W) of the last reactions on the bodies, λᵀ G v. It vanishes where G v = 0.
  S power() const;

  /// Reaction of a joint on its first body in the last add_reactions(): force (N), and torque (N m) about the anchor,
  /// world axes.
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

  /// The smallest displacement in the metric of the masses that satisfies the linearized position equations:
  /// ξ = −M⁻¹ Gᵀ (G M⁻¹ Gᵀ)⁻¹ g. Wrench::force holds the shift (m), Wrench::torque the rotation vector (rad) of each
  /// moving body, world axes. Returns the largest |g| before it, m or rad.
  S position_correction(Motions motions, Wrenches displacements) const;
  /// The smallest impulses (N s, N m s) in the metric of the masses after which G v = 0. Returns the largest |G v|
  /// before them, m/s or rad/s.
  S velocity_correction(Motions motions, Wrenches impulses) const;

  ConstraintRank rank(Motions motions) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace polhode
