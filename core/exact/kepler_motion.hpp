// SPDX-License-Identifier: BSD-3-Clause
// The exact relative motion of two bodies that attract each other as 1/r²: r̈ = −μ r/|r|³, on any conic.
// Source: Stiefel & Scheifele, Linear and Regular Celestial Mechanics, section 11 (universal variables); Danby,
// Fundamentals of Celestial Mechanics, 2nd ed., section 6.9.
#pragma once

#include "core/exact/motion_at.hpp"
#include "core/math/linear_algebra.hpp"

namespace polhode::inline core::inline exact {

/// With s the fictitious time, ds = dt/r, from the pericentre, at distance q, and U_n = sⁿ c_n(βs²) by Stumpff's
/// functions, β = 2μ/r − v² = μ(1 − e)/q:
///   t − T = q U1 + μ U3,  r = q U0 + μ U2,  (x, y) = (q − μU2, L U1),  (ẋ, ẏ) = (−μU1, L U0)/r.
/// From the pericentre no difference of large numbers is left on any conic, near e = 0 and e = 1 alike. On a line (L =
/// 0) the bodies bounce off each other, which is the limit of ever thinner ellipses or hyperbolas.
class KeplerMotion {
 public:
  /// mu: m³/s², positive; position (m, not zero) and velocity (m/s) of one body relative to the other at t = 0. The
  /// numbers are taken as exact. Costs about 0.2 ms. Throws std::invalid_argument.
  KeplerMotion(double mu, const Vector3<double>& position, const Vector3<double>& velocity);

  using Motion = PathAt;
  /// Position and velocity relative to the other body at t (s, of either sign). Costs about 2 µs: Kepler's equation is
  /// solved by bracketed Newton iteration.
  Motion at(double t) const;

  double eccentricity() const { return static_cast<double>(eccentricity_); }
  double period() const;  ///< period, infinite unless the conic is an ellipse, s

 private:
  using Real = long double;
  Real solve(Real since_pericentre) const;

  Real mu_, beta_, q_, eccentricity_, momentum_;  // momentum: L
  Real since_pericentre_ = 0;                     // time since the pericentre at t = 0, s
  Real period_ = 0;                               // period, s; 0: none
  Vector3<Real> towards_pericentre_, across_;     // unit vectors
};

}  // namespace polhode::core::exact
