// SPDX-License-Identifier: BSD-3-Clause
// The exact torque-free motion of one rigid body, I ω̇ = (I ω) × ω and q̇ = ½ q (0, ω), by elliptic functions.
// Sources: Celledoni, Fassò, Säfström and Zanna, "The exact computation of the free rigid body motion and its use in
// splitting methods", SIAM J. Sci. Comput. 30 (2008) 2084–2112, for the angular velocity and the split of the attitude;
// Jacobi, J. reine angew. Math. 39 (1850) 293–350, for the attitude by theta functions.
#pragma once

#include <cmath>
#include <string_view>

#include "core/exact/motion_at.hpp"
#include "core/exact/varying_top.hpp"
#include "core/math/linear_algebra.hpp"
#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline exact {

/// With principal moments A, B, C (B the intermediate one; A the one about whose axis the momentum y = I ω goes round
/// in the body), senses of the axes such that y_A > 0 and y_C ≥ 0 at t = 0, Δ_j = |y|² − 2T I_j and G = |y|:
///   y = (Y_A dn u, Y_B sn u, Y_C cn u),  u = u0 + λt,  λ = sgn(B − A) √(|Δ_C| |B − A| / ABC),
///   Y_A² = A|Δ_C|/|C − A|, Y_B² = B|Δ_A|/|B − A|, Y_C² = C|Δ_A|/|C − A|, m_c = |Δ_B| |C − A| / (|Δ_C| |B − A|).
/// The attitude is q(t) = left · Rot(e_A, ψ(t)) · P(t) · body_to_frame, where P is the least rotation that takes y to
/// e_A and ψ̇ = (2T + G y_A/A)/(G + y_A), which integrates to ψ = ℓt + 2 arg θ(u) + const (ThetaDirection) with
/// tan am(β | m_c) = √(C|B − A| / (A|C − B|)). Nothing is singular: the separatrix is m_c = 0, and symmetric bodies and
/// spins about a stable axis are m = 0. Where ω is constant, q(t) = q(0) exp(½ ω t).
class FreeTop {
 public:
  /// inertia_body: symmetric positive definite, any axes, kg m², about the fixed point or the mass centre; orientation:
  /// body to world at t = 0, used as given (its length stays); angular_velocity_body: rad/s, body axes, at t = 0.
  /// The numbers are taken as exact, so that a motion near the separatrix is that of these very doubles; a component of
  /// the angular velocity along a principal axis below 1e-120 of its length counts as zero (below 1e-30 when
  /// inertia_body is not diagonal). Costs 1 µs, or 6 µs when inertia_body is not diagonal. Throws std::invalid_argument
  /// on a matrix that is not symmetric (to 1e-12) and positive definite and on numbers that are not finite.
  FreeTop(const Matrix3<double>& inertia_body, const Quaternion<double>& orientation,
          const Vector3<double>& angular_velocity_body);

  using Motion = TopAt<double>;

  /// The motion at t (s, of either sign), to a few units of round-off times 1 + (|ω| + |λ|) |t|. Costs about 0.15 µs.
  /// The orientation is continuous in t, also in its sign.
  Motion at(double t) const;

  /// The angular velocity alone, in less than half of that time.
  Vector3<double> angular_velocity_body(double t) const {
    if (steady_) return angular_velocity_;
    return varying_.angular_velocity_body(t);
  }

  /// "at rest", "sphere", "pure spin" (ω is constant), "symmetric" (two moments equal to round-off), "separatrix", or
  /// "about the smallest axis", "about the largest axis": where the momentum goes round in the body.
  std::string_view regime() const { return regime_; }

  /// Period (s) of the angular velocity in the body: 0 if it is constant, +inf on the separatrix.
  double period() const { return steady_ ? 0 : 4 * varying_.jacobi.quarter_period() / std::abs(varying_.phase_rate); }

  /// The motion of a top whose ω varies; null if it is constant.
  const VaryingTop<double>* varying() const { return steady_ ? nullptr : &varying_; }

 private:
  std::string_view regime_;
  bool steady_ = false;
  // Used if ω is constant.
  Quaternion<double> start_;
  Vector3<double> angular_velocity_, axis_;
  double speed_ = 0;  // rad/s
  // Used if ω varies.
  VaryingTop<double> varying_;
};

}  // namespace polhode::core::exact
