// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "collision/contact/impact_timing.hpp"
#include "core/run/setting.hpp"
#include "core/run/simulate_ensemble.hpp"
#include "core/system/invariants.hpp"
#include "experiments/study/metrics/contact_meter.hpp"
#include "experiments/study/metrics/drift_meter.hpp"
#include "experiments/study/metrics/joint_meter.hpp"
#include "experiments/study/metrics/lane_meter.hpp"
#include "experiments/study/record/result_numbers.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/narrow_phase_choice.hpp"
#include "experiments/study/setup/run_setup.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline run {
namespace {

std::string_view status_text(RunStatus status) {
  switch (status) {
    case RunStatus::ok: return "ok";
    case RunStatus::diverged: return "diverged";
    case RunStatus::failed: return "failed";
    default: return "interrupted";
  }
}

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Measures the part of its duration that a run has done.
class ShareMeter final : public Observer {
 public:
  ShareMeter(std::atomic<double>& share, double t_end) : share_(share), t_end_(t_end) {}

  void on_start(const State<double>&, const Sample&) override {}
  std::size_t on_samples(std::span<const Sample> samples) override {
    if (!samples.empty()) share_.store(samples.back().t / t_end_, std::memory_order_relaxed);
    return samples.size();
  }
  void on_state(const State<double>&, const Sample&) override {}
  double next_state() const override { return std::numeric_limits<double>::infinity(); }

 private:
  std::atomic<double>& share_;
  double t_end_;
};

RunResult result_of(const RunOutcome& outcome, DriftMeter& meter, double seconds) {
  RunResult result;
  result.status = status_text(outcome.status);
  result.message = outcome.message;
  result.t_reached = outcome.t;
  result.steps = outcome.steps;
  result.evaluations = outcome.evaluations;
  meter.report(result);
  result.seconds = seconds;
  return result;
}

/// `seconds`: of the way from the start to the end, without what is made before it.
template <class S>
RunOutcome run_in(const System<S>& system, const System<double>& truth, const RunConfig& config, Observer& observer,
                  const std::atomic<bool>* stop, double& seconds, ContactModel* contact = nullptr) {
  const auto integrator = integrator_of<S>(config, system);
  State<S> state = system.start();
  const auto started = Clock::now();
  RunOutcome outcome = simulate(system, truth, *integrator, state, schedule_of(config), observer, stop, contact);
  seconds = seconds_since(started);
  return outcome;
}

RunOutcome run_on(const System<double>& truth, const RunConfig& config, Observer& observer,
                  const std::atomic<bool>* stop, double& seconds, ContactModel* contact) {
  const auto other = [&]<class S>() {
    const auto system = make_system<S>(truth.problem(), truth.formulation());
    return run_in<S>(*system, truth, config, observer, stop, seconds);
  };
  switch (config.precision) {
    case Precision::single_precision: return other.operator()<float>();
    case Precision::extended_precision: return other.operator()<long double>();
    default: return run_in<double>(truth, truth, config, observer, stop, seconds, contact);
  }
}

TrueMotion true_motion_of(const RunConfig& config, const Scenario& scenario, const std::atomic<bool>* stop,
                          References* shared) {
  References own;
  return (shared ? *shared : own).of(config, scenario, stop);
}

/// The outcome of a run, which is its failure where something is thrown out of it.
template <class Run>
RunOutcome guarded(const Scenario& scenario, const Run& run) {
  RunOutcome outcome;
  try {
    return run();
  } catch (const TrajectoryError&) {
    throw;
  } catch (const std::bad_alloc&) {
    outcome.message =
        fmt::format("out of memory, with {} bodies; take fewer of them, or fewer runs at a time with --jobs",
                    scenario.problem.bodies.size());
  } catch (const std::exception& error) {
    outcome.message = error.what();
  }
  outcome.status = RunStatus::failed;
  return outcome;
}

RunResult measured(const RunConfig& config, const Scenario& scenario, const TrajectoryRequest& trajectory,
                   const std::atomic<bool>* stop, References* references, std::atomic<double>* share) {
  const auto truth = make_system<double>(scenario.problem, formulation_of(config));
  std::optional<ContactSetup> contact;
  if (config.contact) contact.emplace(*truth, scenario, *config.contact);
  const TrueMotion motion = true_motion_of(config, scenario, stop, references);
  DriftMeter meter(*truth, scenario.invariants, config.t_end, config.samples.has_value(), motion, config.precision);
  std::optional<ContactMeter> contact_meter;
  if (config.contact) contact_meter.emplace(*truth, scenario, *config.contact, config.t_end);
  const auto writer =
      trajectory.open ? trajectory.open(*truth) : open_trajectory(trajectory.format, trajectory.folder, *truth);
  Observers observers;
  if (writer) observers.add(*writer);
  if (contact_meter) observers.add(*contact_meter);
  std::optional<JointMeter> joint_meter;
  if (config.joints) observers.add(joint_meter.emplace(*truth, config.t_end, motion.reference));
  observers.add(meter);
  std::optional<ShareMeter> share_meter;
  if (share) observers.add(share_meter.emplace(*share, config.t_end));
  double seconds = 0;
  const RunOutcome outcome = guarded(scenario, [&] {
    return run_on(*truth, config, observers, stop, seconds, contact ? contact->model.get() : nullptr);
  });
  if (writer && outcome.status != RunStatus::interrupted) writer->close();  // else it stays unfinished by name
  RunResult result = result_of(outcome, meter, seconds);
  if (contact_meter) contact_meter->report(result);
  if (joint_meter) {
    joint_meter->report(result);
    result.joints.solves = static_cast<double>(outcome.joint_solves);
    if (outcome.iterations) result.joints.iterations = static_cast<double>(*outcome.iterations);
  }
  return result;
}

/// Runs side by side, each with a meter of its own.
class SideBySide final : public EnsembleObserver {
 public:
  explicit SideBySide(const LanedWork& work) : work_(work), finished_(work.runs.size()) {
    for (const LanedRun& run : work.runs) steps_ += steps_of(run.config);
  }

  void carry_out() {
    const RunConfig& config = work_.runs.front().config;
    const EnsembleParts parts = {
        .next = [this](std::size_t lane) { return next(lane); },
        .method = [&](const System<Lanes>& system) { return integrator_of<Lanes>(config, system); },
        .watched =
            [&](std::span<const Problem> problems) {
              std::vector<LaneQuantity> invariants;
              for (const std::string& name : work_.runs.front().scenario.invariants)
                invariants.push_back(find_invariant(name)->in_lanes(problems));
              return invariants;
            }};
    simulate_ensemble(parts, *this, work_.stop);
  }

  /// Carries out the runs without a result, one by one.
  void carry_out_rest() {
    for (std::size_t run = 0; run < work_.runs.size(); ++run) {
      if (finished_[run]) continue;
      if (work_.no_more && *work_.no_more) return;
      const auto& [config, scenario, keeps_curves] = work_.runs[run];
      finish(run, study::carry_out(config, scenario, {}, work_.stop, work_.references));
    }
  }

  Observer& of_lane(std::size_t lane) override { return *lanes_[lane].meter; }
  void on_begin(std::size_t lane) override { meter_.begin(lane, *lanes_[lane].meter); }
  void on_samples(const LaneBlock& block, std::span<const bool> running, std::span<std::size_t> accepted) override {
    meter_.on_samples(block, running, accepted);
    if (!work_.share) return;
    const auto under_way = static_cast<double>(std::count(running.begin(), running.end(), true));
    steps_done_ += under_way * static_cast<double>(block.samples.size());
    work_.share->store(std::min(steps_done_ / steps_, 1.0), std::memory_order_relaxed);
  }
  void on_states(const LaneStates& states, std::span<bool> due) override { meter_.on_states(states, due); }
  void on_end(std::size_t lane, RunOutcome&& outcome, double seconds) override {
    meter_.end(lane);
    RunResult result = result_of(outcome, *lanes_[lane].meter, seconds);
    keep_finite(result);
    finish(lanes_[lane].run, std::move(result));
  }

 private:
  struct Lane {
    std::size_t run = 0;
    std::unique_ptr<System<double>> truth;
    std::unique_ptr<DriftMeter> meter;
  };

  static double steps_of(const RunConfig& config) { return config.t_end / *config.dt; }

  std::optional<LaneRun> next(std::size_t lane) {
    if (next_ == work_.runs.size() || (work_.no_more && *work_.no_more)) return std::nullopt;
    const LanedRun& run = work_.runs[next_];
    Lane& place = lanes_[lane];
    place.run = next_++;
    place.meter.reset();  // before the system that it measures
    place.truth = make_system<double>(run.scenario.problem, formulation_of(run.config));
    place.meter = std::make_unique<DriftMeter>(*place.truth, run.scenario.invariants, run.config.t_end, false,
                                               true_motion_of(run.config, run.scenario, work_.stop, work_.references));
    place.meter->expect_invariants();
    if (!run.keeps_curves) place.meter->leave_out_curves();
    return LaneRun{place.truth.get(), schedule_of(run.config)};
  }

  void finish(std::size_t run, RunResult&& result) {
    finished_[run] = true;
    work_.finish(run, std::move(result));
  }

  const LanedWork& work_;
  std::vector<bool> finished_;
  std::size_t next_ = 0;
  std::array<Lane, std::size_t(lane_count)> lanes_;
  LaneMeter meter_;
  double steps_ = 0, steps_done_ = 0;  ///< steps of all runs; those that are done
};

/// The reason for which a method and options cannot answer contacts and joints together; empty if they can.
std::string refusal_of_contact_with_joints(const RunConfig& config, const Declaration& declared) {
  if (!config.contact || !config.joints || config.contact->impact_timing.empty()) return {};
  if (declared.adaptive)
    return config.integrator +
           " chooses its own steps, and contacts are answered together with joints at the steps; take a method of "
           "fixed steps, or --response compliant";
  if (!find_impact_timing(config.contact->impact_timing)->fixed_steps_only)
    return config.contact->impact_timing +
           " follows the flight of single bodies, which joints hold; take --impact-timing time_stepping, or --response "
           "compliant";
  if (declared.solves_joints())
    return config.integrator +
           " solves the equations of joints in a way of its own, without contacts; take a method that integrates the "
           "index-1 form, or --response compliant";
  if (formulation_of(config).joints.is_soft())
    return std::string(name(config.joints->stabilization)) +
           " makes the joints soft, and contacts are answered together with rigid ones; take another --stabilization, "
           "or --response compliant";
  return {};
}

}  // namespace

std::string refusal(const RunConfig& config, const Scenario& scenario) {
  const IntegratorEntry* entry = find_integrator(config.integrator);
  if (!config.formulation.gyroscopic && config.formulation.angular_state == AngularState::momentum_world) {
    return "gyroscopic off makes no sense with the momentum state: dL/dt = torque has no gyroscopic term to leave out";
  }
  const bool has = config.precision == Precision::single_precision     ? static_cast<bool>(entry->make_float)
                   : config.precision == Precision::extended_precision ? static_cast<bool>(entry->make_long_double)
                                                                       : static_cast<bool>(entry->make);
  if (!has) return config.integrator + " works in double only, not in " + std::string(name(config.precision));
  if (config.tolerance && *config.tolerance < epsilon(config.precision)) {
    return fmt::format("{}: a tolerance of {:g} is below the {:.2g} to which numbers are kept in {}", config.integrator,
                       *config.tolerance, epsilon(config.precision), name(config.precision));
  }
  const Declaration& declared = entry->declaration;
  if (std::string fault = settings_fault(declared.settings, config.settings); !fault.empty())
    return config.integrator + " " + fault;
  if (is_compensated(config) && !entry->declaration.additive) {
    return config.integrator + (entry->declaration.adaptive
                                    ? ": compensated summation is for methods of a fixed step"
                                    : ": compensated summation makes no sense: its step is not the sum of the state "
                                      "and an increment");
  }
  if (config.joints && config.joints->alpha_per_step) {
    if (!config.dt) return config.integrator + " chooses its own steps; leave --baumgarte-per-step out";
    if (config.joints->alpha || config.joints->beta)
      return "Baumgarte's parameters are given twice; leave --baumgarte-per-step out, or --baumgarte-alpha and -beta";
  }
  if (config.contact) {
    if (config.precision != Precision::double_precision)
      return "contact works in double only, not in " + std::string(name(config.precision));
    if (config.reference) return "no reference can be made of a motion with contact; leave --reference out";
    if (std::string reason = refusal_of_contact_with_joints(config, declared); !reason.empty()) return reason;
    const std::string& timing = config.contact->impact_timing;
    if (declared.adaptive && !timing.empty() && find_impact_timing(timing)->fixed_steps_only) {
      return config.integrator + " chooses its own steps, and " + timing +
             " is about steps; take --impact-timing event_located";
    }
    if (scenario.end_at_contact && !find_response(config.contact->response)->make) {
      return config.contact->response + " knows no impacts for end_at_contact to end at; take another --response";
    }
    if (std::string reason = narrow_phase_refusal(config.contact->narrow_phase, scenario); !reason.empty())
      return reason;
  }
  if (entry->refusal) {
    if (std::string reason = entry->refusal(scenario.problem, formulation_of(config)); !reason.empty()) {
      return config.integrator + ": " + reason;
    }
  }
  const Schedule schedule = schedule_of(config);
  if (!schedule.adaptive) plan_steps(schedule.t_end, schedule.dt);  // throws on a step that is too small
  return sampling_problem(schedule);
}

RunResult carry_out(const RunConfig& config, const Scenario& scenario, const TrajectoryRequest& trajectory,
                    const std::atomic<bool>* stop, References* references, std::atomic<double>* share) {
  RunResult result;
  const RunOutcome outcome = guarded(scenario, [&] {
    result = measured(config, scenario, trajectory, stop, references, share);
    return RunOutcome{};
  });
  if (outcome.status == RunStatus::failed) {
    result = {};
    result.status = status_text(outcome.status);
    result.message = outcome.message;
  }
  keep_finite(result);
  return result;
}

std::string ensemble_key(const RunConfig& config, const Scenario& scenario, const TrajectoryRequest& trajectory) {
  const auto& options = run_options();
  const bool usual = std::all_of(options.begin(), options.end(),
                                 [&](const RunOption& o) { return !o.on_demand || is_usual(o, config); });
  const bool plain = config.dt && !config.contact && !config.samples &&
                     config.precision == Precision::double_precision && usual &&
                     trajectory.format == TrajectoryFormat::none;
  if (!plain || !find_integrator(config.integrator)->make_lanes) return {};
  const std::string key = lane_key(scenario.problem);
  if (key.empty()) return {};
  const Formulation& f = config.formulation;
  return fmt::format("{} {} {} {} {} {} {} {}", key, config.integrator, name(f.orientation), name(f.angular_state),
                     f.gyroscopic, name(f.rotation_from), config.normalize, fmt::join(scenario.invariants, " "));
}

void carry_out_together(const LanedWork& work) {
  SideBySide runs(work);
  try {
    runs.carry_out();
  } catch (const std::exception&) {
    runs.carry_out_rest();
  }
}

}  // namespace polhode::study::run
