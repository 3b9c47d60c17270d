// SPDX-License-Identifier: BSD-3-Clause
// Definitions of RigidBodies members for Lie-group, conserving and splitting methods: group operations, inertia map,
// body frame, kicks and free flow. Included only by core/system/rigid_bodies.hpp.
#pragma once

#include "core/system/rigid_bodies.hpp"

namespace polhode {

// Lie group SO(3)ⁿ × R³ⁿ (Iserles, Munthe-Kaas, Nørsett & Zanna, Lie-group methods, Acta Numerica 2000).

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::twist(const Flat& y, Tangent& xi) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const Layout::Slot s = slot(i);
    const Vector a = load(y.data() + s.angular);
    if constexpr (A == AngularState::momentum_world) {
      store(angular_velocity_world(body(i), rotation(ChartOf::load(y.data() + s.orientation)), a), angular(xi, i));
    } else {
      store(a, angular(xi, i));
    }
    if (!pinned(i)) store(load(y.data() + s.velocity), linear(xi, i));
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::retract(Flat& y, const Tangent& xi) const {
  for (std::size_t i = 0; i < count(); ++i) {
    S* c = y.data() + slot(i).orientation;
    const Quaternion<S> turn = quaternion_from_rotation_vector<S>(load(angular(xi, i)));
    ChartOf::store(in_body_axes ? ChartOf::turned_in_body(ChartOf::load(c), turn)
                                : ChartOf::turned_in_world(ChartOf::load(c), turn),
                   c);
    if (!pinned(i)) store(load(y.data() + slot(i).position) + load(linear(xi, i)), y.data() + slot(i).position);
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::dexp_inverse(const Tangent& theta, const Tangent& eta, Tangent& out) const {
  out = eta;
  for (std::size_t i = 0; i < count(); ++i) {
    const Vector t = load(angular(theta, i)), e = load(angular(eta, i));
    const Vector te = t.cross(e);
    const S half = in_body_axes ? S(0.5) : S(-0.5);
    store(e + half * te + dexp_inverse_coefficient<S>(t.squaredNorm()) * t.cross(te), angular(out, i));
  }
}

// Inertia map.

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::wrench(S t, const Flat& y, Tangent& w) const {
  w.setZero();
  if (!this->has_forces()) return;
  fill_motions(y.data());
  fill_wrenches(t);
  for (std::size_t i = 0; i < count(); ++i) {
    store(wrenches_[i].torque, angular(w, i));
    if (!pinned(i)) store(wrenches_[i].force, linear(w, i));
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::momentum(const Flat& y, Tangent& p) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const Layout::Slot s = slot(i);
    const Matrix r = rotation(ChartOf::load(y.data() + s.orientation));
    store(angular_momentum(body(i), r, load(y.data() + s.angular)), angular(p, i));
    if (!pinned(i)) store(body(i).mass * load(y.data() + s.velocity), linear(p, i));
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::set_momentum(const Tangent& p, Flat& y) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const Layout::Slot s = slot(i);
    const Matrix r = rotation(ChartOf::load(y.data() + s.orientation));
    store(angular_state(body(i), r, load(angular(p, i))), y.data() + s.angular);
    if (!pinned(i)) store(body(i).inverse_mass * load(linear(p, i)), y.data() + s.velocity);
  }
}

// Body frame, in every formulation, for methods whose source is written in body axes.

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::body_twist(const Flat& y, Tangent& xi) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const Layout::Slot s = slot(i);
    const ChartValue c = ChartOf::load(y.data() + s.orientation);
    store(angular_velocity_body(body(i), c, load(y.data() + s.angular)), angular(xi, i));
    if (!pinned(i)) store(load(y.data() + s.velocity), linear(xi, i));
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::set_body_twist(const Tangent& xi, Flat& y) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const Layout::Slot s = slot(i);
    Vector a = load(angular(xi, i));
    if constexpr (A == AngularState::momentum_world) a = body(i).momentum(a);
    if constexpr (!in_body_axes) a = rotation(ChartOf::load(y.data() + s.orientation)) * a;
    store(a, y.data() + s.angular);
    if (!pinned(i)) store(load(linear(xi, i)), y.data() + s.velocity);
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::body_acceleration(const Flat& y, const Tangent& wrench, Tangent& rate) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const Layout::Slot s = slot(i);
    const Constants& b = body(i);
    const ChartValue c = ChartOf::load(y.data() + s.orientation);
    const Vector w = angular_velocity_body(b, c, load(y.data() + s.angular));
    const Vector torque = rotation(c).transpose() * load(angular(wrench, i));
    store(b.velocity(torque - w.cross(b.momentum(w))), angular(rate, i));
    if (!pinned(i)) store(b.inverse_mass * load(linear(wrench, i)), linear(rate, i));
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::retract_in_body(Flat& y, const Tangent& xi) const {
  for (std::size_t i = 0; i < count(); ++i) {
    S* c = y.data() + slot(i).orientation;
    const Quaternion<S> turn = quaternion_from_rotation_vector<S>(load(angular(xi, i)));
    ChartOf::store(ChartOf::turned_in_body(ChartOf::load(c), turn), c);
    if (!pinned(i)) store(load(y.data() + slot(i).position) + load(linear(xi, i)), y.data() + slot(i).position);
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::carry_momentum(const Tangent& theta, const Tangent& impulse, Flat& y) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const Layout::Slot s = slot(i);
    const Constants& b = body(i);
    S* c = y.data() + s.orientation;
    S* a = y.data() + s.angular;
    const ChartValue old = ChartOf::load(c);
    const Quaternion<S> turn = quaternion_from_rotation_vector<S>(load(angular(theta, i)));
    const ChartValue now = ChartOf::turned_in_body(old, turn);
    ChartOf::store(now, c);
    const Vector torque = load(angular(impulse, i));
    if constexpr (A == AngularState::momentum_world) {
      store(load(a) + torque, a);
    } else {
      const Vector w = angular_velocity_body(b, old, load(a));
      const Vector change = rotation(now).transpose() * torque + turning(conjugate<S>(turn), b.momentum(w));
      const Vector dw = b.velocity(change);
      if constexpr (in_body_axes) store(w + dw, a);
      else store(load(a) + rotation(old) * Vector(dw + turning(turn, w + dw)), a);
    }
    if (!pinned(i)) {
      S* p = y.data() + s.position;
      S* v = y.data() + s.velocity;
      store(load(p) + load(linear(theta, i)), p);
      store(load(v) + body(i).inverse_mass * load(linear(impulse, i)), v);
    }
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::bracket(const Tangent& a, const Tangent& b, Tangent& out) const {
  for (std::size_t i = 0; i < count(); ++i) {
    store(load(angular(a, i)).cross(load(angular(b, i))), angular(out, i));
    if (!pinned(i)) store(Vector::Zero(), linear(out, i));
  }
}

// Splitting T + V: kicks change the momentum at fixed configuration, and free flow moves bodies without a wrench.

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::kick(S t, S h, Flat& y) const {
  if (!this->has_forces()) return;
  fill_motions(y.data());
  const S before = this->forces_do_work() ? power(t) : S(0);
  fill_wrenches(t);
  push(h, y);
  if (this->forces_do_work()) {
    fill_motions(y.data());
    work_part(y) += h * (S(0.5) * (before + power(t)));
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::kick(S t, S h, const Flat& seen, Flat& y) const {
  if (!this->has_forces()) return;
  fill_motions(seen.data());
  fill_wrenches(t);
  push(h, y);
  if (this->forces_do_work()) work_part(y) += h * power(t);
}

template <class S, Orientation O, AngularState A, BodyCount N>
template <class AnyRotor>
requires(!is_lanes<S>) void RigidBodies<S, O, A, N>::free_flow(S h, Flat& y, AnyRotor&& rotor) const {
  for (std::size_t i = 0; i < count(); ++i) {
    const Layout::Slot s = slot(i);
    const Constants& b = body(i);
    S* c = y.data() + s.orientation;
    S* a = y.data() + s.angular;
    const ChartValue old = ChartOf::load(c);
    Vector omega = load(a), m = omega;  // angular velocity Ω and angular momentum in body axes
    Matrix r = Matrix::Identity();
    if constexpr (!in_body_axes) r = ChartOf::rotation(old, RotationFrom::normalised);
    if constexpr (A == AngularState::velocity_world) omega = unturned(r, omega);
    m = A == AngularState::momentum_world ? Vector(r.transpose() * m) : b.momentum(omega);
    if (!b.principal) m = b.axes.transpose() * m;
    const Vector before = m;
    Quaternion<S> turn = rotor(b, h, m);
    Vector change = m - before;
    if (!b.principal) {
      change = b.axes * change;
      turn.template tail<3>() = Vector(b.axes * turn.template tail<3>());
    }
    const ChartValue now = ChartOf::carried_in_body(old, turn);
    ChartOf::store(now, c);
    const Vector omega_now = omega + b.velocity(change);
    if constexpr (in_body_axes) store(omega_now, a);
    else if constexpr (A == AngularState::velocity_world) {
      store(load(a) + (ChartOf::rotation(now, RotationFrom::normalised) * omega_now - r * omega), a);
    }
    if (!pinned(i)) {
      S* p = y.data() + s.position;
      store(load(p) + h * load(y.data() + s.velocity), p);
    }
  }
}

}  // namespace polhode
