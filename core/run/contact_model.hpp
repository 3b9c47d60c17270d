// SPDX-License-Identifier: BSD-3-Clause
// The port of contact: what the loop asks of bodies that meet. It takes a step in the method's place, with the method,
// and says where energy went. Methods know nothing of it.
#pragma once

#include <cstdint>
#include <limits>

#include "core/run/integrator.hpp"

namespace polhode {

/// Where energy went in contacts, J since the start.
struct ContactLosses {
  double impact = 0;       ///< lost along normals: what restitution below 1 takes
  double friction = 0;     ///< lost against slip
  double penetration = 0;  ///< injected by pushing bodies out of each other; lifting them costs
  double total() const { return impact + friction - penetration; }
};

/// An impact, as events.csv shows it.
struct Impact {
  double t = 0;                                       ///< s
  std::size_t a = 0, b = 0;                           ///< bodies, a < b, in the problem's order
  Vector3<double> point = Vector3<double>::Zero();    ///< m, world
  Vector3<double> normal = Vector3<double>::Zero();   ///< unit, world, from B to A
  Vector3<double> impulse = Vector3<double>::Zero();  ///< N s, on A
  double energy_lost = 0;                             ///< J
  /// s: where the bounces that follow are too low to be flown, when the last of them would end if nothing else
  /// happened; else infinite.
  double rests_from = std::numeric_limits<double>::infinity();
};

/// Where the slide of two bodies on each other ends: from here on they stick, or roll, or slide another way.
struct Transition {
  double t = 0;                                      ///< s
  std::size_t a = 0, b = 0;                          ///< bodies, a < b, in the problem's order
  Vector3<double> point = Vector3<double>::Zero();   ///< m, world
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit, world, from B to A
};

class ContactModel {
 public:
  ContactModel() = default;
  ContactModel(const ContactModel&) = delete;
  ContactModel& operator=(const ContactModel&) = delete;
  virtual ~ContactModel() = default;

  /// Prepares a run that starts at this state; called once, before the method's begin(), which may get events to look
  /// for.
  virtual void begin(Integrator<double>& method, const State<double>& state) = 0;

  /// A step of the method in which bodies do not pass through each other: by h, or by at most h of a method that
  /// chooses its steps. A failed step leaves the state as it was.
  virtual StepResult step(Integrator<double>& method, State<double>& state, double h) = 0;

  /// Where energy went since begin().
  virtual const ContactLosses& losses() const = 0;

  /// The impacts of the last step.
  virtual std::span<const Impact> impacts() const = 0;

  /// The transitions of the last step, of a model that finds their time.
  virtual std::span<const Transition> transitions() const { return {}; }

  /// True where the run is over with the last step, at whatever time that ended.
  virtual bool ended() const { return false; }
};

}  // namespace polhode
