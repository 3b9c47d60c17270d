// SPDX-License-Identifier: BSD-3-Clause
// The cone and the force of Coulomb that the README writes in full, and the screw of the guide, in scenarios.
// carry_out.py has put them into the catalogues of this program, so that the laws of forces, shapes, surfaces and
// joints are tried on them too.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "collision/shapes/shape_catalogue.hpp"
#include "core/forces/catalogue.hpp"
#include "core/joints/catalogue.hpp"
#include "experiments/study/run/run.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study {
namespace {

Scenario scenario_of(const std::string& text) { return ScenarioSource::parse(text, "recipe.toml").resolve(); }

RunResult run_of(const Scenario& scenario, double dt, std::optional<ContactConfig> contact = std::nullopt) {
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = "rk4";
  config.dt = dt;
  config.t_end = scenario.t_end;
  config.contact = std::move(contact);
  if (!scenario.problem.joints.empty()) config.joints.emplace();
  EXPECT_EQ(refusal(config, scenario), "");
  return carry_out(config, scenario, {}, nullptr);
}

TEST(Recipes, StandInTheCatalogues) {
  EXPECT_TRUE(find_shape("cone"));
  EXPECT_TRUE(find_force("coulomb"));
  EXPECT_TRUE(find_joint("screw"));
}

TEST(Recipes, AConeHasTheInertiaOfItsFormula) {
  const Scenario s =
      scenario_of("t_end = 1\n[[body]]\nmass = 2\nshape = { kind = \"cone\", radius = 0.3, length = 0.8 }\n");
  const double across = 3 * 2 * (4 * 0.09 + 0.64) / 80, along = 3 * 2 * 0.09 / 10;
  EXPECT_LT((s.problem.bodies[0].inertia.diagonal() - Vector3<double>(across, across, along)).norm(), 1e-15);
}

TEST(Recipes, AConeCanBePinnedByItsTip) {
  const Scenario s = scenario_of(
      "t_end = 1\n[[body]]\nmass = 2\npinned = true\ncenter_of_mass = [0, 0, -0.6]\n"
      "shape = { kind = \"cone\", radius = 0.3, length = 0.8 }\n");
  // About the tip: 3 m (r²/20 + l²/5) across the axis.
  EXPECT_NEAR(s.problem.bodies[0].inertia(0, 0), 3 * 2 * (0.09 / 20 + 0.64 / 5), 1e-15);
}

// Its base is l/4 below its mass centre, so that it falls as long as that leaves it.
TEST(Recipes, AConeFallsOnItsBase) {
  const Scenario s = scenario_of(
      "t_end = 1\ngravity = [0, 0, -9.81]\ncontact = true\n"
      "[[body]]\nmass = 2\nposition = [0, 0, 1]\nrestitution = 0.5\nshape = { kind = \"cone\", radius = 0.3, length = "
      "0.8 }\n"
      "[[body]]\nstatic = true\nshape = { kind = \"half_space\", normal = [0, 0, 1], offset = 0 }\n");
  const RunResult r = run_of(s, 1e-3, ContactConfig{"sweep_and_prune", "gjk", "sequential_impulses", "time_stepping"});
  EXPECT_EQ(r.status, "ok") << r.message;
  ASSERT_TRUE(r.contact.first_impact);
  EXPECT_NEAR(*r.contact.first_impact, std::sqrt(2 * (1 - 0.8 / 4) / 9.81), 2e-3);
  ASSERT_TRUE(r.contact.penetration_end);
  EXPECT_LT(*r.contact.penetration_end, 0.01) << "it does not stay on the floor";
}

// A circle about the charge: v² = k/(m r), and the energy is −k/(2r).
TEST(Recipes, CoulombsForceKeepsABodyOnItsCircle) {
  const Scenario s = scenario_of(
      "t_end = 6.283185307179586\n[[body]]\nmass = 2\ninertia = [1, 2, 2.5]\nposition = [2, 1, 0]\nvelocity = [0, 1, "
      "0]\n"
      "[[force]]\nkind = \"coulomb\"\nbodies = [\"body0\"]\nstrength = -2\ncenter = [1, 1, 0]\n");
  const RunResult r = run_of(s, 1e-3);
  EXPECT_EQ(r.status, "ok") << r.message;
  ASSERT_TRUE(r.energy_initial && r.energy_drift_max_rel && r.angular_momentum_drift_max_rel);
  EXPECT_NEAR(*r.energy_initial, -1, 1e-15);
  EXPECT_LT(*r.energy_drift_max_rel, 1e-12);
  EXPECT_FALSE(r.linear_momentum_drift_max_rel) << "the charge pulls";
}

/// The scenario on the page about joints.
std::string screw_scenario() {
  std::ifstream file(std::string(POLHODE_TESTS_DIR) + "/../guide/own/joint.md");
  std::stringstream stream;
  stream << file.rdbuf();
  const std::string text = stream.str(), fence = "```toml\n";
  const std::size_t begin = text.find(fence) + fence.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

// On a thread of the lead L the weight moves m and, geared by 2π/L, the moment of inertia I about the axis:
// a = g/(1 + (2π/L)² I/m).
TEST(Recipes, ANutFallsDownItsScrew) {
  const Scenario s = scenario_of(screw_scenario());
  const double per_metre = 2 * std::numbers::pi / 0.2, a = 9.81 / (1 + per_metre * per_metre * 0.005);  // rad/m, m/s²
  const auto system = make_system<double>(s.problem, {});
  const auto rk4 = find_integrator("rk4")->make(*system, {});
  State<double> state = system->start();
  rk4->begin(state);
  rk4->advance(state, 1e-3, 2000);
  const auto nut = system->snapshot(state.y, 0);
  EXPECT_NEAR(nut.position[2], -a * 4 / 2, 1e-9) << "m, after more than 16 turns";
  EXPECT_NEAR(nut.velocity[2], -a * 2, 1e-9);
  EXPECT_NEAR(nut.angular_velocity[2], -per_metre * a * 2, 1e-9);
}

TEST(Recipes, AScrewStaysClosed) {
  const RunResult r = run_of(scenario_of(screw_scenario()), 1e-3);
  EXPECT_EQ(r.status, "ok") << r.message;
  ASSERT_TRUE(r.energy_drift_max_rel && r.joints.gap_max);
  EXPECT_LT(*r.energy_drift_max_rel, 1e-9);
  EXPECT_LT(*r.joints.gap_max, 1e-6);
  const RunResult coarse = run_of(scenario_of(screw_scenario()), 0.01);
  ASSERT_TRUE(coarse.joints.gap_max);
  EXPECT_NEAR(*coarse.joints.gap_max, 6.2e-4, 1e-5) << "the guide prints it";
}

}  // namespace
}  // namespace polhode::study
