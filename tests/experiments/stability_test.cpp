// SPDX-License-Identifier: BSD-3-Clause
// Verdicts on made-up histories, the search for a critical step on made-up scans, and linear theory on the oscillator.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "experiments/study/characteristic_rate.hpp"
#include "experiments/study/critical_step.hpp"
#include "experiments/study/scenario.hpp"
#include "experiments/study/step_map.hpp"
#include "experiments/study/verdict.hpp"

namespace polhode::study {
namespace {

/// A finished run of 400 steps with this drift over t from 0 to 1.
RunRecord run_of(const std::function<double(double)>& drift, const char* status = "ok") {
  RunRecord run;
  run.result.status = status;
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
