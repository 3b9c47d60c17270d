// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/run.hpp"

#include <chrono>
#include <stdexcept>

#include "experiments/study/drift_meter.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study {
namespace {

Schedule schedule_of(const RunConfig& config) {
  Schedule schedule;
  schedule.t_end = config.t_end;
  schedule.adaptive = !config.dt.has_value();
  schedule.dt = config.dt.value_or(0);
  schedule.samples = config.samples;
  schedule.normalise = config.normalise;
  return schedule;
}

std::string_view status_text(RunStatus status) {
  switch (status) {
    case RunStatus::ok: return "ok";
    case RunStatus::diverged: return "diverged";
    case RunStatus::failed: return "failed";
    default: return "interrupted";
  }
}

template <class S>
RunOutcome run_in(const System<S>& system, const System<double>& truth, const RunConfig& config, Observer& observer,
                  const std::atomic<bool>* stop) {
  IntegratorSettings settings;
  settings.dt = config.dt.value_or(0);
  settings.tolerance = config.tolerance.value_or(0);
  settings.t_end = config.t_end;
  settings.project = config.normalise;
  const auto integrator = find_integrator(config.integrator)->maker<S>()(system, settings);
  State<S> state = system.start();
  return simulate(system, truth, *integrator, state, schedule_of(config), observer, stop);
}

RunOutcome run_on(const System<double>& truth, const RunConfig& config, Observer& observer,
                  const std::atomic<bool>* stop) {
  const auto other = [&]<class S>() {
    const auto system = make_system<S>(truth.problem(), truth.formulation());
    return run_in<S>(*system, truth, config, observer, stop);
  };
  switch (config.precision) {
    case Precision::single: return other.operator()<float>();
    case Precision::extended: return other.operator()<long double>();
    default: return run_in<double>(truth, truth, config, observer, stop);
  }
}

}  // namespace

std::string refusal(const RunConfig& config, const Scenario& scenario) {
  const IntegratorEntry* entry = find_integrator(config.integrator);
  if (!config.formulation.gyroscopic && config.formulation.angular_state == AngularState::momentum_world) {
    return "gyroscopic off makes no sense with the momentum state: dL/dt = torque has no gyroscopic term to leave out";
  }
  const bool has = config.precision == Precision::single     ? static_cast<bool>(entry->make_float)
                   : config.precision == Precision::extended ? static_cast<bool>(entry->make_long_double)
                                                             : static_cast<bool>(entry->make);
  if (!has) return config.integrator + " works in double only, not in " + std::string(name(config.precision));
  if (entry->refusal) {
    if (std::string reason = entry->refusal(scenario.problem, config.formulation); !reason.empty()) {
      return config.integrator + ": " + reason;
    }
  }
  const Schedule schedule = schedule_of(config);
  if (!schedule.adaptive) plan_steps(schedule.t_end, schedule.dt);  // throws on a step that is too small
  return sampling_problem(schedule);
}

RunResult carry_out(const RunConfig& config, const Scenario& scenario, const TrajectoryRequest& trajectory,
                    const std::atomic<bool>* stop) {
  const auto started = std::chrono::steady_clock::now();
  RunResult result;
  const auto truth = make_system<double>(scenario.problem, config.formulation);
  DriftMeter meter(*truth, scenario.invariants, config.t_end, config.samples.has_value());
  const auto writer = open_trajectory(trajectory.format, trajectory.folder, *truth, meter);
  Observer& observer = writer ? static_cast<Observer&>(*writer) : meter;
  RunOutcome outcome;
  try {
    outcome = run_on(*truth, config, observer, stop);
  } catch (const std::bad_alloc&) {
    outcome.status = RunStatus::failed;
    outcome.message = "out of memory";
  }
  if (writer && outcome.status != RunStatus::interrupted) writer->close();  // else it stays unfinished by name
  result.status = status_text(outcome.status);
  result.message = outcome.message;
  result.t_reached = outcome.t;
  result.steps = outcome.steps;
  result.evaluations = outcome.evaluations;
  meter.report(result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return result;
}

}  // namespace polhode::study
