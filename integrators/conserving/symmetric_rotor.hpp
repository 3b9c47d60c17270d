// SPDX-License-Identifier: BSD-3-Clause
// The free rigid body as a symmetric top and a rotation. With moments I_a ≤ I_b ≤ I_c,
//   T = R + S,  R = ½ (1/I_a − 1/I_b) m_a²,  S = ½ |m|²/I_b + ½ (1/I_c − 1/I_b) m_c²,
// both parts have exact flows. R is a rotation about the axis a. S is a symmetric top with the axis c: a rotation by
// h m/I_b and one about c. Because |m|² is a Casimir, the rotation by h m/I_b commutes with all others. It is applied
// once for the whole step, with m at the start. The remaining rotations are about a and c, alternately.
// Sources: Touma & Wisdom, Astron. J. 107 (1994) 1189; Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107 (1997)
// 5840; Fassò, J. Comput. Phys. 189 (2003) 527, for the choice of the axes.
#pragma once

#include <utility>

#include "integrators/conserving/axis_rotation.hpp"
#include "integrators/conserving/rotor_splitting.hpp"

namespace polhode::inline integrators {

/// The rotor of the composition Scheme. Scheme::compose(rotation, symmetric_top) calls its two arguments in the order
/// of the composition, each with its fraction of the step.
template <class Scheme>
struct SymmetricRotor {
  template <class S>
  [[gnu::noinline]] static const char* turn(const BodyConstants<S>& body, S h, Vector3<S>& m, Quaternion<S>& dq) {
    int a = 0, b = 1, c = 2;
    const Vector3<S>& moments = body.moments;
    if (moments[b] < moments[a]) std::swap(a, b);
    if (moments[c] < moments[b]) std::swap(b, c);
    if (moments[b] < moments[a]) std::swap(a, b);
    // Components along the axes a, ±b, c of a right-handed frame.
    const S sense = (a + 1) % 3 == b ? S(1) : S(-1);
    Vector3<S> n(m[a], sense * m[b], m[c]);
    const Vector3<S>& inverse = body.inverse_moments;
    const S first = h * (moments[b] - moments[a]) * (inverse[a] * inverse[b]);
    const S third = h * (moments[b] - moments[c]) * (inverse[b] * inverse[c]);
    Quaternion<S> q = quaternion_from_rotation_vector<S>((h * inverse[b]) * n);
    Scheme::template compose<S>([&](S part) { rotate_about_axis<0>(part * first, n, q); },
                                [&](S part) { rotate_about_axis<2>(part * third, n, q); });
    m[a] = n[0];
    m[b] = sense * n[1];
    m[c] = n[2];
    dq[0] = q[0];
    dq[1 + a] = q[1];
    dq[1 + b] = sense * q[2];
    dq[1 + c] = q[3];
    return nullptr;
  }
};

}  // namespace polhode::integrators
