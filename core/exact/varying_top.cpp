// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/varying_top.hpp"

#include <cmath>

namespace polhode::inline core::inline exact {

template <class S>
TopAt<S> VaryingTop<S>::at(S t) const {
  const S u = phase + phase_rate * t;
  const Vector3<S> direction = momentum_direction(u);
  return {math::product(left, math::product(attitude_in_frame(t, u, direction), body_to_frame)),
          axes * direction.cwiseProduct(rate_per_momentum)};
}

template <class S>
Vector3<S> VaryingTop<S>::angular_velocity_body(S t) const {
  return axes * momentum_direction(phase + phase_rate * t).cwiseProduct(rate_per_momentum);
}

template <class S>
Vector3<S> VaryingTop<S>::momentum_direction(S u) const {
  const auto [sn, cn, dn] = jacobi(u);
  return momentum_amplitude.cwiseProduct(Vector3<S>(dn, sn, cn));
}

template <class S>
Quaternion<S> VaryingTop<S>::attitude_in_frame(S t, S u, const Vector3<S>& l) const {
  using std::sqrt;
  const auto [turn, re, im] = theta(u);
  const auto [s, c] = sine_and_cosine(S(precession_rate * t / 2 + turn));
  const Quaternion<S> precession(c * re - s * im, s * re + c * im, S(0), S(0));
  const Quaternion<S> least_rotation(1 + l[0], S(0), l[2], -l[1]);  // (1 + l·e_A, l × e_A)
  return math::product(precession, least_rotation) / sqrt((re * re + im * im) * 2 * (1 + l[0]));
}

template struct VaryingTop<double>;
template struct VaryingTop<Lanes>;

}  // namespace polhode::core::exact
