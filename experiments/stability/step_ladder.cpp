// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/step_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/stability/step_map.hpp"
#include "experiments/study/scenario/characteristic_rate.hpp"

namespace polhode::study::stability {
namespace {

constexpr double least_steps = 500;
constexpr double motion_bracket_width = 0.01;  // wide, since the bounds of a followed motion are rough
constexpr double turns_without_rate = 10;      // turns in a run of a motion without a characteristic rate

/// The critical step from which the verdict is at least `from`, over the steps with a verdict.
CriticalStep first_growth(const Ladder& ladder, Verdict from) {
  std::vector<TriedStep> tried;
  for (const Ladder::Step& step : ladder.steps) {
    if (step.verdict != Verdict::none) tried.push_back({step.dt, step.verdict < from});
  }
  return critical_step(std::move(tried));
}

/// t_end rounded up to whole steps, s.
double whole_steps_only(double t_end, double dt) { return std::ceil(t_end / dt * (1 - 1e-12)) * dt; }

bool is_longer(const RunRecord& run, double t_end) { return run.config.t_end > t_end * (1 + 1e-9); }

/// Time unit of slow gains, s (Ladder::turn). Absent for a linear system with a characteristic rate, in which every
/// growth is exponential. A system with contact is not linear.
std::optional<double> turn_of(const RunConfig& config, const Scenario& scenario, std::optional<double> rate) {
  if (!rate) return config.t_end / turns_without_rate;
  if (!config.contact && is_linear(*make_system<double>(scenario.problem, config.formulation))) return std::nullopt;
  return 2 * std::numbers::pi / *rate;
}

/// The runs of a curve by step.
std::vector<Ladder::Step> steps_of(const Curve& curve) {
  std::vector<const RunRecord*> runs;
  for (const RunRecord* run : curve.runs) {
    if (run->result.status != "refused") runs.push_back(run);
  }
  std::stable_sort(runs.begin(), runs.end(), [](const RunRecord* a, const RunRecord* b) {
    return std::pair(*a->config.dt, a->config.t_end) < std::pair(*b->config.dt, b->config.t_end);
  });
  std::vector<Ladder::Step> steps;
  for (const RunRecord* run : runs) {
    const double dt = *run->config.dt;
    if (steps.empty() || steps.back().dt != dt) steps.push_back({.dt = dt});
    steps.back().runs.push_back(run);
  }
  return steps;
}

bool gains_nothing(Verdict v) { return v == Verdict::stable || v == Verdict::damped; }

/// The verdict of the shortest run that has one. If it is a gain and the longest run has none, that of the longest run,
/// which distinguishes an oscillation from a permanent change.
Verdict ladder_verdict(const Ladder::Step& step, std::optional<double> turn) {
  for (const RunRecord* run : step.runs) {
    const Verdict verdict = energy_verdict(*run, turn);
    if (verdict == Verdict::none) continue;
    const Verdict last = energy_verdict(step.longest(), turn);
    return !holds(verdict) && gains_nothing(last) ? last : verdict;
  }
  return Verdict::none;
}

/// The smallest step at which the energy is gained, if it is isolated: no energy is gained at the next larger step.
/// Null if it is not.
const Ladder::Step* lone_growth(const Ladder& ladder) {
  const auto& steps = ladder.steps;
  const auto first = std::find_if(steps.begin(), steps.end(), [](const auto& s) {
    return s.verdict == Verdict::gaining || s.verdict == Verdict::blown_up;
  });
  if (first == steps.end() || first->verdict == Verdict::blown_up) return nullptr;
  const auto next = std::find_if(first + 1, steps.end(), [](const auto& s) { return s.verdict != Verdict::none; });
  return next != steps.end() && gains_nothing(next->verdict) ? &*first : nullptr;
}

/// The step at which the motion is first lost.
const Ladder::Step* first_lost(const Ladder& ladder) {
  const auto& steps = ladder.steps;
  const auto first = std::find_if(steps.begin(), steps.end(), [](const auto& s) { return s.lost != Lost::nothing; });
  return first == steps.end() ? nullptr : &*first;
}

class Wanted {
 public:
  void add(const Ladder& ladder, double dt, double t_end) {
    RunConfig config = ladder.steps.front().longest().config;
    config.dt = dt;
    config.t_end = t_end;
    configs.push_back(std::move(config));
  }
  std::vector<RunConfig> configs{};
};

}  // namespace

double whole_steps(double t_end, double dt) { return std::max(least_steps * dt, whole_steps_only(t_end, dt)); }

Verdict energy_verdict(const RunRecord& run, std::optional<double> turn) {
  return run.config.t_end < (1 - 1e-9) * least_steps * *run.config.dt ? Verdict::none : stability_verdict(run, turn);
}

CriticalStep Ladder::growth() const { return first_growth(*this, Verdict::gaining); }
CriticalStep Ladder::blow_up() const { return first_growth(*this, Verdict::blown_up); }
CriticalStep Ladder::motion() const {
  std::vector<TriedStep> tried;
  for (const Step& step : steps) tried.push_back({step.dt, step.lost == Lost::nothing});
  return critical_step(std::move(tried));
}

std::vector<Ladder> ladders(const Grouping& grouping) {
  std::vector<Ladder> all;
  for (const Curve& curve : grouping.curves) {
    Ladder ladder{.curve = &curve, .steps = steps_of(curve)};
    if (ladder.steps.empty()) continue;
    const RunConfig& config =
        ladder.steps.front().shortest().config;  // the smallest step: rounding up changes its duration least
    const Scenario& scenario = *ladder.steps.front().shortest().scenario;
    ladder.rate = characteristic_rate(scenario.problem);
    ladder.turn = turn_of(config, scenario, ladder.rate);
    ladder.duration = config.t_end;
    ladder.displacement = exact_displacement(scenario.problem, config.formulation, ladder.duration);
    for (Ladder::Step& step : ladder.steps) {
      step.verdict = ladder_verdict(step, ladder.turn);
      step.lost = what_is_lost(step.shortest(), ladder.displacement);
      ladder.measured = ladder.measured || has_known_motion(step.shortest());
    }
    all.push_back(std::move(ladder));
  }
  return all;
}

std::vector<RunConfig> bisection(const StudyView& study) {
  const auto grouping = group(study);
  Wanted wanted;
  for (const Ladder& ladder : ladders(grouping)) {
    const auto halve = [&](const CriticalStep& critical) {
      if (const auto dt = next_step(critical)) wanted.add(ladder, *dt, whole_steps(ladder.duration, *dt));
    };
    const CriticalStep motion = ladder.motion();
    const Ladder::Step* const lone = lone_growth(ladder);
    const double confirmed = lone ? confirmed_by * whole_steps(ladder.duration, lone->dt) : 0;
    if (lone && !is_longer(lone->longest(), 0.99 * confirmed)) wanted.add(ladder, lone->dt, confirmed);
    else halve(ladder.growth());
    halve(ladder.blow_up());
    const Ladder::Step* const lost = first_lost(ladder);
    const double enough = lost ? whole_steps_only(ladder.duration, lost->dt) : 0;
    if (lost && is_longer(lost->shortest(), enough)) wanted.add(ladder, lost->dt, enough);
    else if (const auto dt = next_step(motion, motion_bracket_width))
      wanted.add(ladder, *dt, whole_steps_only(ladder.duration, *dt));
  }
  return std::move(wanted.configs);
}

}  // namespace polhode::study::stability
