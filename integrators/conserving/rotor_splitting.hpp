// SPDX-License-Identifier: BSD-3-Clause
// Extension of a rotor, an integrator of the free rigid body, to bodies under forces by the Strang splitting
//   kick(t, h/2), free flow(h), kick(t + h, h/2).
// In the free flow time advances, mass centres move in straight lines, and the rotor rotates each body. The splitting
// is symmetric if the rotor is. Its order is 2 under forces for every order of the rotor. Without forces it equals the
// rotor. Sources: Touma & Wisdom, Astron. J. 107 (1994) 1189; Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107
// (1997) 5840.
//
// A class Rotor has a static function template turn<S> of type RotorTurn<S>. It is not inlined: the rotor is compiled
// once for each scalar, and the splitting once for each formulation, independently of the rotor (rotor_splitting.cpp).
#pragma once

#include "integrators/conserving/kick.hpp"
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

/// Advances the angular momentum m (principal axes) by h (s) and sets dq to the unit quaternion of the rotation dR,
/// R' = R dR. Returns null, or the reason of a failure.
template <class S>
using RotorTurn = const char* (*)(const BodyConstants<S>& body, S h, Vector3<S>& m, Quaternion<S>& dq);

/// The Strang splitting, with the rotor as an argument of step().
template <class System>
class KickFlowKick {
 public:
  static_assert(Splitting<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit KickFlowKick(const System& system) : kick_(system) {}
  const char* step(const System& system, S t, S h, Flat& y, RotorTurn<S> turn);
  std::int64_t evaluations() const { return kick_.evaluations(); }

 private:
  Kick<System> kick_;
};

/// The Strang splitting with the given Rotor, as a fixed-step method.
template <class System, class Rotor>
class RotorSplitting {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit RotorSplitting(const System& system) : splitting_(system) {}
  const char* step(const System& system, S t, S h, Flat& y) {
    return splitting_.step(system, t, h, y, Rotor::template turn<S>);
  }
  std::int64_t evaluations() const { return splitting_.evaluations(); }

 private:
  KickFlowKick<System> splitting_;
};

/// Equation of a splitting (Declaration::equation): kicks and free flow, with the rows that define the rotor ρ_h.
inline std::string kick_flow_kick(const std::string& rotor) {
  return R"(\Phi_h &= K_{h/2} \circ F_h \circ K_{h/2} \\
K_h:\ & v \leftarrow v', \quad v' = v + h\,M^{-1} f\bigl(t, q, \tfrac12 (v + v')\bigr) \\
F_h:\ & t \leftarrow t + h, \quad x \leftarrow x + h\,\dot x, \quad (m, R) \leftarrow \rho_h(m, R) \\
)" + rotor;
}

/// Refuses formulations without the gyroscopic term, which the true motion of a rotor contains.
inline std::string refuse_without_gyroscopic_term(const Problem&, const Formulation& formulation) {
  return formulation.gyroscopic ? "" : "its free flow is the true motion, which has the gyroscopic term";
}

/// Catalogue entry of a method that is built from rotors; refused without the gyroscopic term.
template <template <class> class Method>
IntegratorEntry rotor_method(Declaration declaration) {
  IntegratorEntry entry = fixed_step<Method, Forms::many_bodies>(std::move(declaration));
  entry.refusal = refuse_without_gyroscopic_term;
  return entry;
}

}  // namespace polhode::integrators
