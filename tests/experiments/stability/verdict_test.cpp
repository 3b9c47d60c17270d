// SPDX-License-Identifier: BSD-3-Clause
// Verdicts on made-up histories of the energy.
#include "experiments/stability/verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/experiments/stability/made_up_run.hpp"

namespace polhode::study::stability::verdict_test {
namespace {

TEST(Verdict, ABoundedOscillationIsStable) {
  for (const double size : {1e-12, 1e-5, 0.3, 300.0}) {
    EXPECT_EQ(stability_verdict(run_of([&](double t) { return size * swing(t); })), Verdict::stable) << size;
    EXPECT_EQ(stability_verdict(run_of([&](double t) { return -std::min(size, 0.99) * swing(t); })), Verdict::stable)
        << size;
    EXPECT_EQ(stability_verdict(run_of([&](double t) { return size * (0.3 + 0.7 * swing(t)); })), Verdict::stable)
        << size;
  }
}

TEST(Verdict, ATrendIsSeenBelowItsOscillation) {
  for (const double size : {1e-6, 1e-2}) {
    EXPECT_EQ(stability_verdict(run_of([&](double t) { return size * (2 * t + swing(t)); })), Verdict::gaining);
    EXPECT_EQ(stability_verdict(run_of([&](double t) { return size * (-2 * t + swing(t)); })), Verdict::damped);
    EXPECT_EQ(stability_verdict(run_of([&](double t) { return size * (0.1 * t + swing(t)); })), Verdict::stable);
  }
}

TEST(Verdict, GrowthAndDecayOfASpectralRadiusNearOneAreToldApartFromNone) {
  for (const double rate : {1e-8, 1e-3, 1.0, 6.0}) {
    EXPECT_EQ(stability_verdict(run_of([&](double t) { return std::expm1(rate * t); })), Verdict::gaining) << rate;
    EXPECT_EQ(stability_verdict(run_of([&](double t) { return std::expm1(-rate * t); })), Verdict::damped) << rate;
  }
  EXPECT_EQ(stability_verdict(run_of([](double) { return 0.0; })), Verdict::stable);
  EXPECT_EQ(stability_verdict(run_of([](double t) { return 1e-12 * t; })), Verdict::stable) << "below what is counted";
}

TEST(Verdict, AnEnergyThatHasGoneOrSettledElsewhereHasChangedForGood) {
  EXPECT_EQ(stability_verdict(run_of([](double t) { return std::expm1(-900 * t); })), Verdict::damped);
  EXPECT_EQ(stability_verdict(run_of([](double t) { return t > 0.02 ? 0.2 : 0.0; })), Verdict::gaining);
}

TEST(Verdict, WhatEndedEarlyOrIsOffTheScaleHasBlownUp) {
  EXPECT_EQ(stability_verdict(run_of([](double) { return 0.0; }, "diverged")), Verdict::blown_up);
  EXPECT_EQ(stability_verdict(run_of([](double) { return 0.0; }, "failed")), Verdict::blown_up);
  EXPECT_EQ(stability_verdict(run_of([](double t) { return 1100 * swing(t); })), Verdict::blown_up);
  EXPECT_EQ(stability_verdict(run_of([](double) { return 0.0; }, "refused")), Verdict::none);
}

TEST(Verdict, AGainOfLessThanAPercentInATurnIsSlow) {
  constexpr double turn = 0.05;  // twenty turns
  const auto trend = [](double gain) {
    RunRecord run = run_of([gain](double t) { return gain * t; });
    run.result.energy_scale = 1;          // J
    run.result.energy_drift_rate = gain;  // W
    return run;
  };
  EXPECT_EQ(stability_verdict(trend(4.9e-8), turn), Verdict::gaining_slowly) << "RK4 on a top";
  EXPECT_EQ(stability_verdict(trend(0.19), turn), Verdict::gaining_slowly);
  EXPECT_EQ(stability_verdict(trend(0.21), turn), Verdict::gaining);
  EXPECT_EQ(stability_verdict(trend(4.9e-8)), Verdict::gaining) << "of a linear system every gain counts";
  EXPECT_EQ(stability_verdict(trend(-0.5), turn), Verdict::damped);
  EXPECT_EQ(stability_verdict(trend(1e-12), turn), Verdict::stable);
  EXPECT_EQ(stability_verdict(run_of([](double t) { return std::expm1(6 * t); }), turn), Verdict::gaining);
  EXPECT_TRUE(holds(Verdict::gaining_slowly));
  EXPECT_FALSE(holds(Verdict::gaining));
}

TEST(Verdict, AGainThatRoundingExplainsIsNone) {
  auto run = run_of([](double t) { return 1e-6 * t; });
  run.result.energy_scale = 2;  // J
  run.result.energy_round_off = 1e-6;
  EXPECT_EQ(stability_verdict(run), Verdict::gaining);
  run.result.energy_round_off = 3e-6;
  EXPECT_EQ(stability_verdict(run), Verdict::stable);
}

TEST(Verdict, AQuaternionThatGrowsWithoutBoundHasBlownUpWhateverTheEnergyDoes) {
  auto run = run_of([](double t) { return std::expm1(-t); });
  run.result.orientation_defect_max = 900;
  EXPECT_EQ(stability_verdict(run), Verdict::damped);
  run.result.orientation_defect_max = 1e39;
  EXPECT_EQ(stability_verdict(run), Verdict::blown_up);
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

TEST(Verdict, OfFloatsCountsNoRounding) {
  auto run = run_of([](double t) { return 1e-6 * t; });
  EXPECT_EQ(stability_verdict(run), Verdict::gaining);
  run.config.precision = Precision::single_precision;
  EXPECT_EQ(stability_verdict(run), Verdict::stable);
}

}  // namespace
}  // namespace polhode::study::stability::verdict_test
