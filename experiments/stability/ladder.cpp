// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/ladder.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/study/characteristic_rate.hpp"

namespace polhode::study {
namespace {

constexpr double least_steps = 500;

template <class Holds>
CriticalStep first_failure(const Ladder& ladder, const Holds& test) {
  std::vector<TriedStep> tried;
  for (const Ladder::Step& step : ladder.steps) tried.push_back({step.dt, test(step.verdict)});
  return critical_step(std::move(tried));
}

/// How long the scan asked its runs to last, from a run that lasts longer than the least number of steps.
double asked_duration(const Ladder& ladder) {
  return ladder.steps.front().run->config.t_end;  // the smallest step is the last to be lengthened
}

}  // namespace

double whole_steps(double t_end, double dt) { return std::max(least_steps, std::ceil(t_end / dt * (1 - 1e-12))) * dt; }

std::optional<double> Ladder::rate() const { return characteristic_rate(steps.front().run->scenario->problem); }

CriticalStep Ladder::growth() const { return first_failure(*this, holds); }

CriticalStep Ladder::blow_up() const {
  return first_failure(*this, [](Verdict v) { return v != Verdict::blown_up; });
}

std::vector<Ladder> ladders(const report::Grouping& grouping) {
  std::vector<Ladder> all;
  for (const report::Curve& curve : grouping.curves) {
    Ladder ladder{&curve};
    for (const RunRecord* run : curve.runs) {
      if (const Verdict v = judge(*run); v != Verdict::none) ladder.steps.push_back({run, *run->config.dt, v});
    }
    std::reverse(ladder.steps.begin(), ladder.steps.end());
    if (!ladder.steps.empty()) all.push_back(std::move(ladder));
  }
  return all;
}

std::vector<RunConfig> bisection(const StudyView& study) {
  const auto grouping = report::group(study);
  std::vector<RunConfig> wanted;
  for (const Ladder& ladder : ladders(grouping)) {
    for (const CriticalStep& critical : {ladder.growth(), ladder.blow_up()}) {
      const auto dt = next_step(critical);
      if (!dt) continue;
      RunConfig config = ladder.steps.front().run->config;
      config.dt = dt;
      config.t_end = whole_steps(asked_duration(ladder), *dt);
      wanted.push_back(std::move(config));
    }
  }
  return wanted;
}

}  // namespace polhode::study
