// SPDX-License-Identifier: BSD-3-Clause
// The effects of faults on a run: an exception is its own failure, a number that is none an empty place.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "experiments/study/metrics/drift_meter.hpp"
#include "experiments/study/metrics/motion_scales.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/result_numbers.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/csv.hpp"

namespace polhode::study::run_faults_test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

RunConfig rk4(const Scenario& scenario) {
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = "rk4";
  config.dt = 0.01;
  config.t_end = 1;
  return config;
}

TEST(RunFaults, AnExceptionOfOneLaneFailsThatRunAlone) {
  const Scenario sound = ScenarioSource::open("oscillator").resolve();
  Scenario broken = sound;
  broken.problem.forces.front().kind = "no such force";
  const RunConfig config = rk4(sound);
  const LanedRun runs[] = {{config, sound}, {config, broken}, {config, sound}};
  std::vector<RunResult> results(3);
  std::vector<int> times(3);
  carry_out_together({.runs = runs, .finish = [&](std::size_t run, RunResult&& result) {
                        results[run] = std::move(result);
                        ++times[run];
                      }});
  EXPECT_EQ(times, std::vector<int>(3, 1));
  const RunResult alone = carry_out(config, sound, {}, nullptr);
  ASSERT_EQ(alone.status, "ok");
  for (const std::size_t k : {0u, 2u}) {
    EXPECT_EQ(results[k].status, "ok") << results[k].message;
    EXPECT_EQ(results[k].energy_drift_final_rel, alone.energy_drift_final_rel);
  }
  EXPECT_EQ(results[1].status, "failed");
  EXPECT_NE(results[1].message.find("no such force"), std::string::npos) << results[1].message;
  EXPECT_FALSE(results[1].energy_drift_max_rel);
}

TEST(RunFaults, ATrajectoryThatCannotBeWrittenIsNoFaultOfTheRun) {
  const Scenario scenario = ScenarioSource::open("oscillator").resolve();
  for (const auto format : {TrajectoryFormat::csv, TrajectoryFormat::hdf5}) {
    EXPECT_THROW(carry_out(rk4(scenario), scenario, {format, "/dev/null/folder"}, nullptr), TrajectoryError);
  }
}

TEST(RunFaults, ARunThatIsStoppedWhileItsScalesAreMadeIsInterrupted) {
  const Scenario scenario = ScenarioSource::open("kovalevskaya_top").resolve();
  const std::atomic<bool> stop = true;
  ASSERT_FALSE(scenario.invariants.empty());
  EXPECT_EQ(motion_scales(scenario, 1, &stop).invariants.size(), scenario.invariants.size());
  EXPECT_EQ(carry_out(rk4(scenario), scenario, {}, &stop).status, "interrupted");
}

TEST(RunFaults, ARunWithoutAStepHasNoDrift) {
  const Scenario scenario = ScenarioSource::open("oscillator").resolve();
  const auto system = make_system<double>(scenario.problem, {});
  DriftMeter meter(*system, {}, 1, false, {motion_scales(scenario, 1), nullptr});
  const State<double> start = system->start();
  const Sample sample{0, system->measure(start.y), 0, 0};
  meter.on_start(start, sample);
  EXPECT_EQ(meter.on_samples({&sample, 1}), 1u);
  RunResult result;
  result.status = "failed";
  meter.report(result);
  EXPECT_EQ(result.energy_initial, 0.5);
  EXPECT_FALSE(result.energy_drift_max || result.energy_drift_max_rel || result.energy_drift_final_rel);
  EXPECT_FALSE(result.angular_momentum_drift_max_rel || result.orientation_defect_max || result.attitude_error_max);
}

TEST(ResultNumbers, AreFiniteAndZeroHasNoSign) {
  RunResult r;
  std::size_t numbers = 0;
  for (const Metric& metric : metric_table()) {
    if (metric.may_be_infinite) continue;
    with_value(metric, r, [&]<class Value>(Value& value) {
      if constexpr (std::is_same_v<Value, std::optional<double>>)
        value = std::array{-inf, nan, inf, -nan}[numbers++ % 4];
    });
  }
  EXPECT_GE(numbers, 31u);
  r.further = {{"no_number", nan}, {"no_sign", -0.0}};
  r.contact.friction_loss = -0.0;
  r.energy_drift_final_rel = -0.0;
  r.energy_initial = -1.5;
  r.position_reference = inf;  // a reference that could not follow the motion
  r.invariant_drift_max_rel = {{"p_phi", nan}, {"p_psi", 0.25}};
  r.series = {{0, 1, 0, 0, -0.0}, {1, inf, 0, 0, 0}, {2, 3, 0, 0, 0}};
  r.attitude_errors = {{0, nan}, {1, 2}};
  keep_finite(r);
  for (const Metric& metric : metric_table()) {
    if (metric.may_be_infinite || metric.column == "energy_initial_J") continue;
    const bool zero = metric.column == "energy_drift_final_rel" || metric.column == "friction_loss_J";
    with_value(metric, r, [&]<class Value>(const Value& value) {
      if constexpr (std::is_same_v<Value, std::optional<double>>) {
        EXPECT_EQ(value.has_value(), zero) << metric.column;
      }
    });
  }
  ASSERT_EQ(r.further.size(), 1u);
  EXPECT_FALSE(std::signbit(r.further.at("no_sign")));
  EXPECT_EQ(csv_cell(r.contact.friction_loss), "0");
  EXPECT_EQ(csv_cell(r.energy_drift_final_rel), "0");
  EXPECT_EQ(r.energy_initial, -1.5);
  EXPECT_EQ(r.position_reference, inf);
  EXPECT_EQ(csv_cell(r.position_reference), "");
  EXPECT_EQ(r.invariant_drift_max_rel, (std::map<std::string, double>{{"p_psi", 0.25}}));
  ASSERT_EQ(r.series.size(), 2u);
  EXPECT_FALSE(std::signbit(r.series[0].orientation_defect));
  EXPECT_EQ(r.series[1].t, 2);
  ASSERT_EQ(r.attitude_errors.size(), 1u);
  EXPECT_EQ(r.attitude_errors[0].error_rad, 2);
}

}  // namespace
}  // namespace polhode::study::run_faults_test
