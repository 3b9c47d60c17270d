// SPDX-License-Identifier: BSD-3-Clause
// The loop: steps a method over a system, projects, observes, and stops where the numbers end.
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

namespace polhode {

/// When a run steps, looks and ends.
struct Schedule {
  double t_end = 1;       ///< s
  double dt = 1e-3;       ///< s, of fixed-step methods; the last step is shortened if it does not divide
  bool adaptive = false;  ///< the method chooses its steps; dt is not read
  std::optional<std::int64_t>
      samples;             ///< observe at t0 + k (t_end − t0)/samples, hit exactly; absent: after every step
  bool normalise = false;  ///< project every orientation after each step
  /// An adaptive method that is not at t_end after so many steps has failed. Fixed steps are counted before they are
  /// taken.
  std::int64_t most_steps = 100'000'000;
  /// The sizes (s) of fixed steps, asked for one at a time, in the place of dt: the run ends where it gives 0, or at
  /// t_end, beyond which no step goes. Every step is observed. Absent: all are dt.
  std::function<double()> next_step{};
};

enum class RunStatus {
  ok,
  diverged,    ///< the state ceased to be finite, or the observer called it off
  failed,      ///< the method gave up
  interrupted  ///< asked to stop from outside; nothing can be said of the run
};

struct RunOutcome {
  RunStatus status = RunStatus::ok;
  std::string message;
  double t = 0;  ///< s, reached
  std::int64_t steps = 0;
  std::int64_t evaluations = 0;  ///< right-hand sides
};

/// Division of a run into fixed steps: `whole` steps of dt, then one step of `last` (s) unless that is 0.
struct StepPlan {
  std::int64_t whole = 0;
  double last = 0;
};
/// Throws std::invalid_argument unless 0 < dt and 0 < t_end, both finite.
StepPlan plan_steps(double t_end, double dt);

/// Empty if the samples of the schedule fall on whole steps; otherwise says what would.
std::string sampling_problem(const Schedule& schedule);

/// Runs from `state`, at its time, to schedule.t_end. Energies are measured on `truth`, the same system in double.
/// Memory does not depend on the number of steps. `stop`, when given, is looked at after every call of the method, of
/// at most 64 steps, and after each look of the observer, which may set it. `contact`, when given, takes the steps in
/// the method's place, and may end the run; in double only, else std::invalid_argument. That is thrown too where
/// next_step gives what is no step. What a method or the contact throws in a step (but std::bad_alloc) is its failure,
/// or a divergence where the state is no longer finite.
template <class S>
RunOutcome simulate(const System<S>& system, const System<double>& truth, Integrator<S>& integrator, State<S>& state,
                    const Schedule& schedule, Observer& observer, const std::atomic<bool>* stop = nullptr,
                    ContactModel* contact = nullptr);

}  // namespace polhode
