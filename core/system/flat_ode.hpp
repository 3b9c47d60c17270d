// SPDX-License-Identifier: BSD-3-Clause
// The flat ODE: the Newton–Euler equations in each formulation.
//
//   velocity_world:  ω̇ = R I⁻¹ Rᵀ (τ − ω × R I Rᵀ ω)      velocity_body:  Ω̇ = I⁻¹ (Rᵀτ − Ω × I Ω)
//   momentum_world:  L̇ = τ, ω = R I⁻¹ Rᵀ L                free bodies:    v̇ = f/m, ṗ = v
//
// The gyroscopic term (the products ω × R I Rᵀ ω and Ω × I Ω) can be omitted, as in both source documents.
// Source: Goldstein, Poole & Safko, Classical Mechanics, 3rd ed., ch. 5; course report, section 2.1; engine slides,
// "Integration".
#pragma once

#include "core/system/body_wrenches.hpp"

namespace polhode::inline core::inline system::flat_ode {

/// Gyroscopic torque IΩ × Ω in body axes, N m; zero if the formulation omits it.
template <class Bodies, class S>
inline Vector3<S> gyroscopic_torque(const Bodies& bodies, const BodyConstants<S>& b, const Vector3<S>& w) {
  if (bodies.formulation().gyroscopic) [[likely]]
    return b.momentum(w).cross(w);
  return Vector3<S>::Zero();
}

/// dω/dt or dL/dt in world axes of a body with rotation r under the torque about its reference point. A null torque
/// is zero.
template <class Bodies, class S>
inline Vector3<S> angular_rate_world(const Bodies& bodies, const BodyConstants<S>& b, const Matrix3<S>& r,
                                     const Vector3<S>& a, const Vector3<S>* torque) {
  using Vector = Vector3<S>;
  if constexpr (Bodies::angular_variable == AngularState::momentum_world) {
    return torque ? *torque : Vector(Vector::Zero());
  } else {
    if (bodies.orthonormal()) {  // R RᵀR = R, so that products with R around the gyroscopic term cancel
      const Vector w = r.transpose() * a;
      const Vector m = gyroscopic_torque(bodies, b, w);
      return r * b.velocity(torque ? Vector(r.transpose() * *torque + m) : m);
    }
    Vector m = torque ? *torque : Vector(Vector::Zero());
    if (bodies.formulation().gyroscopic) {
      const Vector l = r * b.momentum(r.transpose() * a);
      m -= a.cross(l);
    } else if (!torque) {
      return m;
    }
    return r * b.velocity(r.transpose() * m);
  }
}

/// The rates of the configuration and the work, of the velocity, or of both.
template <bool of_configuration, bool of_velocity, class Bodies, class S>
inline void rates(const Bodies& bodies, S t, const S* y, S* dy) {
  using Vector = Vector3<S>;
  using Matrix = Matrix3<S>;
  using ChartOf = typename Bodies::ChartOf;
  const bool forced = bodies.has_forces();
  const bool working = of_configuration && forced && bodies.forces_do_work();
  bool reactions = false;  // needed for the work of the joints
  if constexpr (Bodies::may_have_joints) reactions = of_configuration && bodies.has_joints();
  if (forced && (of_velocity || working || reactions)) bodies.fill_motions(y);
  if (forced && (of_velocity || reactions)) bodies.fill_wrenches(t);
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const BodyConstants<S>& b = bodies.body(i);
    const typename Bodies::ChartValue c = ChartOf::load(y + s.orientation);
    const Vector a = load_vector(y + s.angular);
    const Vector* torque = forced && bodies.forces_exert_torques() ? &bodies.wrenches()[i].torque : nullptr;
    const auto rotation_now = [&]() -> Matrix {
      const bool known = forced && bodies.forces_read_rotation() && (of_velocity || working || reactions);
      return known ? bodies.motions()[i].rotation : bodies.rotation(c);
    };
    if constexpr (of_configuration) {
      if constexpr (Bodies::in_body_axes) ChartOf::store(ChartOf::rate_body(c, a), dy + s.orientation);
      if (!bodies.pinned(i)) store_vector(load_vector(y + s.velocity), dy + s.position);
    }
    if constexpr (Bodies::in_body_axes) {  // R is needed for torques only
      if constexpr (of_velocity) {
        const Vector m = gyroscopic_torque(bodies, b, a);
        store_vector(b.velocity(torque ? Vector(rotation_now().transpose() * *torque + m) : m), dy + s.angular);
      }
    } else {
      const Matrix r = rotation_now();
      if constexpr (of_configuration) {
        ChartOf::store(ChartOf::rate_world(c, bodies.angular_velocity_world(b, r, a)), dy + s.orientation);
      }
      if constexpr (of_velocity) store_vector(angular_rate_world(bodies, b, r, a, torque), dy + s.angular);
    }
    if constexpr (of_velocity) {
      if (!bodies.pinned(i)) {
        store_vector(forced ? Vector(bodies.wrenches()[i].force * b.inverse_mass) : Vector(Vector::Zero()),
                     dy + s.velocity);
      }
    }
  }
  if constexpr (of_configuration) dy[bodies.flat_size() - 1] = working ? bodies.power(t) : S(0);
  if constexpr (Bodies::may_have_joints) {
    if (reactions) dy[bodies.layout().joint_work()] = bodies.constraints()->power();
  }
}

template <class Bodies, class S>
inline void rate(const Bodies& bodies, S t, const S* y, S* dy) {
  rates<true, true>(bodies, t, y, dy);
}

template <class Bodies, class S>
inline void acceleration(const Bodies& bodies, S t, const S* y, S* dy) {
  rates<false, true>(bodies, t, y, dy);
}

template <class Bodies, class S>
inline void configuration_rate(const Bodies& bodies, S t, const S* y, S* dy) {
  rates<true, false>(bodies, t, y, dy);
}

}  // namespace polhode::core::system::flat_ode
