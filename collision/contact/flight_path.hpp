// SPDX-License-Identifier: BSD-3-Clause
// The states of the system during a flight, the motion between two impacts.
#pragma once

#include "core/run/integrator.hpp"

namespace polhode::inline collision::inline contact {

/// Advances the state by h (s) in as many steps as the method needs. Fails after a million steps.
StepResult advance(Integrator<double>& method, State<double>& state, double h);

/// Evaluates the state at any time of a flight.
class FlightPath {
 public:
  /// `one_step` states that the flight equals the last step of the method, so that its dense output covers the flight.
  /// `start` must outlive the path.
  FlightPath(Integrator<double>& method, const State<double>& start, bool one_step)
      : method_(method), start_(start), dense_(one_step ? method.dense_output() : nullptr) {}

  /// Sets `there` to the state at time s (s) after the start, by dense output or by new steps from the start. False if
  /// the method fails.
  bool state_at(double s, State<double>& there);

  /// True if state_at() has taken steps with the method. Its history then does not belong to the end of the flight.
  bool stepped_method() const { return stepped_method_; }

 private:
  Integrator<double>& method_;
  const State<double>& start_;
  const DenseOutput<double>* dense_;  ///< null: the state between is found by new steps
  bool stepped_method_ = false;
};

}  // namespace polhode::collision::contact
