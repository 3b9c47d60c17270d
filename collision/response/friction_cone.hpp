// SPDX-License-Identifier: BSD-3-Clause
// Coulomb's cone at one point: the tangential impulse in the disc of radius μ j_n that opposes the slip. On any scalar.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/lanes.hpp"

namespace polhode::inline collision::inline response {

/// The two components of the tangential impulse at one point.
template <class S>
struct Tangential {
  S t, b;
};

/// Response of the slip to a tangential impulse: s' = s + K j with K symmetric, 2 by 2.
template <class S>
class FrictionCone {
 public:
  FrictionCone() : tt_(0), tb_(0), bb_(0), least_(0) {}
  FrictionCone(S k_tt, S k_tb, S k_bb) {
    using std::sqrt;
    const S half = S(0.5) * (k_tt - k_bb);
    const S largest = S(0.5) * (k_tt + k_bb) + sqrt(half * half + k_tb * k_tb);
    const S determinant = k_tt * k_bb - k_tb * k_tb;
    least_ = select(largest > S(0), S(1) / largest, S(0));
    // If K is singular up to rounding, its largest eigenvalue alone is used.
    const auto regular = determinant > S(1e-12) * largest * largest;
    tt_ = select(regular, k_bb / determinant, least_);
    bb_ = select(regular, k_tt / determinant, least_);
    tb_ = select(regular, -k_tb / determinant, S(0));
  }

  /// One step from impulse j at slip s. If the impulse that stops the slip is in the disc, the result is that impulse.
  /// Otherwise it is a step of steepest descent, projected onto the disc; the step length is the same in all
  /// directions, so that at a fixed point the impulse opposes the slip.
  Tangential<S> step(const Tangential<S>& j, const Tangential<S>& s, S radius) const {
    using std::sqrt;
    const Tangential<S> stop{j.t - (tt_ * s.t + tb_ * s.b), j.b - (tb_ * s.t + bb_ * s.b)};
    const auto stops = stop.t * stop.t + stop.b * stop.b <= radius * radius;
    if (!any(!stops)) return stop;
    const Tangential<S> slide{j.t - least_ * s.t, j.b - least_ * s.b};
    const S square = radius * radius, length = slide.t * slide.t + slide.b * slide.b;
    const S shrink = select(length > square, radius / sqrt(length), S(1));
    return {select(stops, stop.t, shrink * slide.t), select(stops, stop.b, shrink * slide.b)};
  }

 private:
  S tt_, tb_, bb_;  ///< K⁻¹
  S least_;         ///< 1 over the largest eigenvalue of K
};

}  // namespace polhode::collision::response
