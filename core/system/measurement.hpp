// SPDX-License-Identifier: BSD-3-Clause
// Energies, momenta and the orientation defect of a state, and its projection onto the manifold of orientations.
#pragma once

#include "core/system/body_wrenches.hpp"

namespace polhode::inline core::inline system::measurement {

/// `motion_of_first`: if given, receives the motion of the first body.
template <class Bodies, class S>
inline Measurement<S> measure(const Bodies& bodies, const S* y, BodyMotion<S>* motion_of_first = nullptr) {
  using Vector = typename Bodies::Vector;
  using ChartOf = typename Bodies::ChartOf;
  Measurement<S> m;
  const bool alone = bodies.count() == 1;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::Constants& b = bodies.body(i);
    const BodyMotion<S> now = bodies.motion(y, i);
    if (bodies.forces_read_rotation()) bodies.motions()[i] = now;
    if (motion_of_first && i == 0) *motion_of_first = now;
    Vector l = bodies.angular_momentum(b, now.rotation, load_vector(y + s.angular));
    if constexpr (Bodies::angular_variable == AngularState::momentum_world) {
      m.kinetic += S(0.5) * now.angular_velocity.dot(l);
    } else {
      const Vector w = bodies.body_velocity(now.rotation, load_vector(y + s.angular));
      m.kinetic += S(0.5) * w.dot(b.momentum(w));
    }
    if (bodies.pinned(i)) {
      if (!alone) l += now.position.cross(b.mass * now.angular_velocity.cross(now.rotation * b.center_of_mass));
    } else {
      const Vector p = b.mass * now.velocity;
      m.kinetic += S(0.5) * now.velocity.dot(p);
      m.linear_momentum += p;
      if (!alone) l += now.position.cross(p);
    }
    m.angular_momentum += l;
    const S defect = ChartOf::defect(ChartOf::load(y + s.orientation));
    m.orientation_defect = select(defect <= m.orientation_defect, m.orientation_defect, defect);  // keeps a NaN
  }
  if (bodies.has_forces() && !bodies.forces_read_rotation()) bodies.fill_motions(y);
  for (const auto& force : bodies.forces()) m.potential += force->potential_energy(bodies.motions());
  return m;
}

template <class Bodies, class S>
inline void project(const Bodies& bodies, S* y) {
  using ChartOf = typename Bodies::ChartOf;
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    S* c = y + bodies.slot(i).orientation;
    ChartOf::store(ChartOf::project(ChartOf::load(c)), c);
  }
}

}  // namespace polhode::core::system::measurement
