// SPDX-License-Identifier: BSD-3-Clause
// The three-rotation splitting of the free rigid body with kicks, kick(h/2), free body over h, kick(h/2), and its
// compositions. The energy T = m1²/2I1 + m2²/2I2 + m3²/2I3 has three parts, and each is a rotation about its axis. The
// splitting is symmetric: φ1(h/2), φ2(h/2), φ3(h), φ2(h/2), φ1(h/2), applied in this order.
// Sources: McLachlan, Phys. Rev. Lett. 71 (1993) 3043; Reich, Physica D 76 (1994) 375.
#include "integrators/conserving/axis_rotation.hpp"
#include "integrators/conserving/composition.hpp"
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

IntegratorEntry mclachlan_reich() {
  return rotor_method<MclachlanReich>(
      {.name = "mclachlan_reich",
       .family = "conserving",
       .summary = "kick, rotations about the axes 1 2 3 2 1, kick",
       .equation = kick_flow_kick(
           R"(\rho_h &= \rho^1_{h/2} \circ \rho^2_{h/2} \circ \rho^3_h \circ \rho^2_{h/2} \circ \rho^1_{h/2} \\
\rho^k_h:\ & m \leftarrow \exp(-\varphi\,e_k)\,m, \quad R \leftarrow R\,\exp(\varphi\,e_k), \quad
  \varphi = h\,m_k/I_k)"),
       .sources = {"mclachlan1993", "reich1994"},
       .order = 2,
       .lie_group = true,
       .symplectic = true,
       .symmetric = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
}

// Yoshida's triple jump. Source: Yoshida, Phys. Lett. A 150 (1990) 262.
template <class System>
using MclachlanReichYoshida4 = Composition<System, MclachlanReich, Yoshida4>;

IntegratorEntry mclachlan_reich_yoshida4() {
  return rotor_method<MclachlanReichYoshida4>(composition_of<Yoshida4>(
      mclachlan_reich().declaration, "mclachlan_reich_yoshida4", "the triple jump (Yoshida) of mclachlan_reich"));
}

// Suzuki's composition of five parts. Source: Suzuki, Phys. Lett. A 146 (1990) 319.
template <class System>
using MclachlanReichSuzuki4 = Composition<System, MclachlanReich, Suzuki4>;

IntegratorEntry mclachlan_reich_suzuki4() {
  return rotor_method<MclachlanReichSuzuki4>(
      composition_of<Suzuki4>(mclachlan_reich().declaration, "mclachlan_reich_suzuki4",
                              "Suzuki's composition of five parts of mclachlan_reich"));
}

// Kahan and Li's composition of nine parts. Source: Kahan & Li, Math. Comp. 66 (1997) 1089.
template <class System>
using MclachlanReichKahanLi6 = Composition<System, MclachlanReich, KahanLi6>;

IntegratorEntry mclachlan_reich_kahan_li6() {
  return rotor_method<MclachlanReichKahanLi6>(
      composition_of<KahanLi6>(mclachlan_reich().declaration, "mclachlan_reich_kahan_li6",
                               "Kahan and Li's composition of nine parts of mclachlan_reich"));
}

}  // namespace polhode::integrators
