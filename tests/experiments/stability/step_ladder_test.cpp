// SPDX-License-Identifier: BSD-3-Clause
// The treatment of a lone verdict on made-up scans.
#include "experiments/stability/step_ladder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"
#include "tests/experiments/stability/made_up_run.hpp"

namespace polhode::study::stability::step_ladder_test {
namespace {

/// Runs of RK4 on a top by their steps, with an energy that swings, or is gained, as `gain` says of (step, duration).
struct MadeUpScan {
  StudyView study;
  std::shared_ptr<const Scenario> scenario =
      std::make_shared<const Scenario>(ScenarioSource::open("hairer_vilmart").resolve());
  std::function<double(double, double)> gain;

  void add(double dt, double t_end) {
    const double size = gain(dt, t_end);
    RunRecord run = run_of([&](double t) { return size * t + 1e-3 * swing(t); });
    for (SeriesPoint& p : run.result.series) p.t *= t_end;
    run.result.t_reached = t_end;
    run.config.scenario = "hairer_vilmart";
    run.config.integrator = "rk4";
    run.config.dt = dt;
    run.config.t_end = t_end;
    run.scenario = scenario;
    run.result.attitude_error_max = 0;
    run.result.position_error_max = 0;
    study.runs.push_back(std::move(run));
  }
  Ladder ladder() const {
    const auto grouping = group(study);
    Ladder found = ladders(grouping).at(0);
    found.curve = nullptr;  // it goes with the grouping
    return found;
  }
};

MadeUpScan scan_of(const std::vector<double>& steps, const std::function<double(double, double)>& gain) {
  MadeUpScan scan;
  scan.study.durations_follow_steps = true;
  scan.gain = gain;
  for (const double dt : steps) scan.add(dt, whole_steps(40, dt));
  return scan;
}

TEST(StepLadder, ALoneGainIsRunAgainForLongerBeforeItDecides) {
  // A swing of the energy that lasts longer than 40 s looks like a gain at the step 0.04.
  auto scan =
      scan_of({0.01, 0.02, 0.04, 0.08}, [](double dt, double t_end) { return dt == 0.04 && t_end < 100 ? 0.5 : 0.0; });
  EXPECT_EQ(scan.ladder().growth().kind, CriticalStep::Kind::found);
  const auto wanted = bisection(scan.study);
  ASSERT_EQ(wanted.size(), 1U);
  EXPECT_DOUBLE_EQ(wanted[0].dt.value(), 0.04);
  EXPECT_DOUBLE_EQ(wanted[0].t_end, 160);
  scan.add(*wanted[0].dt, wanted[0].t_end);
  EXPECT_EQ(scan.ladder().growth().kind, CriticalStep::Kind::none);
  EXPECT_TRUE(bisection(scan.study).empty());
}

TEST(StepLadder, AGainThatTheLongerRunShowsTooIsBracketed) {
  auto scan = scan_of({0.01, 0.02, 0.04, 0.08}, [](double dt, double t_end) { return dt == 0.04 ? t_end / 80 : 0.0; });
  const auto wanted = bisection(scan.study);
  ASSERT_EQ(wanted.size(), 1U);
  scan.add(*wanted[0].dt, wanted[0].t_end);
  EXPECT_DOUBLE_EQ(scan.ladder().growth().fails, 0.04);
  const auto next = bisection(scan.study);
  ASSERT_EQ(next.size(), 1U);
  EXPECT_DOUBLE_EQ(next[0].dt.value(), std::sqrt(0.02 * 0.04));
}

TEST(StepLadder, AGainAmongGainsNeedsNoLongerRun) {
  const auto scan = scan_of({0.01, 0.02, 0.04, 0.08}, [](double dt, double) { return dt > 0.03 ? 0.5 : 0.0; });
  const auto wanted = bisection(scan.study);
  ASSERT_EQ(wanted.size(), 1U);
  EXPECT_DOUBLE_EQ(wanted[0].dt.value(), std::sqrt(0.02 * 0.04));
}

TEST(StepLadder, AMotionLostInALengthenedRunIsTriedForTheDurationAskedFor) {
  auto scan = scan_of({0.04, 0.2, 1.0}, [](double, double) { return 0.0; });
  EXPECT_EQ(scan.ladder().motion().kind, CriticalStep::Kind::none);
  for (RunRecord& run : scan.study.runs) run.result.attitude_error_max = run.config.t_end > 90 ? 2.0 : 0.1;
  EXPECT_DOUBLE_EQ(scan.ladder().motion().fails, 0.2);
  const auto wanted = bisection(scan.study);
  ASSERT_EQ(wanted.size(), 1U);
  EXPECT_DOUBLE_EQ(wanted[0].dt.value(), 0.2);
  EXPECT_DOUBLE_EQ(wanted[0].t_end, 40);
  scan.add(0.2, 40);
  EXPECT_DOUBLE_EQ(scan.ladder().motion().fails, 1.0) << "the shorter run follows it";
  EXPECT_EQ(scan.ladder().steps[1].verdict, Verdict::stable) << "by the longer run";
}

TEST(StepLadder, AShortRunHasNoVerdictOnTheEnergy) {
  auto scan = scan_of({0.04, 1.0}, [](double, double) { return 0.0; });
  scan.add(0.2, 40);
  const Ladder ladder = scan.ladder();
  ASSERT_EQ(ladder.steps.size(), 3U);
  EXPECT_EQ(ladder.steps[1].verdict, Verdict::none);
  EXPECT_EQ(ladder.growth().kind, CriticalStep::Kind::none);
}

}  // namespace
}  // namespace polhode::study::stability::step_ladder_test
