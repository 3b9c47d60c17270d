// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/findings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/stability/step_map.hpp"
#include "experiments/study/statistics/order_estimate.hpp"

namespace polhode::study::stability {
namespace {

constexpr double theory_width = 1e-6;

std::optional<LinearTheory> linear_theory(const Ladder& ladder) {
  const RunRecord& like = ladder.steps.front().longest();
  const IntegratorEntry* method = find_integrator(like.config.integrator);
  if (method == nullptr || like.config.contact) return std::nullopt;
  const auto radius = [&](double dt) {
    return spectral_radius(*method, like.scenario->problem, like.config.formulation, dt);
  };
  LinearTheory theory;
  std::vector<TriedStep> tried;
  for (const Ladder::Step& step : ladder.steps) {
    theory.radius.push_back(step.verdict == Verdict::none ? std::nullopt : radius(step.dt));
    const auto r = theory.radius.back();
    if (!r) continue;
    theory.smallest = tried.empty() ? *r : std::min(theory.smallest, *r);
    theory.largest = std::max(theory.largest, *r);
    tried.push_back({step.dt, *r <= 1 + radius_tolerance});
  }
  if (tried.empty()) return std::nullopt;
  theory.critical = critical_step(std::move(tried));
  CriticalStep& c = theory.critical;
  while (c.kind == CriticalStep::Kind::found && c.fails - c.holds > theory_width * c.fails) {
    const double middle = std::sqrt(c.holds * c.fails);
    const auto r = radius(middle);
    (r && *r <= 1 + radius_tolerance ? c.holds : c.fails) = middle;
  }
  return theory;
}

using Step = Ladder::Step;

/// The steps below the critical ones of energy growth and of the motion; if there are none, the smallest step.
std::vector<const Step*> usable_steps(const StabilityFinding& f) {
  const auto is_below = [](const Step& step, const CriticalStep& limit) {
    return limit.kind == CriticalStep::Kind::none || step.dt < limit.fails;
  };
  std::vector<const Step*> usable;
  for (const Step& step : f.ladder.steps) {
    if (step.verdict != Verdict::none && is_below(step, f.growth) && is_below(step, f.motion)) usable.push_back(&step);
  }
  if (usable.empty()) usable.push_back(&f.ladder.steps.front());
  return usable;
}

/// The verdict of the largest step, where changes are largest, if the next smaller step has the same; else the most
/// frequent one, the first in the order of Verdict among equals.
Verdict verdict_of(const std::vector<const Step*>& steps) {
  const auto n = steps.size();
  if (n > 1 && steps[n - 1]->verdict == steps[n - 2]->verdict) return steps.back()->verdict;
  std::array<std::size_t, static_cast<std::size_t>(Verdict::none) + 1> seen{};
  for (const Step* step : steps) ++seen[static_cast<std::size_t>(step->verdict)];
  return static_cast<Verdict>(std::max_element(seen.begin(), seen.end()) - seen.begin());
}

std::optional<double> exponent_of(const std::vector<const Step*>& steps, Verdict verdict) {
  constexpr double told = 0.25;
  std::vector<LadderPoint> points;
  for (const Step* step : steps) {
    const auto gain = energy_gain_rate(step->longest());
    if (!gain || step->verdict != verdict) continue;
    const double counted = verdict::counted / step->longest().config.t_end;
    points.push_back({.step = step->dt, .error = std::abs(*gain), .round_off = counted});
  }
  const OrderEstimate fit = estimate_order(std::move(points));
  if (!fit.line || fit.line->half_width_95 > told) return std::nullopt;
  return fit.line->order;
}

std::optional<EnergyGain> gain_of(const std::vector<const Step*>& steps, Verdict verdict) {
  std::vector<const Step*> seen;
  for (const Step* step : steps) {
    if (step->verdict == verdict && energy_gain_rate(step->longest())) seen.push_back(step);
  }
  if (seen.empty() || verdict == Verdict::stable) return std::nullopt;
  const auto rate = [](const Step* step) { return *energy_gain_rate(step->longest()); };
  return EnergyGain{seen.back()->dt, rate(seen.back()), seen.front()->dt, rate(seen.front()),
                    exponent_of(seen, verdict)};
}

}  // namespace

std::vector<StabilityFinding> stability_findings(const Grouping& grouping) {
  std::vector<StabilityFinding> found;
  for (Ladder& ladder : ladders(grouping)) {
    StabilityFinding f;
    f.rate = ladder.rate;
    f.growth = ladder.growth();
    f.blow_up = ladder.blow_up();
    f.motion = ladder.motion();
    f.linear = linear_theory(ladder);
    f.ladder = std::move(ladder);
    for (const Step& step : f.ladder.steps) {
      if (f.motion.kind != CriticalStep::Kind::none && step.dt == f.motion.fails) f.lost = step.lost;
    }
    const auto usable = usable_steps(f);
    f.below = verdict_of(usable);
    f.gain = gain_of(usable, f.below);
    found.push_back(std::move(f));
  }
  return found;
}

}  // namespace polhode::study::stability
