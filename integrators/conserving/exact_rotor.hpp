// SPDX-License-Identifier: BSD-3-Clause
// The exact free rotor: each step is the exact torque-free motion by elliptic functions, from the momentum at the start
// of the step. In float it is the motion computed in double and rounded. Long double is not supported, because the
// elliptic functions are accurate to double only. Source: Celledoni, Fassò, Säfström & Zanna, SIAM J. Sci. Comput. 30
// (2008) 2084.
#pragma once

#include "core/exact/free_top.hpp"
#include "integrators/conserving/rotor_splitting.hpp"

namespace polhode::inline integrators {

/// Rotation of the free top with these principal moments (kg m²) over h (s), as a unit quaternion. m is the angular
/// momentum in principal axes, advanced by h.
inline Quaternion<double> free_top_turn(const Vector3<double>& moments, double h, Vector3<double>& m) {
  const FreeTop top(moments.asDiagonal(), identity_quaternion<double>(), m.cwiseQuotient(moments));
  const FreeTop::Motion end = top.at(h);
  m = end.angular_velocity_body.cwiseProduct(moments);
  return end.orientation;
}

struct ExactRotor {
  template <class S>
  [[gnu::noinline]] static const char* turn(const BodyConstants<S>& body, S h, Vector3<S>& m, Quaternion<S>& dq) {
    if (!m.allFinite()) return "the angular momentum is no number";
    Vector3<double> end = m.template cast<double>();
    dq = free_top_turn(body.moments.template cast<double>(), double(h), end).template cast<S>();
    m = end.template cast<S>();
    return nullptr;
  }
};

template <class System>
using ExactRotorMethod = RotorSplitting<System, ExactRotor>;

/// Catalogue entry of a method that does not support long double.
template <template <class> class Method>
IntegratorEntry exact_rotor_method(Declaration declaration) {
  IntegratorEntry entry = rotor_method<Method>(std::move(declaration));
  entry.make_long_double = {};
  return entry;
}

}  // namespace polhode::integrators
