// SPDX-License-Identifier: BSD-3-Clause
// How a rotor, an integrator of the free rigid body, becomes a method for bodies under forces: the Strang splitting
//   kick(t, h/2), free flow(h), kick(t + h, h/2),
// in which mass centres go straight, time goes on with the free flow, and the rotor turns each body. It is symmetric
// if the rotor is, of order 2 under forces whatever the order of the rotor, and the rotor itself without forces.
// Sources: Touma & Wisdom, Astron. J. 107 (1994) 1189; Dullweber, Leimkuhler & McLachlan, J. Chem. Phys. 107 (1997)
// 5840.
//
// A Rotor has a static function template turn<S>, a RotorTurn<S>. It is not inlined, so that it is compiled once for
// each scalar, and the splitting around it once for each formulation (rotor_splitting.cpp), whatever the rotor.
#pragma once

#include "integrators/conserving/kick.hpp"
#include "integrators/fixed_step.hpp"

namespace polhode::inline integrators {

/// Moves the angular momentum m, in principal axes, to that after h and gives the unit quaternion dq of the turn,
/// R' = R dR; null, or why it cannot.
template <class S>
using RotorTurn = const char* (*)(const BodyConstants<S>& body, S h, Vector3<S>& m, Quaternion<S>& dq);

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

/// A rotor moves bodies as they truly move.
inline std::string refuse_without_gyroscopic_term(const Problem&, const Formulation& formulation) {
  return formulation.gyroscopic ? "" : "its free flow is the true motion, which has the gyroscopic term";
}

/// The entry of a method made of rotors, refused without the gyroscopic term.
template <template <class> class Method>
IntegratorEntry rotor_method(Declaration declaration) {
  IntegratorEntry entry = fixed_step<Method>(std::move(declaration));
  entry.refusal = refuse_without_gyroscopic_term;
  return entry;
}

}  // namespace polhode
