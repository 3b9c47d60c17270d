// SPDX-License-Identifier: BSD-3-Clause
// The exact free rotor between two kicks of h/2: exact for free bodies, order 2 under forces; and its compositions, of
// higher order under forces too. Each step is the exact torque-free motion by elliptic functions, from the momentum at
// the start of the step. In float it is the motion computed in double and rounded. Long double is not supported,
// because the elliptic functions are accurate to double only.
// Source: Celledoni, Fassò, Säfström & Zanna, SIAM J. Sci. Comput. 30 (2008) 2084, section 4.
#include <utility>

#include "core/exact/free_top.hpp"
#include "integrators/conserving/composition.hpp"
#include "integrators/conserving/rotor_splitting.hpp"

namespace polhode::inline integrators {

namespace {

/// Rotation of the free top with these principal moments (kg m²) over h (s), as a unit quaternion. m is the angular
/// momentum in principal axes, advanced by h.
Quaternion<double> free_top_turn(const Vector3<double>& moments, double h, Vector3<double>& m) {
  const FreeTop top(moments.asDiagonal(), identity_quaternion<double>(), m.cwiseQuotient(moments));
  const FreeTop::Motion end = top.at(h);
  m = end.angular_velocity_body.cwiseProduct(moments);
  return end.orientation;
}

}  // namespace

struct ExactRotor {
  template <class S>
  [[gnu::noinline]] static const char* turn(const BodyConstants<S>& body, S h, Vector3<S>& m, Quaternion<S>& dq) {
    if (!m.allFinite()) return "the angular momentum is no number";
    Vector3<double> end = m.template cast<double>();
    dq = free_top_turn(body.moments.template cast<double>(), double(h), end).template cast<S>();
    m = end.template cast<S>();
    return nullptr;
  }
};

template <class System>
using ExactRotorMethod = RotorSplitting<System, ExactRotor>;

/// Catalogue entry of a method that does not support long double.
template <template <class> class Method>
IntegratorEntry exact_rotor_method(Declaration declaration) {
  IntegratorEntry entry = rotor_method<Method>(std::move(declaration));
  entry.make_long_double = {};
  return entry;
}

IntegratorEntry exact_rotor() {
  return exact_rotor_method<ExactRotorMethod>(
      {.name = "exact_rotor",
       .family = "conserving",
       .summary = "kick, the exact torque-free motion, kick",
       .equation = kick_flow_kick(R"(\rho_h:\ & \text{the exact solution over } h \text{ of }
  \dot m = m \times I^{-1} m, \quad \dot R = R\,\widehat{I^{-1} m})"),
       .sources = {"celledoni2008"},
       .order = 2,
       .free_order = Declaration::exact_order,
       .lie_group = true,
       .symplectic = true,
       .symmetric = true,
       .conserves_energy = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
}

// Yoshida's triple jump. Source: Yoshida, Phys. Lett. A 150 (1990) 262.
template <class System>
using ExactRotorYoshida4 = Composition<System, ExactRotorMethod, Yoshida4>;

IntegratorEntry exact_rotor_yoshida4() {
  return exact_rotor_method<ExactRotorYoshida4>(composition_of<Yoshida4>(
      exact_rotor().declaration, "exact_rotor_yoshida4", "the triple jump (Yoshida) of exact_rotor"));
}

// Suzuki's composition of five parts. Source: Suzuki, Phys. Lett. A 146 (1990) 319.
template <class System>
using ExactRotorSuzuki4 = Composition<System, ExactRotorMethod, Suzuki4>;

IntegratorEntry exact_rotor_suzuki4() {
  return exact_rotor_method<ExactRotorSuzuki4>(composition_of<Suzuki4>(
      exact_rotor().declaration, "exact_rotor_suzuki4", "Suzuki's composition of five parts of exact_rotor"));
}

// Kahan and Li's composition of nine parts. Source: Kahan & Li, Math. Comp. 66 (1997) 1089.
template <class System>
using ExactRotorKahanLi6 = Composition<System, ExactRotorMethod, KahanLi6>;

IntegratorEntry exact_rotor_kahan_li6() {
  return exact_rotor_method<ExactRotorKahanLi6>(composition_of<KahanLi6>(
      exact_rotor().declaration, "exact_rotor_kahan_li6", "Kahan and Li's composition of nine parts of exact_rotor"));
}

}  // namespace polhode::integrators
