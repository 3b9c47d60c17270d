// SPDX-License-Identifier: BSD-3-Clause
// The flow of the Hamiltonian ½ κ m_i²: a rotation about one principal axis at the constant rate κ m_i. With q the
// rotation since the start of the step, m ← exp(−φ e_i*) m, q ← q (cos φ/2 + e_i sin φ/2), φ = h κ m_i.
#pragma once

#include <cmath>

#include "core/math/quaternion.hpp"

namespace polhode::inline integrators {

/// Applies the flow over h to the angular momentum m (principal axes) and the quaternion q. h_kappa = h κ.
template <int axis, class S>
void rotate_about_axis(S h_kappa, Vector3<S>& m, Quaternion<S>& q) {
  using std::cos, std::sin;
  constexpr int i = axis, j = (axis + 1) % 3, k = (axis + 2) % 3;
  const S half = h_kappa * m[i] / S(2);
  const S c = cos(half), s = sin(half);
  // cos φ = 1 − 2 s², sin φ = 2 s c. The increments of m are then proportional to the angle, which limits the
  // round-off.
  const S a = S(2) * s * c, b = S(2) * s * s, mj = m[j], mk = m[k];
  m[j] = mj + (a * mk - b * mj);
  m[k] = mk - (a * mj + b * mk);
  const S w = q[0], qi = q[1 + i], qj = q[1 + j], qk = q[1 + k];
  q[0] = c * w - s * qi;
  q[1 + i] = c * qi + s * w;
  q[1 + j] = c * qj + s * qk;
  q[1 + k] = c * qk - s * qj;
}

}  // namespace polhode::integrators
