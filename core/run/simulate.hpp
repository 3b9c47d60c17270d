// SPDX-License-Identifier: BSD-3-Clause
// The simulation loop: advances a system by a method, projects, passes samples to an observer, and ends the run at its
// end time or when the state is no longer finite.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "core/run/contact_model.hpp"
#include "core/run/integrator.hpp"
#include "core/run/observer.hpp"
#include "core/system/system.hpp"

namespace polhode::inline core::inline run {

/// Step sizes, sample times and end of a run.
struct Schedule {
  double t_end = 1;       ///< end time, s
  double dt = 1e-3;       ///< fixed step size, s; the last step is shorter if dt does not divide the duration
  bool adaptive = false;  ///< the method controls its step size; dt is ignored
  std::optional<std::int64_t>
      samples;             ///< number of samples, exactly at t0 + k (t_end − t0)/samples; absent: after every step
  bool normalize = false;  ///< project every orientation after each step
  /// Maximum number of steps of an adaptive method. A run that has not reached t_end by then has failed. Fixed-step
  /// methods ignore it: the number of their steps is known beforehand.
  std::int64_t most_steps = 100'000'000;
  /// Size (s) of the next fixed step, in place of dt; called once for each step. The run ends when it returns 0, or at
  /// t_end; a step that would pass t_end is shortened. Every step is sampled. Absent: every step is dt.
  std::function<double()> next_step{};
};

/// The end of a run.
enum class RunStatus {
  ok,          ///< the run reached its end time, or the end that its schedule or contact model set
  diverged,    ///< the state was no longer finite, or the observer rejected a sample
  failed,      ///< the method could not continue
  interrupted  ///< stopped from outside; the result is incomplete
};

/// Outcome of a run.
struct RunOutcome {
  RunStatus status = RunStatus::ok;
  std::string message;                       ///< reason for an early end; empty if the run is ok
  double t = 0;                              ///< time reached, s
  std::int64_t steps = 0;                    ///< number of steps taken
  std::int64_t evaluations = 0;              ///< number of right-hand side evaluations
  std::optional<std::int64_t> iterations{};  ///< number of iterations of the method; absent: it makes none
  std::int64_t joint_solves =
      0;  ///< number of linear systems of the joints that the method and projections have solved
};

/// Division of a run into fixed steps: `whole` steps of dt, then one step of `last` (s) unless that is 0.
struct StepPlan {
  std::int64_t whole = 0;
  double last = 0;
};
/// Divides the duration t_end (s) into steps of dt (s). Throws std::invalid_argument unless dt and t_end are positive
/// and finite and there are at most 9e15 steps.
StepPlan plan_steps(double t_end, double dt);

/// Error message if the samples of the schedule do not fall on whole steps, with a step size that fits; else empty.
std::string sampling_problem(const Schedule& schedule);

/// Runs from the time of `state` to schedule.t_end. Memory use does not depend on the number of steps.
///   truth:    the same system in double, on which energies are measured.
///   stop:     if given, requests the end of the run. It is read after every call of the method (at most 64 steps) and
///             after each on_state() of the observer, which may set it.
///   contact:  if given, takes the steps in place of the method and may end the run. Double only.
/// Throws std::invalid_argument for invalid fixed steps (see plan_steps), for a contact model in another scalar, for
/// samples together with next_step, and for a step from next_step that is negative or not finite. An exception (except
/// std::bad_alloc) from a step of the method or the contact model becomes the status failed, or diverged if the state
/// is no longer finite.
template <class S>
RunOutcome simulate(const System<S>& system, const System<double>& truth, Integrator<S>& integrator, State<S>& state,
                    const Schedule& schedule, Observer& observer, const std::atomic<bool>* stop = nullptr,
                    ContactModel* contact = nullptr);

}  // namespace polhode::core::run
