// SPDX-License-Identifier: BSD-3-Clause
// The flow of ½ κ m_i², a rotation about one principal axis at the constant rate κ m_i, on a body that has turned by q
// since the step began: m ← exp(−φ e_i*) m, q ← q (cos φ/2 + e_i sin φ/2), φ = h κ m_i.
#pragma once

#include <cmath>

#include "core/math/quaternion.hpp"

namespace polhode::inline integrators {

template <int axis, class S>
void rotate_about_axis(S h_kappa, Vector3<S>& m, Quaternion<S>& q) {
  using std::cos, std::sin;
  constexpr int i = axis, j = (axis + 1) % 3, k = (axis + 2) % 3;
  const S half = h_kappa * m[i] / S(2);
  const S c = cos(half), s = sin(half);
  // cos φ = 1 − 2 s², sin φ = 2 s c: the increments of m are as small as the angle.
  const S a = S(2) * s * c, b = S(2) * s * s, mj = m[j], mk = m[k];
  m[j] = mj + (a * mk - b * mj);
  m[k] = mk - (a * mj + b * mk);
  const S w = q[0], qi = q[1 + i], qj = q[1 + j], qk = q[1 + k];
  q[0] = c * w - s * qi;
  q[1 + i] = c * qi + s * w;
  q[1 + j] = c * qj + s * qk;
  q[1 + k] = c * qk - s * qj;
}

}  // namespace polhode
