// SPDX-License-Identifier: BSD-3-Clause
// Neither the world's origin, nor its axes, nor the zero of a potential change what is said of a run: relative drifts,
// their class, and the status.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>

#include "core/math/quaternion.hpp"
#include "core/run/simulate.hpp"
#include "experiments/study/metrics/drift_meter.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/narrow_phase_choice.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/setup/run_setup.hpp"

namespace polhode::study {

/// Its name alone, where a failing test prints it.
void PrintTo(const BuiltinScenario& scenario, std::ostream* out) { *out << scenario.name; }

namespace origin_test {
namespace {

using Vector = Vector3<double>;

/// The same motion in other axes: x' = R x + shift for every body, anchor and force.
Scenario retold(Scenario scenario, const Vector& shift, const Quaternion<double>& turn) {
  const Matrix3<double> r = rotation_matrix(turn);
  for (BodyStart& start : scenario.problem.starts) {
    start.position = r * start.position + shift;
    start.orientation = product(turn, start.orientation).normalized();
    start.velocity = r * start.velocity;
    if (!start.angular_velocity_in_body) start.angular_velocity = r * start.angular_velocity;
  }
  for (ForceParameters& force : scenario.problem.forces) {
    const auto turned = [&](const char* key) { force.values.at(key) = Vector(r * force.vector(key)); };
    if (force.kind == "uniform_gravity") turned("acceleration");
    if (force.kind == "constant_force" && force.text("frame") == "world") turned("force");
    if (force.kind == "constant_torque" && force.text("frame") == "world") turned("torque");
    if (force.values.contains("anchor_world"))
      force.values.at("anchor_world") = Vector(r * force.vector("anchor_world") + shift);
  }
  for (JointParameters& joint : scenario.problem.joints) {
    joint.of.values.at("anchor_world") = Vector(r * joint.of.vector("anchor_world") + shift);
    if (joint.of.values.contains("normal")) joint.of.values.at("normal") = Vector(r * joint.of.vector("normal"));
  }
  return scenario;
}

/// Duration (s) in which a rounding of the start stays a rounding. Impacts and singular configurations magnify it, the
/// box on a spring is chaotic, and the pendulum swings about its middle axis, which is unstable. The drift of the
/// rolling ball stands at the edge of two classes after half a second; after a second it has one class, moved or
/// turned.
double foreseeable(const Scenario& scenario) {
  if (scenario.name == "simbenchmark_rolling") return 1;
  if (!scenario.colliders.empty() || !scenario.problem.joints.empty()) return 0.5;
  return scenario.name == "physical_pendulum" || scenario.name == "spring_box" ? 4 : scenario.t_end;
}

/// Number of steps of a run. Coarse where finer steps have a drift below the rounding of positions 1e6 m away.
double steps_of(const Scenario& scenario) {
  return scenario.name == "physical_pendulum" || scenario.name == "rattleback" ? 64 : 512;
}

RunConfig configured(const Scenario& scenario, const std::string& method) {
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = method;
  config.t_end = std::min(scenario.t_end, foreseeable(scenario));
  config.dt = config.t_end / steps_of(scenario);
  if (!scenario.colliders.empty()) {
    config.contact = {"sweep_and_prune", narrow_phase_for(scenario), "sequential_impulses", "time_stepping"};
  }
  if (!scenario.problem.joints.empty()) config.joints.emplace().stabilization = Stabilization::both;
  return config;
}

class Origin : public testing::TestWithParam<BuiltinScenario> {};

TEST_P(Origin, ChangesNothing) {
  const Scenario scenario = ScenarioSource::open(std::string(GetParam().name)).resolve();
  const Vector far(1e3, -1e3, 1e6);
  const Quaternion<double> turn = Quaternion<double>(0.3, -0.5, 0.7, 0.2).normalized();
  const struct {
    const char* what;
    Scenario scenario;
  } others[] = {{"moved", retold(scenario, far, {1, 0, 0, 0})},
                {"turned", retold(scenario, Vector::Zero(), turn)},
                {"turned and moved", retold(scenario, far, turn)}};
  // The solver of many contacts ends its sweeps at other digits, and bodies that rest on each other shake by that.
  const bool many = !scenario.colliders.empty() && scenario.problem.moving() > 2;
  const double close = many ? 1e-2 : 1e-6, shaking = many ? 1e-4 : 0;
  constexpr std::size_t large = 50;  // bodies, of which one method is enough
  for (const char* method : {"semi_implicit_euler", "explicit_euler", "rk4", "lie_midpoint"}) {
    if (scenario.problem.moving() > large && method != std::string("semi_implicit_euler")) break;
    const RunConfig config = configured(scenario, method);
    if (!refusal(config, scenario).empty()) continue;
    const RunResult here = carry_out(config, scenario, {}, nullptr);
    for (const auto& other : others) {
      SCOPED_TRACE(std::string(method) + ", " + other.what);
      const RunResult there = carry_out(config, other.scenario, {}, nullptr);
      EXPECT_EQ(there.status, here.status) << there.message << here.message;
      ASSERT_EQ(there.energy_scale.has_value(), here.energy_scale.has_value());
      if (!here.energy_scale) continue;
      EXPECT_NEAR(*there.energy_scale / *here.energy_scale, 1, close);
      const double rounding = shaking + (*here.energy_round_off + *there.energy_round_off) / *here.energy_scale;
      const auto agree = [&](const std::optional<double>& a, const std::optional<double>& b, double floor,
                             const char* what) {
        ASSERT_EQ(a.has_value(), b.has_value()) << what;
        if (!a) return;
        const double size = std::max(std::abs(*a), std::abs(*b)), lost = 1;
        EXPECT_NEAR(*a, *b, (size < lost ? close : 1e-2) * size + floor) << what;  // beyond the scale it is instability
      };
      const MotionScales scales = motion_scales(scenario, config.t_end);
      const bool several = scenario.problem.moving() > 1;
      const double steps = static_cast<double>(here.steps), unit = std::numeric_limits<double>::epsilon();
      // The rounding of far positions, one-sided where velocities stay the same.
      const double arm = several ? steps * unit * far.norm() * scales.linear / scales.angular : 0.0;
      constexpr double small = 1e-10;  // rounding that unstable steps have magnified
      agree(here.energy_drift_max_rel, there.energy_drift_max_rel, rounding, "largest energy drift");
      agree(here.energy_drift_final_rel, there.energy_drift_final_rel, rounding, "final energy drift");
      agree(here.linear_momentum_drift_max_rel, there.linear_momentum_drift_max_rel, small, "linear momentum");
      agree(here.angular_momentum_drift_max_rel, there.angular_momentum_drift_max_rel, small + arm, "angular momentum");
      for (const auto& [name, drift] : here.invariant_drift_max_rel) {
        ASSERT_TRUE(there.invariant_drift_max_rel.contains(name)) << name;
        agree(drift, there.invariant_drift_max_rel.at(name), small, name.c_str());
      }
      // A drift that rounding explains, or the shaking of bodies that rest on each other, may have another class.
      if (std::max(*here.energy_drift_max_rel, *there.energy_drift_max_rel) <= rounding) continue;
      EXPECT_EQ(there.drift_class, here.drift_class)
          << *here.energy_drift_max_rel << " " << *there.energy_drift_max_rel << ", rounding " << rounding;
    }
  }
}

std::string name_of(const testing::TestParamInfo<BuiltinScenario>& info) {
  const bool slow = info.param.name == "pile_1000" || info.param.name == "pile_100";
  return (slow ? "Slow_" : "") + std::string(info.param.name);
}
INSTANTIATE_TEST_SUITE_P(BuiltIn, Origin, testing::ValuesIn(builtin_scenarios()), name_of);

/// V is the same everywhere.
class ConstantPotential final : public ForceModel<double> {
 public:
  explicit ConstantPotential(double v) : v_(v) {}
  void add_wrench(double, std::span<const BodyMotion<double>>, std::span<Wrench<double>>) const override {}
  double potential_energy(std::span<const BodyMotion<double>>) const override { return v_; }
  Effect effect_on(std::size_t) const override { return {}; }

 private:
  double v_;
};

RunResult with_potential(const Scenario& scenario, const RunConfig& config, double v) {
  const auto system = make_system<double>(scenario.problem, config.formulation);
  system->add_force(std::make_unique<ConstantPotential>(v));
  MotionScales scales = motion_scales(scenario, config.t_end);
  scales.force_terms += std::abs(v);
  DriftMeter meter(*system, scenario.invariants, config.t_end, false, {scales, nullptr});
  const auto integrator = integrator_of<double>(config, *system);
  State<double> state = system->start();
  const RunOutcome outcome = simulate(*system, *system, *integrator, state, schedule_of(config), meter);
  RunResult result;
  result.status = outcome.status == RunStatus::ok ? "ok" : "diverged";
  result.steps = outcome.steps;
  meter.report(result);
  return result;
}

TEST(Potential, ZeroChangesNothing) {
  for (const char* name : {"spring_box", "lagrange_top", "two_bodies", "physical_pendulum", "dzhanibekov"}) {
    const Scenario scenario = ScenarioSource::open(name).resolve();
    for (const char* method : {"explicit_euler", "rk4", "lie_midpoint"}) {
      const RunConfig config = configured(scenario, method);
      const RunResult here = with_potential(scenario, config, 0);
      // The energy at the start is exactly zero with the second one.
      for (const double v : {1e3, -*here.energy_initial}) {
        SCOPED_TRACE(std::string(name) + ", " + method + ", " + std::to_string(v) + " J");
        const RunResult there = with_potential(scenario, config, v);
        EXPECT_EQ(there.status, here.status);
        EXPECT_EQ(there.drift_class, here.drift_class);
        EXPECT_EQ(there.energy_scale, here.energy_scale);
        EXPECT_NEAR(*there.energy_drift_max_rel, *here.energy_drift_max_rel,
                    1e-6 * *here.energy_drift_max_rel + *there.energy_round_off / *there.energy_scale);
      }
    }
  }
}

/// A method that loses linear momentum too: the angular one is about the mass centre at the start, not the world's
/// origin.
TEST(Origin, AngularMomentumOfSeveralBodiesIsAboutTheirMassCentre) {
  const Scenario scenario = ScenarioSource::open("two_bodies").resolve();
  std::vector<double> drifts;
  for (const Vector& shift : {Vector(0, 0, 0), Vector(1e3, -1e3, 1e3)}) {
    const Scenario moved = retold(scenario, shift, {1, 0, 0, 0});
    const auto system = make_system<double>(moved.problem, {});
    DriftMeter meter(*system, {}, 1, false, {motion_scales(moved, 1), nullptr});
    State<double> state = system->start();
    for (const double kick : {0.0, 0.01}) {
      state.y[system->layout().slots[0].velocity] += kick;  // m/s
      state.t = kick;
      const Sample sample{state.t, system->measure(state.y), 0, 0};
      if (kick == 0) meter.on_start(state, sample);
      else meter.on_state(state, sample);
      EXPECT_EQ(meter.on_samples({&sample, 1}), 1u);
    }
    RunResult result;
    result.status = "ok";
    result.steps = 1;
    meter.report(result);
    EXPECT_GT(*result.linear_momentum_drift_max_rel, 1e-3);
    drifts.push_back(*result.angular_momentum_drift_max_rel);
  }
  EXPECT_NEAR(drifts[0], drifts[1], 1e-9);
}

/// A rod that hangs from its end, let go horizontally: the energies at the start cancel to round-off.
TEST(Origin, ARodLetGoHorizontallyIsNotDiverged) {
  const Scenario scenario = ScenarioSource::parse(
                                "gravity = [0, 0, -9.81]\nt_end = 10\n[[body]]\nmass = 1.5\n"
                                "inertia = [1.1666667, 1.1666667, 0.001]\npinned = true\n"
                                "center_of_mass = [0, 0, -0.8333333333]\n"
                                "orientation = [0.7071067811865476, 0.7071067811865475, 0, 0]\n",
                                "rod.toml")
                                .resolve();
  for (const char* method : {"rk4", "gauss4", "lie_midpoint"}) {
    RunConfig config = configured(scenario, method);
    config.dt = 0.01;
    const RunResult result = carry_out(config, scenario, {}, nullptr);
    EXPECT_EQ(result.status, "ok") << method;
    EXPECT_NEAR(*result.energy_scale, 1.5 * 9.81 * 0.8333333333, 1e-6) << "J, of half a swing";
    EXPECT_LT(*result.energy_drift_max_rel, 1e-4) << method;
  }
}

/// A drift has no scale where nothing moves.
TEST(Origin, ABodyAtRestHasNoRelativeDrift) {
  const Scenario scenario =
      ScenarioSource::parse("t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 2, 3]\nposition = [1, 2, 3]\n", "rest.toml")
          .resolve();
  const RunResult result = carry_out(configured(scenario, "rk4"), scenario, {}, nullptr);
  EXPECT_EQ(result.status, "ok");
  EXPECT_FALSE(result.energy_scale || result.energy_drift_max_rel || result.linear_momentum_drift_max_rel);
  EXPECT_EQ(result.energy_drift_max, 0.0);
}

/// Given by the scenario, it stands for the motion's own.
TEST(Origin, AScaleThatIsGivenIsTaken) {
  const char* text =
      "t_end = 1\nenergy_scale = 7\n[[body]]\nmass = 1\ninertia = [1, 2, 3]\nangular_velocity = [1, 0.1, 2]\n";
  const Scenario scenario = ScenarioSource::parse(text, "scale.toml").resolve();
  const RunResult result = carry_out(configured(scenario, "explicit_euler"), scenario, {}, nullptr);
  EXPECT_EQ(result.energy_scale, 7.0);
  EXPECT_DOUBLE_EQ(*result.energy_drift_max_rel * 7, *result.energy_drift_max);
}

}  // namespace
}  // namespace origin_test
}  // namespace polhode::study
