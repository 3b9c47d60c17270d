// SPDX-License-Identifier: BSD-3-Clause
// What the drifts of a motion are measured against: the largest energies and momenta along the true motion. They belong
// to a scenario and a duration, not to a run, and depend neither on the world's origin nor on the zero of a potential.
//
// The true motion is the exact one where it is known in full. Elsewhere it is RK4 with ever smaller steps until the
// scales agree to 0.1 %; with contact it is semi-implicit Euler with contacts at the step, as engines do it.
#pragma once

#include <atomic>
#include <vector>

#include "core/system/system.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline metrics {

/// The drift, over its scale, beyond which a run is called off as diverged.
inline constexpr double hopeless_drift = 1e6;

/// A scale is 0 where nothing moves; no relative drift is told then.
struct MotionScales {
  /// J: the largest kinetic energy, or change of the potential energy since the start, whichever is larger; or what the
  /// scenario fixes (energy_scale).
  double energy = 0;
  double linear = 0;  ///< kg m/s: the largest sum of the sizes of the bodies' momenta; √(2 M energy) where all are zero
  /// kg m²/s: the same of the angular momenta, of one body about its reference point, of several about their mass
  /// centre at the start; √(2 tr(I) energy) where all are zero.
  double angular = 0;
  Vector3<double> mass_center = Vector3<double>::Zero();  ///< m, of all moving bodies at the start
  std::vector<double> invariants;  ///< the largest InvariantKind::scale, in the order of the scenario's invariants

  double kinetic_terms = 0;  ///< J: the largest kinetic energy
  /// J: the largest sum, over the forces, of |V| or of Σ |f| |p| + |τ| over the bodies, whichever is larger: times ε,
  /// what the rounding of positions and attitudes makes of the energy. With contact also Σ ½ m v² |p|/r, r the radius
  /// of the body: what it makes of the places where bodies touch.
  double force_terms = 0;
  /// J: the largest kinetic energy of translation under constant forces, whose increments are all rounded alike.
  double steady_terms = 0;

  /// J: up to which an energy drift can be rounding alone after so many steps,
  ///   ε (√steps (16 kinetic_terms + force_terms) + 4 force_terms + steps steady_terms).
  /// √steps is that of a random walk of rounding errors (Brouwer, Astronomical Journal 46 (1937) 149–153): some sixteen
  /// in the velocities, one in the positions of each step. The energy itself is rounded when it is measured. The last
  /// term is a walk whose roundings have one sign.
  double energy_round_off(Precision precision, std::int64_t steps) const;
};

/// With `stop` set it ends at once, with what it has found by then.
MotionScales motion_scales(const Scenario& scenario, double t_end, const std::atomic<bool>* stop = nullptr);

}  // namespace polhode::study
