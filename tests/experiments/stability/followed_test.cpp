// SPDX-License-Identifier: BSD-3-Clause
// When a motion is followed, and when and in what it is lost.
#include "experiments/stability/followed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "experiments/study/scenario/scenario.hpp"
#include "tests/experiments/stability/made_up_run.hpp"

namespace polhode::study::stability::followed_test {
namespace {

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
  EXPECT_TRUE(has_known_motion(run));
  run.result.attitude_error_max.reset();
  EXPECT_FALSE(has_known_motion(run));
  EXPECT_EQ(what_is_lost(run, 1), Lost::nothing);
  run.result.energy_drift_max_rel = 0.11;
  EXPECT_EQ(what_is_lost(run, 1), Lost::energy);
  run.result.attitude_reference = 1e-12;  // uncertainty, rad; an error of less than a hundred times that is left out
  EXPECT_TRUE(has_known_motion(run));
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

}  // namespace
}  // namespace polhode::study::stability::followed_test
