// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/findings.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/study/step_map.hpp"

namespace polhode::study {
namespace {

constexpr double theory_width = 1e-6;

std::optional<LinearTheory> linear_theory(const Ladder& ladder) {
  const RunRecord& like = *ladder.steps.front().run;
  const IntegratorEntry* method = find_integrator(like.config.integrator);
  if (method == nullptr) return std::nullopt;
  const auto radius = [&](double dt) {
    return spectral_radius(*method, like.scenario->problem, like.config.formulation, dt);
  };
  LinearTheory theory;
  std::vector<TriedStep> tried;
  for (const Ladder::Step& step : ladder.steps) {
    theory.radius.push_back(radius(step.dt));
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

}  // namespace

std::vector<StabilityFinding> stability_findings(const report::Grouping& grouping) {
  std::vector<StabilityFinding> found;
  for (Ladder& ladder : ladders(grouping)) {
    StabilityFinding f;
    f.rate = ladder.rate();
    f.growth = ladder.growth();
    f.blow_up = ladder.blow_up();
    f.linear = linear_theory(ladder);
    f.ladder = std::move(ladder);
    found.push_back(std::move(f));
  }
  return found;
}

}  // namespace polhode::study
