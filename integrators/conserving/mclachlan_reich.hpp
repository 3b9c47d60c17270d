// SPDX-License-Identifier: BSD-3-Clause
// The three-rotation splitting of the free rigid body: T = m1²/2I1 + m2²/2I2 + m3²/2I3, each part is a rotation
// about its axis. The composition is symmetric: φ1(h/2), φ2(h/2), φ3(h), φ2(h/2), φ1(h/2), applied in this order.
// Sources: McLachlan, Phys. Rev. Lett. 71 (1993) 3043; Reich, Physica D 76 (1994) 375.
#pragma once

#include "integrators/conserving/axis_rotation.hpp"
#include "integrators/conserving/rotor_splitting.hpp"

namespace polhode::inline integrators {

struct ThreeRotations {
  template <class S>
  [[gnu::noinline]] static const char* turn(const BodyConstants<S>& body, S h, Vector3<S>& m, Quaternion<S>& dq) {
    const Vector3<S> rate = h * body.inverse_moments;
    rotate_about_axis<0>(rate[0] / S(2), m, dq);
    rotate_about_axis<1>(rate[1] / S(2), m, dq);
    rotate_about_axis<2>(rate[2], m, dq);
    rotate_about_axis<1>(rate[1] / S(2), m, dq);
    rotate_about_axis<0>(rate[0] / S(2), m, dq);
    return nullptr;
  }
};

template <class System>
using MclachlanReich = RotorSplitting<System, ThreeRotations>;

}  // namespace polhode::integrators
