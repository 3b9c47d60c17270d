// SPDX-License-Identifier: BSD-3-Clause
// The configurations as elements of the Lie group SO(3)ⁿ × R³ⁿ: the group step and the inverse derivative of its
// exponential. Source: Iserles, Munthe-Kaas, Nørsett & Zanna, Lie-group methods, Acta Numerica 9 (2000).
#pragma once

#include <cmath>

#include "core/system/body_variables.hpp"

namespace polhode::inline core::inline system::lie_group {

template <class Bodies>
void twist(const Bodies& bodies, const typename Bodies::Flat& y, typename Bodies::Tangent& xi) {
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::Vector a = load_vector(y.data() + s.angular);
    if constexpr (Bodies::angular_variable == AngularState::momentum_world) {
      const typename Bodies::Matrix r = bodies.rotation(Bodies::ChartOf::load(y.data() + s.orientation));
      store_vector(bodies.angular_velocity_world(bodies.body(i), r, a), bodies.angular_part(xi, i));
    } else {
      store_vector(a, bodies.angular_part(xi, i));
    }
    if (!bodies.pinned(i)) store_vector(load_vector(y.data() + s.velocity), bodies.linear_part(xi, i));
  }
}

/// (p + ξ, exp(ξ) R) in world axes or (p + ξ, R exp(ξ)) in body axes.
template <bool in_body_axes, class Bodies>
void step(const Bodies& bodies, typename Bodies::Flat& y, const typename Bodies::Tangent& xi) {
  using S = typename Bodies::Scalar;
  using ChartOf = typename Bodies::ChartOf;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    S* c = y.data() + bodies.slot(i).orientation;
    const Quaternion<S> turn = quaternion_from_rotation_vector<S>(load_vector(bodies.angular_part(xi, i)));
    ChartOf::store(in_body_axes ? ChartOf::turned_in_body(ChartOf::load(c), turn)
                                : ChartOf::turned_in_world(ChartOf::load(c), turn),
                   c);
    if (bodies.pinned(i)) continue;
    S* p = y.data() + bodies.slot(i).position;
    store_vector(load_vector(p) + load_vector(bodies.linear_part(xi, i)), p);
  }
}

template <class Bodies>
void retract(const Bodies& bodies, typename Bodies::Flat& y, const typename Bodies::Tangent& xi) {
  step<Bodies::in_body_axes>(bodies, y, xi);
}

/// Coefficient (1 − (θ/2) cot(θ/2))/θ² of dexp⁻¹ as a function of θ². Near 0 it is computed by its power series.
template <class S>
S dexp_inverse_coefficient(S theta2) {
  using std::sqrt, std::tan;
  const S series =
      S(1) / S(12) +
      theta2 * (S(1) / S(720) +
                theta2 * (S(1) / S(30240) +
                          theta2 * (S(1) / S(1209600) +
                                    theta2 * (S(1) / S(47900160) + theta2 * (S(691) / S(1307674368000.0))))));
  const S half = sqrt(theta2) / S(2);
  return select(theta2 < S(1e-2), series, S((S(1) - half / tan(half)) / theta2));
}

/// out = η ∓ ½ θ × η + c θ × (θ × η), with − for exp(θ) R (world axes) and + for R exp(θ) (body axes).
/// c = (1 − (θ/2) cot(θ/2))/θ².
template <class Bodies>
void dexp_inverse(const Bodies& bodies, const typename Bodies::Tangent& theta, const typename Bodies::Tangent& eta,
                  typename Bodies::Tangent& out) {
  using S = typename Bodies::Scalar;
  using Vector = typename Bodies::Vector;
  out = eta;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Vector t = load_vector(bodies.angular_part(theta, i)), e = load_vector(bodies.angular_part(eta, i));
    const Vector te = t.cross(e);
    const S half = Bodies::in_body_axes ? S(0.5) : S(-0.5);
    store_vector(e + half * te + dexp_inverse_coefficient<S>(t.squaredNorm()) * t.cross(te),
                 bodies.angular_part(out, i));
  }
}

}  // namespace polhode::core::system::lie_group
