// SPDX-License-Identifier: BSD-3-Clause
// Scales of relative drifts: the largest energies and momenta along the true motion. They depend on the scenario and
// the duration, but not on the run, on the origin of the world frame, or on the zero of a potential.
//
// The true motion is the exact solution if it is known in full; the start of one body on which nothing acts has its
// scales already. Otherwise it is computed by RK4, whose step is halved until the scales agree to 0.1 %. With contact
// it is computed by semi-implicit Euler with time-stepping contact, as in physics engines.
#pragma once

#include <atomic>
#include <vector>

#include "core/system/system.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline metrics {

/// Largest energy drift over its scale; a run that exceeds it is stopped as diverged.
inline constexpr double hopeless_drift = 1e6;

/// Scales of one motion. A scale is 0 if nothing moves; there is no relative drift then.
struct MotionScales {
  /// Largest kinetic energy, or largest change of the potential energy since the start, whichever is larger, J; or the
  /// energy_scale that the scenario sets.
  double energy = 0;
  /// Largest sum over the bodies of |m v|, kg m/s; √(2 M energy) if all momenta are zero, M the mass of all bodies.
  double linear = 0;
  /// Largest sum of the bodies' angular momenta, kg m²/s: for one body its magnitude about its reference point, for
  /// several bodies an upper bound of the magnitudes about their common mass centre at the start. √(2 tr(I) energy) if
  /// all are zero, tr(I) summed over the bodies.
  double angular = 0;
  Vector3<double> mass_center = Vector3<double>::Zero();  ///< mass centre of the moving bodies at the start, world, m
  std::vector<double> invariants;  ///< the largest InvariantKind::scale, in the order of the scenario's invariants

  double kinetic_terms = 0;  ///< largest kinetic energy, J
  /// Largest sum over the forces of max(|V|, Σ |f| |p| + |τ| over the bodies), J; times ε it is the error of the energy
  /// due to the rounding of positions and attitudes. V: potential energy, f: force, p: position, τ: torque. With
  /// contact plus Σ ½ m v² |p|/r, r the radius of the body: times ε the error due to rounded contact points.
  double force_terms = 0;
  /// Largest kinetic energy of translation of bodies under constant forces only, J; their increments are all rounded in
  /// the same direction.
  double steady_terms = 0;

  /// Largest energy drift that rounding alone can explain after this number of steps, J:
  ///   ε (√steps (16 kinetic_terms + force_terms) + 4 force_terms + steps steady_terms),
  /// ε: that of `precision`, at least that of double, in which energies are measured.
  /// √steps is the growth of a random walk of rounding errors (Brouwer, Astronomical Journal 46 (1937) 149–153), with
  /// some sixteen roundings of velocities and one of positions in each step. 4 force_terms is the rounding of the
  /// energy at its measurement. The last term is the sum of roundings with one sign.
  double energy_round_off(Precision precision, std::int64_t steps) const;
};

/// Computes the scales of the scenario's motion from t = 0 to t_end (s). If `stop` is set meanwhile, it returns early
/// with incomplete scales, of which there is one for each invariant all the same.
MotionScales motion_scales(const Scenario& scenario, double t_end, const std::atomic<bool>* stop = nullptr);

/// Number of steps in which motion_scales() follows a motion with contact.
double steps_of_contact_scales(const Scenario& scenario, double t_end);

}  // namespace polhode::study::metrics
