// SPDX-License-Identifier: BSD-3-Clause
// The discrete Moser–Veselov equation for the free rigid body (Moser & Veselov, Commun. Math. Phys. 139 (1991) 217), in
// quaternions (McLachlan & Zanna, Found. Comput. Math. 5 (2005) 87).
#pragma once

#include <cmath>
#include <limits>

#include "core/math/quaternion.hpp"

namespace polhode::inline integrators {

/// One step with the moments j (kg m²), solved for u = ρ/ρ0: j1 u1 + (j3 − j2) u2 u3 = (h/2)(1 + |u|²) m1, and
/// cyclically. Newton's iteration converges to round-off. The solution lies on the branch that starts at h = 0; the
/// branch ends where the Jacobian becomes singular. Returns null, or the reason of a failure.
template <class S>
const char* moser_veselov_turn(const Vector3<S>& j, S h, Vector3<S>& m, Quaternion<S>& dq) {
  using std::sqrt;
  const Vector3<S> d(j[2] - j[1], j[0] - j[2], j[1] - j[0]);
  const Vector3<S> b = (h / S(2)) * m;
  const auto products = [&](const Vector3<S>& u) {
    return Vector3<S>(d[0] * (u[1] * u[2]), d[1] * (u[2] * u[0]), d[2] * (u[0] * u[1]));
  };
  Vector3<S> u = b.cwiseQuotient(j);
  u -= products(u).cwiseQuotient(j);
  for (int iteration = 0; iteration < 20; ++iteration) {
    const S u2 = u.squaredNorm();
    const Vector3<S> residual = (j.cwiseProduct(u) - b) + (products(u) - u2 * b);
    // Rows of the Jacobian: derivatives of j u + products(u) minus b (2 u)ᵀ.
    const Vector3<S> v = S(2) * u;
    const Vector3<S> r0(j[0] - b[0] * v[0], d[0] * u[2] - b[0] * v[1], d[0] * u[1] - b[0] * v[2]);
    const Vector3<S> r1(d[1] * u[2] - b[1] * v[0], j[1] - b[1] * v[1], d[1] * u[0] - b[1] * v[2]);
    const Vector3<S> r2(d[2] * u[1] - b[2] * v[0], d[2] * u[0] - b[2] * v[1], j[2] - b[2] * v[2]);
    const Vector3<S> c0 = r1.cross(r2), c1 = r2.cross(r0), c2 = r0.cross(r1);
    const S determinant = r0.dot(c0);
    const Vector3<S> delta = (residual[0] * c0 + residual[1] * c1 + residual[2] * c2) / determinant;
    u -= delta;
    // The error after an iteration is about the square of its step. Stop once it is below round-off.
    if (delta.squaredNorm() <= std::numeric_limits<S>::epsilon() / S(16) * u.squaredNorm()) {
      if (!(determinant > S(0))) break;
      const S length2 = S(1) + u.squaredNorm();
      const Vector3<S> um = u.cross(m);
      m += (S(2) / length2) * (u.cross(um) - um);  // Rᵀ m
      const S scale = S(1) / sqrt(length2);
      dq = Quaternion<S>(scale, scale * u[0], scale * u[1], scale * u[2]);
      return nullptr;
    }
  }
  return "the discrete Moser-Veselov equation has no solution near the motion: the step is too long";
}

}  // namespace polhode::integrators
