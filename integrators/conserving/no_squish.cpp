// SPDX-License-Identifier: BSD-3-Clause
// NO_SQUISH: the free rigid body in quaternion coordinates, T = Σ_k (p·P_k q)²/(8 I_k) with the momentum p = 2 q (0, m)
// conjugate to q and P_k q = q e_k. Each term rotates q and p by the same angle,
//   q' = cos(ζ) q + sin(ζ) P_k q,  p' = cos(ζ) p + sin(ζ) P_k p,  ζ = h (p·P_k q)/(4 I_k).
// The order is k = 3, 2, 1, 2, 3 with h/2, h/2, h, h/2, h/2, between two kicks. q starts at 1 in every step and is the
// rotation of the step. For |q| = 1 the method equals the three-rotation splitting with the axes in the opposite order.
// Source: Miller, Eleftheriou, Pattnaik, Ndirango, Newns & Martyna, J. Chem. Phys. 116 (2002) 8649.
#include <cmath>

#include "integrators/conserving/rotor_splitting.hpp"

namespace polhode::inline integrators {

struct QuaternionRotations {
  template <class S>
  [[gnu::noinline]] static const char* turn(const BodyConstants<S>& body, S h, Vector3<S>& m, Quaternion<S>& dq) {
    dq = identity_quaternion<S>();
    Quaternion<S> p = S(2) * pure(m);
    const Vector3<S> quarter = (h / S(4)) * body.inverse_moments;
    permute<3>(quarter[2] / S(2), dq, p);
    permute<2>(quarter[1] / S(2), dq, p);
    permute<1>(quarter[0], dq, p);
    permute<2>(quarter[1] / S(2), dq, p);
    permute<3>(quarter[2] / S(2), dq, p);
    m = product(conjugate(dq), p).template tail<3>() / S(2);  // p = 2 q (0, m)
    return nullptr;
  }

 private:
  /// P_k a = a e_k.
  template <int k, class S>
  static Quaternion<S> permuted(const Quaternion<S>& a) {
    if constexpr (k == 1) return {-a[1], a[0], a[3], -a[2]};
    else if constexpr (k == 2) return {-a[2], -a[3], a[0], a[1]};
    else return {-a[3], a[2], -a[1], a[0]};
  }

  /// Rotates q and p by ζ = rate (p·P_k q).
  template <int k, class S>
  static void permute(S rate, Quaternion<S>& q, Quaternion<S>& p) {
    using std::cos, std::sin;
    const Quaternion<S> pq = permuted<k>(q), pp = permuted<k>(p);
    const S half = rate * p.dot(pq) / S(2), s = sin(half), c = cos(half);
    // cos ζ = 1 − 2 s², sin ζ = 2 s c. The increments are then proportional to the angle, which limits the round-off.
    const S a = S(2) * s * c, b = S(2) * s * s;
    q += a * pq - b * q;
    p += a * pp - b * p;
  }
};

template <class System>
using NoSquish = RotorSplitting<System, QuaternionRotations>;

IntegratorEntry no_squish() {
  return rotor_method<NoSquish>(
      {.name = "no_squish",
       .family = "conserving",
       .summary = "kick, rotations in quaternion space in the order 3 2 1 2 3, kick",
       .equation =
           kick_flow_kick(R"(\rho_h &= P^3_{h/2} \circ P^2_{h/2} \circ P^1_h \circ P^2_{h/2} \circ P^3_{h/2}, \quad
  (\mathsf q, \mathsf p) = \bigl(1, 2\,(0, m)\bigr) \text{ at its start} \\
P^k_h:\ & \mathsf q \leftarrow \cos\zeta\,\mathsf q + \sin\zeta\,\mathsf q e_k, \quad
  \mathsf p \leftarrow \cos\zeta\,\mathsf p + \sin\zeta\,\mathsf p e_k \\
& \zeta = h\,(\mathsf p \cdot \mathsf q e_k)/(4 I_k) \\
& m \leftarrow \tfrac12 \operatorname{Im}(\bar{\mathsf q}\,\mathsf p), \quad
  R \leftarrow R\,R(\mathsf q) \text{ at its end})"),
       .sources = {"miller2002"},
       .order = 2,
       .lie_group = true,
       .symplectic = true,
       .symmetric = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
}

}  // namespace polhode::integrators
