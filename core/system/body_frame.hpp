// SPDX-License-Identifier: BSD-3-Clause
// The motion in body axes, in every formulation, for methods whose source is written in body axes.
#pragma once

#include "core/system/lie_group.hpp"

namespace polhode::inline core::inline system::body_frame {

template <class Bodies>
void twist(const Bodies& bodies, const typename Bodies::Flat& y, typename Bodies::Tangent& xi) {
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::ChartValue c = Bodies::ChartOf::load(y.data() + s.orientation);
    store_vector(bodies.angular_velocity_body(bodies.body(i), c, load_vector(y.data() + s.angular)),
                 bodies.angular_part(xi, i));
    if (!bodies.pinned(i)) store_vector(load_vector(y.data() + s.velocity), bodies.linear_part(xi, i));
  }
}

template <class Bodies>
void set_twist(const Bodies& bodies, const typename Bodies::Tangent& xi, typename Bodies::Flat& y) {
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    typename Bodies::Vector a = load_vector(bodies.angular_part(xi, i));
    if constexpr (Bodies::angular_variable == AngularState::momentum_world) a = bodies.body(i).momentum(a);
    if constexpr (!Bodies::in_body_axes) a = bodies.rotation(Bodies::ChartOf::load(y.data() + s.orientation)) * a;
    store_vector(a, y.data() + s.angular);
    if (!bodies.pinned(i)) store_vector(load_vector(bodies.linear_part(xi, i)), y.data() + s.velocity);
  }
}

template <class Bodies>
inline void acceleration(const Bodies& bodies, const typename Bodies::Flat& y, const typename Bodies::Tangent& wrench,
                         typename Bodies::Tangent& rate) {
  using Vector = typename Bodies::Vector;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::Constants& b = bodies.body(i);
    const typename Bodies::ChartValue c = Bodies::ChartOf::load(y.data() + s.orientation);
    const Vector w = bodies.angular_velocity_body(b, c, load_vector(y.data() + s.angular));
    const Vector torque = bodies.rotation(c).transpose() * load_vector(bodies.angular_part(wrench, i));
    store_vector(b.velocity(torque - w.cross(b.momentum(w))), bodies.angular_part(rate, i));
    if (!bodies.pinned(i)) {
      store_vector(b.inverse_mass * load_vector(bodies.linear_part(wrench, i)), bodies.linear_part(rate, i));
    }
  }
}

template <class Bodies>
void retract(const Bodies& bodies, typename Bodies::Flat& y, const typename Bodies::Tangent& xi) {
  lie_group::step<true>(bodies, y, xi);
}

/// Change of the vector v under the rotation by the unit quaternion d: d v d* − v.
template <class S>
inline Vector3<S> turning(const Quaternion<S>& d, const std::type_identity_t<Vector3<S>>& v) {
  const Vector3<S> u = d.template tail<3>();
  const Vector3<S> uv = u.cross(v);
  return S(2) * (d[0] * uv + u.cross(uv));
}

/// Updates the velocity by increments. A free body then conserves its momentum R I Ω for every defect of R, and the
/// round-off of I I⁻¹ does not enter at every step.
template <class Bodies>
void carry_momentum(const Bodies& bodies, const typename Bodies::Tangent& theta,
                    const typename Bodies::Tangent& impulse, typename Bodies::Flat& y) {
  using S = typename Bodies::Scalar;
  using Vector = typename Bodies::Vector;
  using ChartOf = typename Bodies::ChartOf;
  using ChartValue = typename Bodies::ChartValue;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::Constants& b = bodies.body(i);
    S* c = y.data() + s.orientation;
    S* a = y.data() + s.angular;
    const ChartValue old = ChartOf::load(c);
    const Quaternion<S> turn = quaternion_from_rotation_vector<S>(load_vector(bodies.angular_part(theta, i)));
    const ChartValue now = ChartOf::turned_in_body(old, turn);
    ChartOf::store(now, c);
    const Vector torque = load_vector(bodies.angular_part(impulse, i));
    if constexpr (Bodies::angular_variable == AngularState::momentum_world) {
      store_vector(load_vector(a) + torque, a);
    } else {
      const Vector w = bodies.angular_velocity_body(b, old, load_vector(a));
      const Vector change = bodies.rotation(now).transpose() * torque + turning<S>(conjugate<S>(turn), b.momentum(w));
      const Vector dw = b.velocity(change);
      if constexpr (Bodies::in_body_axes) store_vector(w + dw, a);
      else store_vector(load_vector(a) + bodies.rotation(old) * Vector(dw + turning<S>(turn, w + dw)), a);
    }
    if (!bodies.pinned(i)) {
      S* p = y.data() + s.position;
      S* v = y.data() + s.velocity;
      store_vector(load_vector(p) + load_vector(bodies.linear_part(theta, i)), p);
      store_vector(load_vector(v) + b.inverse_mass * load_vector(bodies.linear_part(impulse, i)), v);
    }
  }
}

template <class Bodies>
void bracket(const Bodies& bodies, const typename Bodies::Tangent& a, const typename Bodies::Tangent& b,
             typename Bodies::Tangent& out) {
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    store_vector(load_vector(bodies.angular_part(a, i)).cross(load_vector(bodies.angular_part(b, i))),
                 bodies.angular_part(out, i));
    if (!bodies.pinned(i)) store_vector(Bodies::Vector::Zero(), bodies.linear_part(out, i));
  }
}

}  // namespace polhode::core::system::body_frame
