// SPDX-License-Identifier: BSD-3-Clause
// What is said of free bodies is what theory says of the methods: who keeps the energy, who loses it, who gains it, and
// how rounding walks.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/exact/exact_motion.hpp"
#include "experiments/precision/growth_estimate.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::theory_test {
namespace {

using namespace precision;

/// The built-in scenarios whose bodies all turn without torque, and neither touch nor are joined.
std::vector<Scenario> free_scenarios() {
  std::vector<Scenario> free;
  for (const BuiltinScenario& each : builtin_scenarios()) {
    Scenario scenario = ScenarioSource::open(std::string(each.name)).resolve();
    const auto system = make_system<double>(scenario.problem, {});
    bool torque = !scenario.colliders.empty() || system->has_joints(), turns = false;
    for (std::size_t i = 0; i < system->moving(); ++i) {
      for (const auto& force : system->forces()) torque = torque || force->effect_on(i).torque;
      turns = turns || scenario.problem.starts[i].angular_velocity.norm() > 0;
    }
    if (!torque && turns) free.push_back(std::move(scenario));
  }
  return free;
}

double fastest(const Scenario& scenario) {
  double rate = 0;
  for (const BodyStart& start : scenario.problem.starts) rate = std::max(rate, start.angular_velocity.norm());
  return rate;
}

/// True where the angular velocity changes in the body: an asymmetric body, not spun about a principal axis.
bool tumbles(const Scenario& scenario) {
  const Body& body = scenario.problem.bodies.front();
  const BodyStart& start = scenario.problem.starts.front();
  const Vector3<double> w =
      start.angular_velocity_in_body
          ? start.angular_velocity
          : Vector3<double>(rotation_matrix(start.orientation).transpose() * start.angular_velocity);
  return scenario.problem.moving() == 1 &&
         w.cross(body.inertia * w).norm() > 1e-3 * w.squaredNorm() * body.inertia.norm();
}

RunConfig configured(const Scenario& scenario, const std::string& method, double phase) {
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = method;
  config.formulation.angular_state = AngularState::velocity_body;
  config.t_end = scenario.t_end;
  config.dt = scenario.t_end / std::ceil(scenario.t_end * fastest(scenario) / phase);
  return config;
}

std::string said(const RunResult& r) {
  return r.status + ", " + r.drift_class + ", final " + std::to_string(r.energy_drift_final_rel.value_or(NAN) * 1e9) +
         "e-9, rounding " + std::to_string(r.energy_round_off.value_or(NAN) / r.energy_scale.value_or(NAN) * 1e9) +
         "e-9";
}

TEST(Theory, ThereAreFreeScenarios) { EXPECT_GE(free_scenarios().size(), 7u); }

TEST(Theory, ConservingMethodsKeepTheEnergyOfFreeBodies) {
  for (const Scenario& scenario : free_scenarios()) {
    for (const char* method : {"dmv", "exact_rotor", "gauss4", "gauss6"}) {
      for (const double phase : {0.2, 0.05}) {
        const RunConfig config = configured(scenario, method, phase);
        if (!refusal(config, scenario).empty()) continue;
        const RunResult r = carry_out(config, scenario, {}, nullptr);
        EXPECT_TRUE(r.drift_class == "round-off" || r.drift_class == "bounded")
            << scenario.name << ", " << method << " at " << *config.dt << " s: " << said(r);
      }
    }
  }
}

/// RK4 loses at the rate h⁵ on average, explicit Euler gains at the rate h: Hairer, Lubich & Wanner, Geometric
/// Numerical Integration, 2nd ed., chapter IX.
TEST(Theory, TextbookMethodsLoseAndGain) {
  int lost = 0, gained = 0;
  for (const Scenario& scenario : free_scenarios()) {
    if (!tumbles(scenario)) continue;
    const RunConfig coarse = configured(scenario, "rk4", 0.2), fine = configured(scenario, "rk4", 0.1);
    const RunResult a = carry_out(coarse, scenario, {}, nullptr), b = carry_out(fine, scenario, {}, nullptr);
    if (*a.energy_drift_max > 100 * *a.energy_round_off && *b.energy_drift_max > 100 * *b.energy_round_off) {
      EXPECT_LT(*a.energy_drift_final_rel, 0) << scenario.name;
      EXPECT_NEAR(std::log2(*a.energy_drift_final_rel / *b.energy_drift_final_rel), 5, 0.5) << scenario.name;
      EXPECT_TRUE(a.drift_class == "linear" || a.drift_class == "undecided") << scenario.name << ": " << said(a);
      lost += a.drift_class == "linear";
    }
    const RunResult euler = carry_out(configured(scenario, "explicit_euler", 0.01), scenario, {}, nullptr);
    EXPECT_GT(*euler.energy_drift_final_rel, 0) << scenario.name;
    for (const char* no_gain : {"round-off", "bounded", "random walk"})
      EXPECT_NE(euler.drift_class, no_gain) << scenario.name;
    gained += euler.drift_class == "linear" || euler.drift_class == "quadratic" || euler.drift_class == "faster";
  }
  EXPECT_GE(lost, 2);
  EXPECT_GE(gained, 2);
}

/// 10⁷ steps of RK4 whose truncation is far below rounding: the energy walks as √t (Brouwer 1937), and no growth is
/// claimed.
TEST(Theory, SlowPlainSummationWalksAtRandom) {
  constexpr int runs = 8;
  constexpr double steps = 1e7;
  std::vector<double> exponents;
  for (int k = 0; k < runs; ++k) {
    const Override start{"body.0.angular_velocity",
                         "[" + std::to_string(1.1 + 0.013 * k) + ", " + std::to_string(0.7 - 0.021 * k) + ", 0.43]"};
    const Scenario scenario = ScenarioSource::open("hairer_vilmart").resolve({{start}});
    RunConfig config = configured(scenario, "rk4", 0.1);
    config.dt = 1e-4;
    config.t_end = steps * *config.dt;
    const RunResult r = carry_out(config, scenario, {}, nullptr);
    EXPECT_EQ(r.steps, static_cast<std::int64_t>(steps));
    EXPECT_EQ(r.drift_class, "round-off") << said(r);
    EXPECT_FALSE(r.drift_exponent);
    EXPECT_GT(*r.energy_drift_max, 1e-3 * *r.energy_round_off) << "the level is that of the walk, not of another world";
    std::vector<PathPoint> path;
    for (const SeriesPoint& p : r.series) path.push_back({p.t, p.energy_drift_rel});
    if (const auto p = path_exponent(path)) exponents.push_back(*p);
  }
  const auto growth = estimate_growth(exponents);
  ASSERT_TRUE(growth);
  EXPECT_EQ(growth->paths, std::size_t(runs));
  EXPECT_NEAR(growth->exponent, 0.5, 0.25) << "± " << growth->half_width_95;
}

}  // namespace
}  // namespace polhode::study::theory_test
