// SPDX-License-Identifier: BSD-3-Clause
// The splitting T + V: kicks change the momentum at fixed configuration, and free flow moves bodies without a wrench.
#pragma once

#include "core/system/body_wrenches.hpp"

namespace polhode::inline core::inline system::splitting {

/// v ← v + h M⁻¹ (f, τ) with the wrenches of the last fill_wrenches(), without the gyroscopic term.
template <class Bodies>
inline void push(const Bodies& bodies, typename Bodies::Scalar h, typename Bodies::Flat& y) {
  using S = typename Bodies::Scalar;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::Constants& b = bodies.body(i);
    if (bodies.forces_exert_torques()) {
      const typename Bodies::Matrix r = bodies.rotation(Bodies::ChartOf::load(y.data() + s.orientation));
      S* a = y.data() + s.angular;
      store_vector(load_vector(a) + h * bodies.angular_state(b, r, bodies.wrenches()[i].torque), a);
    }
    if (!bodies.pinned(i)) {
      S* v = y.data() + s.velocity;
      store_vector(load_vector(v) + h * (bodies.wrenches()[i].force * b.inverse_mass), v);
    }
  }
}

/// The work of the wrench follows by the trapezoidal rule, which is exact for reactions: they are constant in the kick.
template <class Bodies>
void kick(const Bodies& bodies, typename Bodies::Scalar t, typename Bodies::Scalar h, typename Bodies::Flat& y) {
  using S = typename Bodies::Scalar;
  if (!bodies.has_forces()) return;
  bodies.fill_motions(y.data());
  const S before = bodies.forces_do_work() ? bodies.power(t) : S(0);
  bodies.fill_wrenches(t);
  push(bodies, h, y);
  S& work = y[y.size() - 1];
  if (bodies.forces_do_work()) {
    bodies.fill_motions(y.data());
    work += h * (S(0.5) * (before + bodies.power(t)));
  }
  if constexpr (Bodies::may_have_joints) {
    if (!bodies.has_joints()) return;
    const S joints_before = bodies.constraints()->power();
    bodies.fill_motions(y.data());
    const S joints_after = bodies.constraints()->power_at(bodies.motions());
    y[bodies.layout().joint_work()] += h * (S(0.5) * (joints_before + joints_after));
  }
}

/// Kick with the wrench and power of the state `seen`, whose configuration equals that of y. It is a stage of a
/// quadrature rule for forces that depend on v.
template <class Bodies>
void kick(const Bodies& bodies, typename Bodies::Scalar t, typename Bodies::Scalar h, const typename Bodies::Flat& seen,
          typename Bodies::Flat& y) {
  if (!bodies.has_forces()) return;
  bodies.fill_motions(seen.data());
  bodies.fill_wrenches(t);
  push(bodies, h, y);
  if (bodies.forces_do_work()) y[y.size() - 1] += h * bodies.power(t);
  if constexpr (Bodies::may_have_joints) {
    if (bodies.has_joints()) y[bodies.layout().joint_work()] += h * bodies.constraints()->power();
  }
}

/// R⁻¹ a: by the transpose for the rotation of a quaternion, by Cramer's rule for a stored matrix.
template <Orientation O, class S>
inline Vector3<S> unturned(const Matrix3<S>& r, const Vector3<S>& a) {
  if constexpr (O == Orientation::quaternion) return r.transpose() * a;
  const Vector3<S> c0 = r.col(1).cross(r.col(2)), c1 = r.col(2).cross(r.col(0)), c2 = r.col(0).cross(r.col(1));
  return Vector3<S>(c0.dot(a), c1.dot(a), c2.dot(a)) / c0.dot(r.col(0));
}

/// Free motion over h (s). Mass centres move in straight lines. Each body rotates by dq = rotor(constants, h, m): the
/// call advances the angular momentum m (principal axes) over the step and returns the unit quaternion of the
/// rotation dR, R' = R dR in the same axes. constants.moments are the principal moments (kg m²).
///
/// With momentum_world, L is bitwise unchanged. The other variables are updated by increments, and for velocity_world
/// Ω solves R Ω = ω. The transformation into body axes and back then cancels exactly. It would not otherwise, because
/// I I⁻¹ = 1 holds only to round-off and RᵀR = 1 only to the defect of R; over many steps these factors would cause a
/// drift. For the same reason R of a quaternion is always that of q/|q| here: only then R(q dq) = R(q) R(dq).
template <class Bodies, class AnyRotor>
void free_flow(const Bodies& bodies, typename Bodies::Scalar h, typename Bodies::Flat& y, AnyRotor&& rotor) {
  using S = typename Bodies::Scalar;
  using Vector = typename Bodies::Vector;
  using Matrix = typename Bodies::Matrix;
  using ChartOf = typename Bodies::ChartOf;
  using ChartValue = typename Bodies::ChartValue;
  constexpr AngularState variable = Bodies::angular_variable;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::Constants& b = bodies.body(i);
    S* c = y.data() + s.orientation;
    S* a = y.data() + s.angular;
    const ChartValue old = ChartOf::load(c);
    Vector omega = load_vector(a), m = omega;  // angular velocity Ω and angular momentum in body axes
    Matrix r = Matrix::Identity();
    if constexpr (!Bodies::in_body_axes) r = ChartOf::rotation(old, RotationFrom::normalized);
    if constexpr (variable == AngularState::velocity_world) omega = unturned<Bodies::orientation>(r, omega);
    m = variable == AngularState::momentum_world ? Vector(r.transpose() * m) : b.momentum(omega);
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
    if constexpr (Bodies::in_body_axes) store_vector(omega_now, a);
    else if constexpr (variable == AngularState::velocity_world) {
      const Matrix r_now = ChartOf::rotation(now, RotationFrom::normalized);
      store_vector(load_vector(a) + (r_now * omega_now - r * omega), a);
    }
    if (!bodies.pinned(i)) {
      S* p = y.data() + s.position;
      store_vector(load_vector(p) + h * load_vector(y.data() + s.velocity), p);
    }
  }
}

}  // namespace polhode::core::system::splitting
