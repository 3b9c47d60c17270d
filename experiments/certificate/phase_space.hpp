// SPDX-License-Identifier: BSD-3-Clause
// The phase space of rigid bodies, T*SE(3) for each free body and T*SO(3) for each pinned one, in canonical terms.
//
// A point is (x, p) and (R, π) with π = Rᵀ L the angular momentum in body axes. A tangent vector is (δx, δp) and
// (ξ, δπ) with δR = R ξ*, the left trivialisation. There the canonical two-form, −d of ⟨p, δx⟩ + ⟨π, ξ⟩, is
//   ω(a, b) = ⟨δp_b, δx_a⟩ − ⟨δp_a, δx_b⟩ + ⟨δπ_b, ξ_a⟩ − ⟨δπ_a, ξ_b⟩ + ⟨π, ξ_a × ξ_b⟩
// (Abraham & Marsden, Foundations of Mechanics, 2nd ed., proposition 4.4.1; the last term comes from dξ(ξ_a, ξ_b) =
// −[ξ_a, ξ_b], the bracket of fields that are invariant from the left).
//
// Coordinates have no dimension: lengths over the radius of gyration ℓ of the body, angular momenta over the largest
// A = |I| max(|Ω|, 1/s) of all bodies at the start, one for all, and linear ones over A/ℓ: these are the entries of
// ω/A.
#pragma once

#include <vector>

#include "core/system/system.hpp"

namespace polhode::study::certificate {

template <class S>
using MatrixX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

template <class S>
struct PhasePoint {
  struct Body {
    Vector3<S> position;       ///< m, of the mass centre; free bodies only
    Quaternion<S> attitude;    ///< of length one
    Vector3<S> momentum;       ///< kg m/s; free bodies only
    Vector3<S> body_momentum;  ///< π, kg m²/s
  };
  std::vector<Body> bodies;
};

/// Of one system, which must outlive it. S: double or long double.
template <class S>
class PhaseSpace {
 public:
  explicit PhaseSpace(const System<S>& system);

  /// 12 for each free body, in the order x, ξ, p, π; 6 for each pinned one, ξ, π.
  int dimension() const { return dimension_; }

  PhasePoint<S> start() const { return point(system_.start().y); }

  /// A point beside the start, at which no symmetry of it is left: every coordinate is changed by up to a third.
  PhasePoint<S> generic() const;

  /// Of a state: its orientations are projected to their manifold first.
  PhasePoint<S> point(VectorX<S> y) const;

  /// A state at this point, without work done.
  VectorX<S> state(const PhasePoint<S>& point) const;

  /// x + δx, R exp(ξ), p + δp, π + δπ.
  PhasePoint<S> moved(const PhasePoint<S>& from, const VectorX<S>& by) const;

  /// What moves `from` to `to`: x − x₀, log(R₀ᵀ R), p − p₀, π − π₀.
  VectorX<S> coordinates(const PhasePoint<S>& from, const PhasePoint<S>& to) const;

  /// The matrix of ω/A at a point.
  MatrixX<S> two_form(const PhasePoint<S>& at) const;

 private:
  const System<S>& system_;
  std::vector<S> lengths_;
  S action_ = 0;
  int dimension_ = 0;
};

}  // namespace polhode::study
