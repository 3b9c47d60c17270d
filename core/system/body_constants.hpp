// SPDX-License-Identifier: BSD-3-Clause
// The constants of a body in the scalar of a system, and its inertia as a map between Ω and angular momentum.
#pragma once

#include <vector>

#include "core/math/lanes.hpp"
#include "core/problem/problem.hpp"

namespace polhode::inline core::inline system {

/// The constants of one body in the scalar S.
template <class S>
struct BodyConstants {
  // The members that the rate of a free body reads come first, so that they share a cache line.
  bool principal = true;  ///< body axes are principal axes, so that I is diagonal
  bool pinned = false;
  S inverse_mass{};
  Vector3<S> moments, inverse_moments;  ///< principal moments of inertia, kg m², and their inverses
  S mass{};
  Matrix3<S> inertia, inverse_inertia;
  Matrix3<S> axes;  ///< rotation matrix with the principal axes as columns
  Vector3<S> center_of_mass;

  BodyConstants() = default;
  explicit BodyConstants(const Body& b);
  /// I ω in body axes.
  Vector3<S> momentum(const Vector3<S>& w) const {
    if (principal) [[likely]]
      return moments.cwiseProduct(w);
    return inertia * w;
  }
  /// I⁻¹ l in body axes.
  Vector3<S> velocity(const Vector3<S>& l) const {
    if (principal) [[likely]]
      return inverse_moments.cwiseProduct(l);
    return inverse_inertia * l;
  }
};

/// The constants of a body of one problem, or for lanes of the same body of one problem for each lane.
template <class S>
BodyConstants<S> constants_of(const std::vector<Problem>& problems, std::size_t body);

}  // namespace polhode::core::system
