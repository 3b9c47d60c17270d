// SPDX-License-Identifier: BSD-3-Clause
// Verdicts on made-up histories, the search for a critical step on made-up scans, what becomes of a lone verdict, when
// a motion is lost, and linear theory on the oscillator.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "experiments/stability/critical_step.hpp"
#include "experiments/stability/followed.hpp"
#include "experiments/stability/step_ladder.hpp"
#include "experiments/stability/step_map.hpp"
#include "experiments/stability/verdict.hpp"
#include "experiments/study/scenario/characteristic_rate.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study {
namespace {

/// A finished run of 400 steps with this drift over t from 0 to 1.
RunRecord run_of(const std::function<double(double)>& drift, const char* status = "ok") {
  RunRecord run;
  run.result.status = status;
  run.result.t_reached = 1;
  run.result.steps = 400;
  double largest = 0;
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0;
    run.result.series.push_back({.t = t, .energy_drift_rel = drift(t)});
    largest = std::max(largest, std::abs(drift(t)));
  }
  run.result.energy_drift_max_rel = largest;
  run.result.energy_drift_final_rel = drift(1);
  return run;
}

double swing(double t) { return 0.5 * (1 - std::cos(2 * std::numbers::pi * 13.3 * t)); }

TEST(Verdict, ABoundedOscillationIsStable) {
  for (const double size : {1e-12, 1e-5, 0.3, 300.0}) {
    EXPECT_EQ(judge(run_of([&](double t) { return size * swing(t); })), Verdict::stable) << size;
    EXPECT_EQ(judge(run_of([&](double t) { return -std::min(size, 0.99) * swing(t); })), Verdict::stable) << size;
    EXPECT_EQ(judge(run_of([&](double t) { return size * (0.3 + 0.7 * swing(t)); })), Verdict::stable) << size;
  }
}

TEST(Verdict, ATrendIsSeenBelowItsOscillation) {
  for (const double size : {1e-6, 1e-2}) {
    EXPECT_EQ(judge(run_of([&](double t) { return size * (2 * t + swing(t)); })), Verdict::gaining);
    EXPECT_EQ(judge(run_of([&](double t) { return size * (-2 * t + swing(t)); })), Verdict::damped);
    EXPECT_EQ(judge(run_of([&](double t) { return size * (0.1 * t + swing(t)); })), Verdict::stable);
  }
}

TEST(Verdict, GrowthAndDecayOfASpectralRadiusNearOneAreToldApartFromNone) {
  for (const double rate : {1e-8, 1e-3, 1.0, 6.0}) {
    EXPECT_EQ(judge(run_of([&](double t) { return std::expm1(rate * t); })), Verdict::gaining) << rate;
    EXPECT_EQ(judge(run_of([&](double t) { return std::expm1(-rate * t); })), Verdict::damped) << rate;
  }
  EXPECT_EQ(judge(run_of([](double) { return 0.0; })), Verdict::stable);
  EXPECT_EQ(judge(run_of([](double t) { return 1e-12 * t; })), Verdict::stable) << "below what is counted";
}

TEST(Verdict, AnEnergyThatHasGoneOrSettledElsewhereHasChangedForGood) {
  EXPECT_EQ(judge(run_of([](double t) { return std::expm1(-900 * t); })), Verdict::damped);
  EXPECT_EQ(judge(run_of([](double t) { return t > 0.02 ? 0.2 : 0.0; })), Verdict::gaining);
}

TEST(Verdict, WhatEndedEarlyOrIsOffTheScaleHasBlownUp) {
  EXPECT_EQ(judge(run_of([](double) { return 0.0; }, "diverged")), Verdict::blown_up);
  EXPECT_EQ(judge(run_of([](double) { return 0.0; }, "failed")), Verdict::blown_up);
  EXPECT_EQ(judge(run_of([](double t) { return 1100 * swing(t); })), Verdict::blown_up);
  EXPECT_EQ(judge(run_of([](double) { return 0.0; }, "refused")), Verdict::none);
}

TEST(Verdict, AGainOfLessThanAPercentInATurnIsSlow) {
  constexpr double turn = 0.05;  // twenty turns
  const auto trend = [](double gain) {
    RunRecord run = run_of([gain](double t) { return gain * t; });
    run.result.energy_scale = 1;          // J
    run.result.energy_drift_rate = gain;  // W
    return run;
  };
  EXPECT_EQ(judge(trend(4.9e-8), turn), Verdict::gaining_slowly) << "RK4 on a top";
  EXPECT_EQ(judge(trend(0.19), turn), Verdict::gaining_slowly);
  EXPECT_EQ(judge(trend(0.21), turn), Verdict::gaining);
  EXPECT_EQ(judge(trend(4.9e-8)), Verdict::gaining) << "of a linear system every gain counts";
  EXPECT_EQ(judge(trend(-0.5), turn), Verdict::damped);
  EXPECT_EQ(judge(trend(1e-12), turn), Verdict::stable);
  EXPECT_EQ(judge(run_of([](double t) { return std::expm1(6 * t); }), turn), Verdict::gaining);
  EXPECT_TRUE(holds(Verdict::gaining_slowly));
  EXPECT_FALSE(holds(Verdict::gaining));
}

TEST(Verdict, AGainThatRoundingExplainsIsNone) {
  auto run = run_of([](double t) { return 1e-6 * t; });
  run.result.energy_scale = 2;  // J
  run.result.energy_round_off = 1e-6;
  EXPECT_EQ(judge(run), Verdict::gaining);
  run.result.energy_round_off = 3e-6;
  EXPECT_EQ(judge(run), Verdict::stable);
}

TEST(Verdict, AQuaternionThatGrowsWithoutBoundHasBlownUpWhateverTheEnergyDoes) {
  auto run = run_of([](double t) { return std::expm1(-t); });
  run.result.orientation_defect_max = 900;
  EXPECT_EQ(judge(run), Verdict::damped);
  run.result.orientation_defect_max = 1e39;
  EXPECT_EQ(judge(run), Verdict::blown_up);
}

TEST(Verdict, HasTheRateOfTheLeastSquaresLineOverTheScale) {
  auto run = run_of([](double t) { return 1e-3 * t; });
  EXPECT_FALSE(energy_gain_rate(run));
  run.result.energy_drift_rate = 4e-3;  // W
  run.result.energy_scale = 2;          // J
  EXPECT_DOUBLE_EQ(energy_gain_rate(run).value(), 2e-3);
  run.result.status = "diverged";
  EXPECT_FALSE(energy_gain_rate(run));
}

/// A free top that is known exactly and followed in all respects.
RunRecord followed_run() {
  auto run = run_of([](double) { return 0.0; });
  run.scenario = std::make_shared<const Scenario>(ScenarioSource::open("hairer_vilmart").resolve());
  run.result.attitude_error_max = 0.9;
  run.result.position_error_max = 0;
  run.result.linear_momentum_drift_max_rel = 0;
  run.result.angular_momentum_drift_max_rel = 0.09;
  run.result.invariant_drift_max_rel["casimir"] = 0.09;
  run.result.orientation_defect_max = 0.09;
  return run;
}

TEST(Followed, IsAMotionWithinAllItsBounds) {
  EXPECT_EQ(what_is_lost(followed_run(), 1), Lost::nothing);
  const auto lost = [](const auto& change) {
    RunRecord run = followed_run();
    change(run.result);
    return what_is_lost(run, 1);
  };
  EXPECT_EQ(lost([](RunResult& r) { r.attitude_error_max = 1.1; }), Lost::attitude);
  EXPECT_EQ(lost([](RunResult& r) { r.position_error_max = 0.24; }), Lost::nothing);
  EXPECT_EQ(lost([](RunResult& r) { r.position_error_max = 0.26; }), Lost::position);
  EXPECT_EQ(lost([](RunResult& r) { r.linear_momentum_drift_max_rel = 0.11; }), Lost::momentum);
  EXPECT_EQ(lost([](RunResult& r) { r.angular_momentum_drift_max_rel = 0.11; }), Lost::momentum);
  EXPECT_EQ(lost([](RunResult& r) { r.invariant_drift_max_rel["casimir"] = 0.11; }), Lost::invariant);
  EXPECT_EQ(lost([](RunResult& r) { r.orientation_defect_max = 0.11; }), Lost::orientation);
  EXPECT_EQ(lost([](RunResult& r) { r.status = "failed"; }), Lost::end);
  EXPECT_EQ(lost([](RunResult& r) { r.energy_drift_max_rel = 0.11; }), Lost::nothing);
}

TEST(Followed, WithoutAKnownMotionTheEnergyIsAskedToo) {
  RunRecord run = followed_run();
  EXPECT_TRUE(is_measured(run));
  run.result.attitude_error_max.reset();
  EXPECT_FALSE(is_measured(run));
  EXPECT_EQ(what_is_lost(run, 1), Lost::nothing);
  run.result.energy_drift_max_rel = 0.11;
  EXPECT_EQ(what_is_lost(run, 1), Lost::energy);
  run.result.attitude_reference = 1e-12;  // rad; an error of less than a hundred times that is left out
  EXPECT_TRUE(is_measured(run));
  EXPECT_EQ(what_is_lost(run, 1), Lost::nothing);
}

TEST(Followed, PositionsAreMeasuredByTheDisplacementOfTheExactPath) {
  const auto displacement = [](const char* name, double t_end) {
    return exact_displacement(ScenarioSource::open(name).resolve().problem, {}, t_end);
  };
  EXPECT_NEAR(displacement("oscillator", 40), 2, 1e-2);
  EXPECT_NEAR(displacement("oscillator", 1), 1 - std::cos(1.0), 1e-12);
  EXPECT_EQ(displacement("hairer_vilmart", 40), 0);
  EXPECT_EQ(displacement("physical_pendulum", 40), 0);
}

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
    const auto grouping = report::group(study);
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
  // Of the step 0.04 a swing of the energy that lasts longer than 40 s looks like a gain.
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

TEST(Verdict, OfFloatsCountsNoRounding) {
  auto run = run_of([](double t) { return 1e-6 * t; });
  EXPECT_EQ(judge(run), Verdict::gaining);
  run.config.precision = Precision::single;
  EXPECT_EQ(judge(run), Verdict::stable);
}

/// Scans, then bisects as the study does; the number of further steps is returned.
std::pair<CriticalStep, int> search(const std::function<bool(double)>& stable, double ratio) {
  std::vector<TriedStep> tried;
  for (double dt = 0.01; dt < 100; dt *= ratio) tried.push_back({dt, stable(dt)});
  int further = 0;
  for (;; ++further) {
    const auto found = critical_step(tried);
    const auto dt = next_step(found);
    if (!dt || further == 100) return {found, further};
    tried.push_back({*dt, stable(*dt)});
  }
}

TEST(CriticalStep, IsBracketedToThreePerMille) {
  for (const double limit : {0.0123, 2.0, 2 * std::numbers::sqrt2, 77.0}) {
    const auto [found, further] = search([&](double dt) { return dt < limit; }, 1.3);
    EXPECT_EQ(found.kind, CriticalStep::Kind::found);
    EXPECT_LT(found.holds, limit);
    EXPECT_GE(found.fails, limit);
    EXPECT_LE(found.fails - found.holds, 0.003 * found.fails);
    EXPECT_LE(further, 7);
    EXPECT_FALSE(found.holds_again);
  }
}

TEST(CriticalStep, StableWindowsAboveItDoNotHideIt) {
  const auto [found, further] = search([](double dt) { return dt < 1 || (dt > 3 && dt < 9) || dt > 50; }, 1.3);
  EXPECT_NEAR(found.fails, 1, 0.003);
  EXPECT_TRUE(found.holds_again);
}

TEST(CriticalStep, MayBeAbsentOrBelowAllSteps) {
  const auto none = search([](double) { return true; }, 1.5).first;
  EXPECT_EQ(none.kind, CriticalStep::Kind::none);
  EXPECT_GT(none.holds, 60);
  const auto always = search([](double) { return false; }, 1.5).first;
  EXPECT_EQ(always.kind, CriticalStep::Kind::from_start);
  EXPECT_DOUBLE_EQ(always.fails, 0.01);
}

Scenario oscillator(const std::vector<Override>& overrides = {}) {
  return ScenarioSource::open("oscillator").resolve(overrides);
}

double radius(const char* method, double dt, const Scenario& scenario, const Formulation& formulation = {}) {
  return spectral_radius(*find_integrator(method), scenario.problem, formulation, dt).value();
}

TEST(StepMap, HasTheRadiusOfLinearTheory) {
  const Scenario scenario = oscillator();
  for (const double h : {1e-3, 0.1, 0.7, 1.9, 2.5, 10.0}) {
    const double y2 = h * h, rk4 = std::hypot(1 - y2 / 2 + y2 * y2 / 24, h * (1 - y2 / 6));
    const double verlet = h <= 2 ? 1 : y2 / 2 - 1 + std::sqrt((y2 / 2 - 1) * (y2 / 2 - 1) - 1);
    for (const Orientation chart : {Orientation::quaternion, Orientation::matrix}) {
      const Formulation f{.orientation = chart};
      EXPECT_NEAR(radius("explicit_euler", h, scenario, f), std::sqrt(1 + y2), 1e-13 * (1 + h)) << h;
      EXPECT_NEAR(radius("rk4", h, scenario, f) / rk4, 1, 1e-12) << h;
      EXPECT_NEAR(radius("velocity_verlet", h, scenario, f) / verlet, 1, 1e-12) << h;
      EXPECT_NEAR(radius("semi_implicit_euler", h, scenario, f) / verlet, 1, 1e-12) << h;
    }
  }
}

TEST(StepMap, OfTheExplicitEulerMethodIsAboveOneAtEveryStepAndOfTheImplicitMidpointRuleAtNone) {
  const Scenario scenario = oscillator();
  for (double h = 1e-5; h <= 100; h *= 1.7) {
    EXPECT_GT(radius("explicit_euler", h, scenario) - 1, 0.4 * h * h / (1 + h)) << h;
    EXPECT_NEAR(radius("implicit_midpoint", h, scenario), 1, 1e-9) << h;
  }
  EXPECT_NEAR(radius("implicit_midpoint", 100, scenario), 1, 1e-9);
}

TEST(StepMap, ScalesWithTheStiffness) {
  const Scenario stiff = oscillator({{"force.0.stiffness", "1e6"}, {"body.0.mass", "4"}});
  EXPECT_NEAR(radius("velocity_verlet", 1.999 / 500, stiff), 1, 1e-9);
  EXPECT_GT(radius("velocity_verlet", 2.001 / 500, stiff), 1.01);
}

TEST(StepMap, IsNotThereWithoutALinearSystemOrAMapOfOneStep) {
  const auto none = [](const char* method, const char* scenario) {
    return !spectral_radius(*find_integrator(method), ScenarioSource::open(scenario).resolve().problem, {}, 0.01);
  };
  for (const char* scenario : {"coursework", "spring_box", "hairer_vilmart", "physical_pendulum", "two_bodies"}) {
    EXPECT_TRUE(none("rk4", scenario)) << scenario;
  }
  EXPECT_TRUE(none("odeint_adams_bashforth_moulton", "oscillator"));
  EXPECT_TRUE(none("cvode_bdf", "oscillator"));
  EXPECT_FALSE(none("rk4", "oscillator"));
}

TEST(CharacteristicRate, IsTheLargestOfAScenario) {
  const auto rate = [](const char* name, const std::vector<Override>& overrides = {}) {
    return characteristic_rate(ScenarioSource::open(name).resolve(overrides).problem);
  };
  EXPECT_DOUBLE_EQ(rate("oscillator").value(), 1);
  EXPECT_DOUBLE_EQ(rate("oscillator", {{"force.0.stiffness", "8"}, {"body.0.mass", "0.5"}}).value(), 4);
  EXPECT_NEAR(rate("hairer_vilmart").value(), std::sqrt(9 + 0.25 + 0.81), 1e-12);
  EXPECT_FALSE(rate("projectile", {{"body.0.angular_velocity", "[0, 0, 0]"}}));
  EXPECT_GT(rate("physical_pendulum").value(), 0);
  EXPECT_GT(rate("two_bodies").value(), 0);
}

}  // namespace
}  // namespace polhode::study
