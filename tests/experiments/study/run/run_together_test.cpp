// SPDX-License-Identifier: BSD-3-Clause
// Runs side by side have the results that each has alone, and a meter shows the same however its samples are cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <type_traits>
#include <vector>

#include "experiments/study/metrics/drift_meter.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::run_together_test {
namespace {

RunConfig by_rk4(const Scenario& scenario, double dt) {
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = "rk4";
  config.dt = dt;
  config.t_end = 5;
  return config;
}

void expect_same_result(const RunResult& a, const RunResult& b) {
  for (const Metric& metric : metric_table()) {
    with_value(metric, a, [&](const auto& of_a) {
      with_value(metric, b, [&](const auto& of_b) {
        if constexpr (std::is_same_v<decltype(of_a), decltype(of_b)>) {
          EXPECT_EQ(of_a, of_b) << metric.column;
        }
      });
    });
  }
  ASSERT_EQ(a.series.size(), b.series.size());
  for (std::size_t i = 0; i < a.series.size(); ++i) {
    const SeriesPoint &x = a.series[i], &y = b.series[i];
    EXPECT_TRUE(x.t == y.t && x.energy_drift_rel == y.energy_drift_rel &&
                x.linear_momentum_drift_rel == y.linear_momentum_drift_rel &&
                x.angular_momentum_drift_rel == y.angular_momentum_drift_rel &&
                x.orientation_defect == y.orientation_defect)
        << "point " << i;
  }
  ASSERT_EQ(a.attitude_errors.size(), b.attitude_errors.size());
  for (std::size_t i = 0; i < a.attitude_errors.size(); ++i) {
    EXPECT_EQ(a.attitude_errors[i].t, b.attitude_errors[i].t);
    EXPECT_EQ(a.attitude_errors[i].error_rad, b.attitude_errors[i].error_rad) << "error " << i;
  }
}

TEST(RunsTogether, HaveTheErrorsThatEachHasAlone) {
  const char* const spins[][3] = {
      {"0.01", "1", "0.3"}, {"1", "0", "0"}, {"1e-9", "1", "0"}, {"2", "0.1", "1"}, {"30", "-40", "7"}};
  for (const std::string name : {"dzhanibekov", "free_symmetric_top", "coursework", "projectile"}) {
    std::vector<Scenario> scenarios;
    for (const auto& spin : spins) {  // the second one turns steadily
      std::vector<Override> start;
      for (std::size_t k = 0; k < 3; ++k) start.push_back({"body.0.angular_velocity." + std::to_string(k), spin[k]});
      scenarios.push_back(ScenarioSource::open(name).resolve(start));
    }
    std::vector<RunConfig> configs;
    for (const double dt : {0.01, 0.03, 0.3}) {
      for (const Scenario& scenario : scenarios) configs.push_back(by_rk4(scenario, dt));
    }
    for (const std::string method : {"rk4", "explicit_euler"}) {
      std::vector<LanedRun> runs;
      for (std::size_t i = 0; i < configs.size(); ++i) {
        configs[i].integrator = method;
        runs.push_back({configs[i], scenarios[i % scenarios.size()], true});
      }
      std::vector<RunResult> together(runs.size());
      carry_out_together(
          {.runs = runs, .finish = [&](std::size_t run, RunResult&& result) { together[run] = std::move(result); }});
      for (std::size_t i = 0; i < runs.size(); ++i) {
        SCOPED_TRACE(name + " by " + method + ", run " + std::to_string(i));
        expect_same_result(together[i], carry_out(configs[i], runs[i].scenario, {}, nullptr));
      }
    }
  }
}

TEST(RunsTogether, HaveTheResultsThatEachHasAlone) {
  std::vector<Scenario> scenarios;
  for (const char* spin : {"0.3", "1e6", "2.0", "0.0"}) {  // the second one blows up
    const Override spun{"body.0.angular_velocity.1", spin};
    scenarios.push_back(ScenarioSource::open("free_symmetric_top").resolve({&spun, 1}));
  }
  ASSERT_EQ(scenarios.front().invariants.size(), 2u);
  std::vector<RunConfig> configs;
  std::vector<LanedRun> runs;
  for (const double dt : {0.01, 0.5, 0.003, 0.007, 0.02}) {
    for (std::size_t i = 0; i < scenarios.size(); ++i) configs.push_back(by_rk4(scenarios[i], dt));
  }
  for (std::size_t i = 0; i < configs.size(); ++i)
    runs.push_back({configs[i], scenarios[i % scenarios.size()], i % 3 != 0});
  std::vector<RunResult> together(runs.size());
  std::atomic<double> share = 0;
  carry_out_together({.runs = runs,
                      .finish = [&](std::size_t run, RunResult&& result) { together[run] = std::move(result); },
                      .share = &share});
  EXPECT_GT(share, 0.5);
  EXPECT_LE(share, 1);
  int diverged = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    SCOPED_TRACE(i);
    RunResult alone = carry_out(configs[i], runs[i].scenario, {}, nullptr);
    if (!runs[i].keeps_curves) drop_curves(alone);
    diverged += alone.status == "diverged";
    expect_same_result(together[i], alone);
  }
  EXPECT_GE(diverged, 5);
}

TEST(RunsTogether, BeginNoFurtherRunWhenToldSo) {
  const Scenario scenario = ScenarioSource::open("free_symmetric_top").resolve();
  const RunConfig config = by_rk4(scenario, 0.01);
  const std::vector<LanedRun> runs(3 * std::size_t(lane_count), {config, scenario});
  std::atomic<bool> no_more = false;
  std::size_t finished = 0;
  carry_out_together({.runs = runs,
                      .finish =
                          [&](std::size_t, RunResult&& result) {
                            EXPECT_EQ(result.status, "ok");
                            ++finished;
                            no_more = true;
                          },
                      .no_more = &no_more});
  EXPECT_EQ(finished, std::size_t(lane_count)) << "those under way";
}

TEST(RunsTogether, HaveTheSameInvariants) {
  const Scenario top = ScenarioSource::open("free_symmetric_top").resolve();
  Scenario other = top;
  other.invariants = {"casimir"};
  const RunConfig config = by_rk4(top, 0.01);
  ASSERT_NE(ensemble_key(config, top, {}), "");
  EXPECT_NE(ensemble_key(config, top, {}), ensemble_key(config, other, {}));
}

TEST(DriftMeterSamples, MayComeInAnyParts) {
  const Scenario scenario = ScenarioSource::open("free_symmetric_top").resolve();
  const auto system = make_system<double>(scenario.problem, {});
  const MotionScales scales = motion_scales(scenario, 10);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const State<double> start = system->start();
  std::vector<Sample> samples;
  for (int k = 0; k <= 1000; ++k) {
    Sample sample{0.01 * k, system->measure(start.y), 0, 0};
    sample.seen.kinetic += k == 0 ? 0 : 1e-3 * normal(random);
    sample.seen.angular_momentum.x() += k == 0 ? 0 : 1e-3 * normal(random);
    sample.seen.linear_momentum.y() += k == 0 ? 0 : 1e-3 * normal(random);
    sample.seen.orientation_defect = std::abs(normal(random));
    samples.push_back(sample);
  }
  const auto result_of_parts = [&](std::size_t length) {
    DriftMeter meter(*system, {}, 10, false, {scales, nullptr});
    meter.on_start(start, samples.front());
    std::size_t taken = 0;
    for (std::size_t i = 0; i < samples.size(); i += length) {
      const auto part = std::span(samples).subspan(i, std::min(length, samples.size() - i));
      const std::size_t now = meter.on_samples(part);
      taken += now;
      if (now < part.size()) break;
    }
    RunResult result;
    result.status = "ok";
    result.steps = static_cast<std::int64_t>(taken);
    meter.report(result);
    return result;
  };
  const RunResult one_by_one = result_of_parts(1);
  EXPECT_EQ(one_by_one.steps, 1001);
  for (const std::size_t length : {3u, 64u, 65u, 1001u}) expect_same_result(result_of_parts(length), one_by_one);
  samples[500].seen.kinetic = 1e9 * scales.energy;  // hopeless: it counts, and is the last one
  const RunResult broken = result_of_parts(1);
  EXPECT_EQ(broken.steps, 500);
  EXPECT_GT(broken.energy_drift_max_rel.value(), 1e8);
  for (const std::size_t length : {7u, 64u, 1001u}) expect_same_result(result_of_parts(length), broken);
}

}  // namespace
}  // namespace polhode::study::run_together_test
