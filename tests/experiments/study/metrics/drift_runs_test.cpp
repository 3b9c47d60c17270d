// SPDX-License-Identifier: BSD-3-Clause
// Real runs have the drifts that their methods are known for, and no others.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "experiments/study/run/run.hpp"

namespace polhode::study::drift_runs_test {
namespace {

const std::set<std::string> growing = {"random walk", "sublinear", "linear", "quadratic", "faster"};

RunResult result_on(const std::string& scenario_name, const std::string& method, double dt,
                    std::optional<double> t_end_s = {}) {
  const Scenario scenario = ScenarioSource::open(scenario_name).resolve();
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = method;
  config.dt = dt;
  config.t_end = t_end_s.value_or(scenario.t_end);
  return carry_out(config, scenario, {}, nullptr);
}

RunResult result_of(const std::string& method, double dt, double t_end_s, AngularState state) {
  static const Scenario scenario = ScenarioSource::open("hairer_vilmart").resolve();
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = method;
  config.formulation.angular_state = state;
  config.dt = dt;
  config.t_end = t_end_s;
  return carry_out(config, scenario, {}, nullptr);
}

TEST(DriftOfRuns, OfRk4OnTheFreeTopIsSecularUnderItsOscillation) {
  // REFERENCE_RESULTS, section 2: J/s at h = 0.1, 0.05, 0.025.
  const struct { double h, rate; } published[] = {{0.1, -6.06e-8}, {0.05, -1.90e-9}, {0.025, -5.96e-11}};
  for (const auto& [h, rate] : published) {
    const RunResult r = result_of("rk4", h, 400, AngularState::velocity_body);
    EXPECT_NEAR(*r.energy_drift_rate, rate, 0.03 * std::abs(rate));
    EXPECT_LE(*r.energy_drift_rate_ci, 0.03 * std::abs(rate));
    EXPECT_EQ(r.drift_class, "linear");
    EXPECT_NEAR(*r.drift_exponent, 1, 0.02);
  }
  const RunResult world = result_of("rk4", 0.1, 400, AngularState::velocity_world);
  EXPECT_NEAR(*world.energy_drift_rate, 1.68e-6, 0.03 * 1.68e-6);
  EXPECT_EQ(world.drift_class, "linear");
}

TEST(DriftOfRuns, OfOtherMethodsIsWhatTheyAreKnownFor) {
  EXPECT_EQ(result_of("dmv", 0.05, 400, AngularState::velocity_body).drift_class, "round-off");
  EXPECT_EQ(result_of("lie_midpoint", 0.05, 400, AngularState::velocity_body).drift_class, "bounded");
  EXPECT_EQ(result_of("exact_rotor", 0.01, 2000, AngularState::velocity_body).drift_class, "round-off");
  const RunResult euler = result_of("explicit_euler", 1e-3, 10, AngularState::velocity_body);
  EXPECT_EQ(euler.drift_class, "linear");  // growth of E at a rate ∝ h, not yet felt by itself
  EXPECT_GT(*euler.energy_drift_rate, 10 * *euler.energy_drift_rate_ci);
}

TEST(DriftOfRuns, OfAFallIsRoundOffForWhatIsExactThere) {
  // 40 kJ of the fall are added and cancel; dmv keeps the energy of the rotation.
  for (const double dt : {5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2}) {
    const RunResult r = result_on("peters_hsu", "dmv", dt);
    EXPECT_EQ(r.drift_class, "round-off") << dt;
    EXPECT_FALSE(r.drift_exponent || r.drift_decided_after);
  }
  for (const double dt : {5e-4, 1e-3, 2e-3})
    EXPECT_EQ(result_on("peters_hsu", "rk4", dt).drift_class, "round-off") << dt;
  // RK4's loss does not show beside its oscillation in three turns of the box.
  const RunResult r = result_on("peters_hsu", "rk4", 2e-2);
  EXPECT_EQ(r.drift_class, "undecided");
  ASSERT_TRUE(r.drift_decided_after);
  EXPECT_EQ(result_on("peters_hsu", "rk4", 2e-2, 60).drift_class, "linear");
}

TEST(DriftOfRuns, OfFlipsIsNoGrowthOfSymmetricMethods) {
  for (const char* method : {"lie_midpoint", "implicit_midpoint"}) {
    for (const double dt : {1e-2, 2e-2, 5e-2, 1e-1}) {
      const RunResult r = result_on("dzhanibekov", method, dt);
      EXPECT_FALSE(growing.contains(r.drift_class)) << method << " " << dt << ": " << r.drift_class;
      EXPECT_TRUE(r.drift_class == "bounded" || r.drift_decided_after);
    }
    EXPECT_EQ(result_on("dzhanibekov", method, 5e-2, 1200).drift_class, "bounded");
  }
}

TEST(DriftOfRuns, ThatIsAsLargeAsTheEnergyIsSaturated) {
  const RunResult r = result_on("two_bodies", "explicit_euler", 0.01);
  EXPECT_EQ(r.drift_class, "saturated");
  EXPECT_FALSE(r.drift_exponent);
  EXPECT_EQ(result_on("two_bodies", "rk4", 0.01).drift_class, "linear");
  EXPECT_EQ(result_on("two_bodies", "velocity_verlet", 0.01).drift_class, "bounded");
}

TEST(DriftOfRuns, OfImpactsIsNoWalk) {
  const Scenario ball = ScenarioSource::open("bouncing_ball").resolve();
  for (const char* method : {"explicit_euler", "semi_implicit_euler", "rk4", "velocity_verlet"}) {
    for (const double dt : {1e-3, 1e-2}) {
      RunConfig config;
      config.scenario = ball.name;
      config.integrator = method;
      config.contact = ContactConfig{"sweep_and_prune", "gjk", "sequential_impulses", "time_stepping"};
      config.dt = dt;
      config.t_end = ball.t_end;
      const RunResult r = carry_out(config, ball, {}, nullptr);
      ASSERT_EQ(r.status, "ok") << r.message;
      EXPECT_FALSE(growing.contains(r.drift_class)) << method << " " << dt << ": " << r.drift_class;
    }
  }
}

}  // namespace
}  // namespace polhode::study::drift_runs_test
