// SPDX-License-Identifier: BSD-3-Clause
// Phase space of rigid bodies with its canonical two-form: T*SE(3) for each free body and T*SO(3) for each pinned one.
//
// A point is (x, p) and (R, π) with π = Rᵀ L the angular momentum in the body frame. A tangent vector is (δx, δp) and
// (ξ, δπ) with δR = R ξ*, the left trivialisation. In it the canonical two-form, −d of ⟨p, δx⟩ + ⟨π, ξ⟩, is
//   ω(a, b) = ⟨δp_b, δx_a⟩ − ⟨δp_a, δx_b⟩ + ⟨δπ_b, ξ_a⟩ − ⟨δπ_a, ξ_b⟩ + ⟨π, ξ_a × ξ_b⟩
// (Abraham & Marsden, Foundations of Mechanics, 2nd ed., proposition 4.4.1; the last term comes from dξ(ξ_a, ξ_b) =
// −[ξ_a, ξ_b], the bracket of fields that are invariant from the left).
//
// Coordinates are dimensionless: lengths are divided by the radius of gyration ℓ of the body, angular momenta by A, the
// largest |I| max(|Ω|, 1/s) of all bodies at the start, and linear momenta by A/ℓ. In these coordinates the two-form is
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
    Vector3<S> position;       ///< position of the mass centre of a free body, world frame, m
    Quaternion<S> attitude;    ///< unit quaternion
    Vector3<S> momentum;       ///< world frame, kg m/s; free bodies only
    Vector3<S> body_momentum;  ///< π, body frame, kg m²/s
  };
  std::vector<Body> bodies;
};

/// The phase space of a system, which must outlive it. S: double or long double.
template <class S>
class PhaseSpace {
 public:
  explicit PhaseSpace(const System<S>& system);

  /// Number of coordinates: 12 for each free body, in the order x, ξ, p, π; 6 for each pinned one, ξ, π.
  int dimension() const { return dimension_; }

  PhasePoint<S> start() const { return point(system_.start().y); }

  /// A point near the start without its symmetries: every coordinate is changed by up to a third. Then joints are
  /// closed again.
  PhasePoint<S> generic() const;

  /// The point of a state, whose orientations are first projected to their manifold.
  PhasePoint<S> point(VectorX<S> y) const;

  /// A state at this point; its accumulated work is 0.
  VectorX<S> state(const PhasePoint<S>& point) const;

  /// The point displaced by coordinates `by`: x + δx, R exp(ξ), p + δp, π + δπ, and then projected to the equations of
  /// the joints.
  PhasePoint<S> moved(const PhasePoint<S>& from, const VectorX<S>& by) const;

  /// Coordinates of the displacement from `from` to `to`: x − x₀, log(R₀ᵀ R), p − p₀, π − π₀.
  VectorX<S> coordinates(const PhasePoint<S>& from, const PhasePoint<S>& to) const;

  /// Matrix of ω/A at a point, dimension() × dimension().
  MatrixX<S> two_form(const PhasePoint<S>& at) const;

 private:
  const System<S>& system_;
  std::vector<S> lengths_;
  S action_ = 0;
  int dimension_ = 0;
};

}  // namespace polhode::study::certificate
