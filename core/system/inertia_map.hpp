// SPDX-License-Identifier: BSD-3-Clause
// The inertia map: momenta (kg m/s, kg m²/s) from velocities and back, and the wrenches (N, N m) that change them, in
// world axes, for every formulation. Formulas: the concept InertiaMap in core/system/concepts.hpp.
#pragma once

#include "core/system/body_wrenches.hpp"

namespace polhode::inline core::inline system::inertia_map {

template <class Bodies>
void wrench(const Bodies& bodies, typename Bodies::Scalar t, const typename Bodies::Flat& y,
            typename Bodies::Tangent& w) {
  w.setZero();
  if (!bodies.has_forces()) return;
  bodies.fill_motions(y.data());
  bodies.fill_wrenches(t);
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    store_vector(bodies.wrenches()[i].torque, bodies.angular_part(w, i));
    if (!bodies.pinned(i)) store_vector(bodies.wrenches()[i].force, bodies.linear_part(w, i));
  }
}

template <class Bodies>
void momentum(const Bodies& bodies, const typename Bodies::Flat& y, typename Bodies::Tangent& p) {
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::Constants& b = bodies.body(i);
    const typename Bodies::Matrix r = bodies.rotation(Bodies::ChartOf::load(y.data() + s.orientation));
    store_vector(bodies.angular_momentum(b, r, load_vector(y.data() + s.angular)), bodies.angular_part(p, i));
    if (!bodies.pinned(i)) store_vector(b.mass * load_vector(y.data() + s.velocity), bodies.linear_part(p, i));
  }
}

template <class Bodies>
void set_momentum(const Bodies& bodies, const typename Bodies::Tangent& p, typename Bodies::Flat& y) {
  for (std::size_t i = 0; i < bodies.count(); ++i) {
    const Layout::Slot s = bodies.slot(i);
    const typename Bodies::Constants& b = bodies.body(i);
    const typename Bodies::Matrix r = bodies.rotation(Bodies::ChartOf::load(y.data() + s.orientation));
    store_vector(bodies.angular_state(b, r, load_vector(bodies.angular_part(p, i))), y.data() + s.angular);
    if (!bodies.pinned(i)) store_vector(b.inverse_mass * load_vector(bodies.linear_part(p, i)), y.data() + s.velocity);
  }
}

}  // namespace polhode::core::system::inertia_map
