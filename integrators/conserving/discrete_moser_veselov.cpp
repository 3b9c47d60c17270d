// SPDX-License-Identifier: BSD-3-Clause
// The discrete Moser–Veselov algorithm for the free rigid body, with modified moments of inertia for orders 4 and 6, in
// a Strang splitting with kicks: order 2 under forces.
//
// One step with moments J solves for the rotation R(ρ) of the unit quaternion ρ = (ρ0, ρ1, ρ2, ρ3) with
//   h m1 = 2 J1 ρ0 ρ1 + 2 (J3 − J2) ρ2 ρ3, and cyclically,
// that is h m* = R D − D Rᵀ with J_i = d_j + d_k, and sets m' = Rᵀ m, Q' = Q R. It conserves Q m, |m| and ½ m·J⁻¹m.
// Sources: Moser & Veselov, Commun. Math. Phys. 139 (1991) 217; McLachlan & Zanna, Found. Comput. Math. 5 (2005) 87
// (quaternions); Hairer & Vilmart, J. Phys. A 39 (2006) 13225, section 2.
//
// By backward error analysis the step is exact for a free body whose energy is a function of H = ½ m·J⁻¹m and
// C = ½ |m|² (McLachlan & Zanna; Hairer & Vilmart, section 3). Modified moments J̃ with
//   1/J̃_i = (1 + h² s3 + h⁴ s5)/J_i + h² d3 + h⁴ d5
// therefore give order 4 (s3, d3) or 6 (all four) and conserve H, C and Q m. With e1, e2, e3 the elementary symmetric
// functions of J:
//   s3 = −(e2/3e3) H + (e1/6e3) C,  d3 = (e1/6e3) H − (1/3e3) C,
//   60 e3² s5 = (2 e2² − e1 e3) H² + (8 e3 − 2 e1 e2) H C + (2 e1² − 6 e2) C²,
//   60 e3² d5 = −(e1 e2 + 6 e3) H² + (8 e2 − e1²) H C − e1 C².
// These coefficients follow by inserting the Taylor series of the exact ρ into the equations above.
#include "integrators/conserving/moser_veselov.hpp"
#include "integrators/conserving/rotor_splitting.hpp"

namespace polhode::inline integrators {

/// The rotor of order 2, 4 or 6.
template <int order>
struct MoserVeselov {
  template <class S>
  [[gnu::noinline]] static const char* turn(const BodyConstants<S>& body, S h, Vector3<S>& m, Quaternion<S>& dq) {
    if constexpr (order == 2) {
      return moser_veselov_turn(body.moments, h, m, dq);
    } else {
      const Vector3<S>&j = body.moments, &inverse = body.inverse_moments;
      const S energy = inverse.dot(m.cwiseProduct(m)) / S(2), casimir = m.squaredNorm() / S(2);
      const S e1 = j.sum(), e2 = j[0] * j[1] + j[1] * j[2] + j[2] * j[0];
      const S per_e3 = inverse[0] * inverse[1] * inverse[2], h2 = h * h;
      S s = (e1 * casimir - S(2) * e2 * energy) * (per_e3 / S(6)) * h2;
      S d = (e1 * energy - S(2) * casimir) * (per_e3 / S(6)) * h2;
      if constexpr (order == 6) {
        const S e3 = j[0] * j[1] * j[2], h4 = h2 * h2 * (per_e3 * per_e3 / S(60));
        const S hh = energy * energy, hc = energy * casimir, cc = casimir * casimir;
        s += h4 *
             ((S(2) * e2 * e2 - e1 * e3) * hh + (S(8) * e3 - S(2) * e1 * e2) * hc + (S(2) * e1 * e1 - S(6) * e2) * cc);
        d += h4 * ((S(8) * e2 - e1 * e1) * hc - (e1 * e2 + S(6) * e3) * hh - e1 * cc);
      }
      const Vector3<S> prepared = inverse + (s * inverse + Vector3<S>::Constant(d));
      if (!(prepared.minCoeff() > S(0))) return "a prepared moment of inertia is not positive: the step is too long";
      return moser_veselov_turn<S>(prepared.cwiseInverse(), h, m, dq);
    }
  }
};

template <class System>
using Dmv = RotorSplitting<System, MoserVeselov<2>>;

IntegratorEntry dmv() {
  return rotor_method<Dmv>(
      {.name = "dmv",
       .family = "conserving",
       .summary = "kick, h m* = R D - D R^T and m' = R^T m (discrete Moser-Veselov), kick",
       .equation = kick_flow_kick(
           R"(\rho_h:\ & h\,\hat m = S D - D S^{\mathsf T}, \quad m \leftarrow S^{\mathsf T} m, \quad R \leftarrow R\,S,
  \quad S \in \mathrm{SO}(3) \\
& D = \operatorname{diag}(d_1, d_2, d_3), \quad I_i = d_j + d_k \text{ for } \{i, j, k\} = \{1, 2, 3\})"),
       .sources = {"moserVeselov1991", "mclachlanZanna2005", "hairerVilmart2006"},
       .order = 2,
       .implicit = true,
       .lie_group = true,
       .symplectic = true,
       .symmetric = true,
       .conserves_energy = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
}

// Moments of inertia modified up to h²: order 4 for free bodies.
template <class System>
using Dmv4 = RotorSplitting<System, MoserVeselov<4>>;

IntegratorEntry dmv4() {
  return rotor_method<Dmv4>(
      {.name = "dmv4",
       .family = "conserving",
       .summary = "kick, discrete Moser-Veselov with moments prepared to h^2, kick",
       .equation = kick_flow_kick(
           R"(\rho_h:\ & h\,\hat m = S D - D S^{\mathsf T}, \quad m \leftarrow S^{\mathsf T} m, \quad R \leftarrow R\,S,
  \quad S \in \mathrm{SO}(3) \\
& D = \operatorname{diag}(d_1, d_2, d_3), \quad \tilde I_i = d_j + d_k \text{ for } \{i, j, k\} = \{1, 2, 3\} \\
& H = \tfrac12\,m \cdot I^{-1} m, \quad C = \tfrac12\,m \cdot m, \quad e_1 = I_1 + I_2 + I_3 \\
& e_2 = I_1 I_2 + I_2 I_3 + I_3 I_1, \quad e_3 = I_1 I_2 I_3 \\
& 1/\tilde I_i = (1 + h^2 \sigma_3)/I_i + h^2 \delta_3 \\
& \sigma_3 = (e_1 C - 2 e_2 H)/(6 e_3), \quad \delta_3 = (e_1 H - 2 C)/(6 e_3))"),
       .sources = {"hairerVilmart2006", "mclachlanZanna2005", "moserVeselov1991"},
       .order = 2,
       .free_order = 4,
       .implicit = true,
       .lie_group = true,
       .symmetric = true,
       .conserves_energy = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
}

// Moments of inertia modified up to h⁴: order 6 for free bodies.
template <class System>
using Dmv6 = RotorSplitting<System, MoserVeselov<6>>;

IntegratorEntry dmv6() {
  return rotor_method<Dmv6>(
      {.name = "dmv6",
       .family = "conserving",
       .summary = "kick, discrete Moser-Veselov with moments prepared to h^4, kick",
       .equation = kick_flow_kick(
           R"(\rho_h:\ & h\,\hat m = S D - D S^{\mathsf T}, \quad m \leftarrow S^{\mathsf T} m, \quad R \leftarrow R\,S,
  \quad S \in \mathrm{SO}(3) \\
& D = \operatorname{diag}(d_1, d_2, d_3), \quad \tilde I_i = d_j + d_k \text{ for } \{i, j, k\} = \{1, 2, 3\} \\
& H = \tfrac12\,m \cdot I^{-1} m, \quad C = \tfrac12\,m \cdot m, \quad e_1 = I_1 + I_2 + I_3 \\
& e_2 = I_1 I_2 + I_2 I_3 + I_3 I_1, \quad e_3 = I_1 I_2 I_3 \\
& 1/\tilde I_i = (1 + h^2 \sigma_3 + h^4 \sigma_5)/I_i + h^2 \delta_3 + h^4 \delta_5 \\
& \sigma_3 = (e_1 C - 2 e_2 H)/(6 e_3), \quad \delta_3 = (e_1 H - 2 C)/(6 e_3) \\
& 60 e_3^2\,\sigma_5 = (2 e_2^2 - e_1 e_3) H^2 + (8 e_3 - 2 e_1 e_2) H C + (2 e_1^2 - 6 e_2) C^2 \\
& 60 e_3^2\,\delta_5 = -(e_1 e_2 + 6 e_3) H^2 + (8 e_2 - e_1^2) H C - e_1 C^2)"),
       .sources = {"hairerVilmart2006", "mclachlanZanna2005", "moserVeselov1991"},
       .order = 2,
       .free_order = 6,
       .implicit = true,
       .lie_group = true,
       .symmetric = true,
       .conserves_energy = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
}

}  // namespace polhode::integrators
