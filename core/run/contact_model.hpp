// SPDX-License-Identifier: BSD-3-Clause
// The port of contact models. A contact model takes each step in place of the method: it calls the method, resolves the
// contacts and reports the energy that they dissipated or injected. Methods do not depend on it.
#pragma once

#include <cstdint>
#include <limits>

#include "core/run/integrator.hpp"

namespace polhode::inline core::inline run {

/// Energy balance of the contacts since the start of the run, J.
struct ContactLosses {
  double impact = 0;       ///< dissipated along the normals by restitution below 1
  double friction = 0;     ///< dissipated by friction against slip
  double penetration = 0;  ///< injected by corrections that separate penetrating bodies
  /// Net energy (J) that contacts removed: impact + friction − penetration.
  double total() const { return impact + friction - penetration; }
};

/// An impact; one row of events.csv.
struct Impact {
  double t = 0;                                       ///< time, s
  std::size_t a = 0, b = 0;                           ///< indices of the bodies in the problem, a < b
  Vector3<double> point = Vector3<double>::Zero();    ///< contact point, world axes, m
  Vector3<double> normal = Vector3<double>::Zero();   ///< unit contact normal from B to A, world axes
  Vector3<double> impulse = Vector3<double>::Zero();  ///< impulse on A, world axes, N s
  double energy_lost = 0;                             ///< dissipated energy, J
  /// Time (s) at which a truncated Zeno sequence of bounces would have ended without any other event; +inf if it was
  /// not truncated. A sequence is truncated when its bounces are too low to be simulated one by one.
  double rests_from = std::numeric_limits<double>::infinity();
};

/// End of a sliding phase of two bodies. After it they stick, roll, or slide in another direction.
struct Transition {
  double t = 0;                                      ///< time, s
  std::size_t a = 0, b = 0;                          ///< indices of the bodies in the problem, a < b
  Vector3<double> point = Vector3<double>::Zero();   ///< contact point, world axes, m
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit contact normal from B to A, world axes
};

/// Interface of a contact model. One object serves one run.
class ContactModel {
 public:
  ContactModel() = default;
  ContactModel(const ContactModel&) = delete;
  ContactModel& operator=(const ContactModel&) = delete;
  virtual ~ContactModel() = default;

  /// Prepares a run from the initial `state`. Called once, before the method's begin(). The model may register event
  /// functions with the method here.
  virtual void begin(Integrator<double>& method, const State<double>& state) = 0;

  /// Advances `state` by one step of the method with contacts resolved, so that bodies do not pass through each other.
  /// The step length is h (s) for a fixed-step method and at most h for an adaptive one. A failed step leaves the state
  /// unchanged.
  virtual StepResult step(Integrator<double>& method, State<double>& state, double h) = 0;

  /// Energy balance of the contacts since begin().
  virtual const ContactLosses& losses() const = 0;

  /// Impacts that occurred in the last step.
  virtual std::span<const Impact> impacts() const = 0;

  /// Ends of sliding phases in the last step. Empty for a model that does not locate their times.
  virtual std::span<const Transition> transitions() const { return {}; }

  /// True if the last step ended the run, even before the requested end time.
  virtual bool ended() const { return false; }
};

}  // namespace polhode::core::run
