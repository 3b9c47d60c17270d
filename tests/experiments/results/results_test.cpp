// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/results/best.hpp"
#include "experiments/results/groups.hpp"
#include "experiments/study/query/selection.hpp"
#include "experiments/study/store/run_rows.hpp"
#include "tests/experiments/study/store/stored_runs.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::results::results_test {
namespace {

TEST(Measures, AreThoseOfTheValuesInAnyOrder) {
  std::vector<double> values = {3, 1e100, 1, -1e100, 2};
  EXPECT_EQ(measured(Measure::sum, values), 6);
  EXPECT_EQ(measured(Measure::mean, values), 1.2);
  EXPECT_EQ(measured(Measure::median, values), 2);
  EXPECT_EQ(measured(Measure::min, values), -1e100);
  EXPECT_EQ(measured(Measure::max, values), 1e100);
  EXPECT_EQ(measured(Measure::count, values), 5);
  std::vector<double> even = {4, 1, 2, 3}, none;
  EXPECT_EQ(measured(Measure::median, even), 2.5);
  EXPECT_EQ(measured(Measure::count, none), 0);
  EXPECT_FALSE(measured(Measure::median, none));
  std::mt19937_64 random(2);
  std::vector<double> many;
  for (int k = 0; k < 1000; ++k) many.push_back(std::ldexp(static_cast<double>(random()), int(random() % 80) - 100));
  const auto sum = measured(Measure::sum, many);
  std::shuffle(many.begin(), many.end(), random);
  EXPECT_EQ(measured(Measure::sum, many), sum);
}

TEST(ParetoFront, HoldsThePointsThatNoOtherBeats) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<WorkPoint> points;
    for (int k = 0; k < 30; ++k) points.push_back({double(random() % 12), double(random() % 12)});
    const auto front = pareto_front(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool beaten = std::any_of(points.begin(), points.end(), [&](const WorkPoint& p) {
        return p.cost <= points[k].cost && p.error <= points[k].error &&
               (p.cost < points[k].cost || p.error < points[k].error);
      });
      const bool in_front = std::any_of(front.begin(), front.end(), [&](std::size_t f) {
        return points[f].cost == points[k].cost && points[f].error == points[k].error;
      });
      EXPECT_EQ(in_front, !beaten);
    }
    EXPECT_TRUE(std::is_sorted(front.begin(), front.end(),
                               [&](std::size_t a, std::size_t b) { return points[a].cost < points[b].cost; }));
  }
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Order, NumbersComeBeforeTextsAndAbsentValuesLast) {
  const std::vector<OptionValue> order = {
      -1.5,         std::int64_t{2}, 2.5, std::numeric_limits<double>::infinity(), std::string("a"), std::string("b"),
      OptionValue()};
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = 0; j < order.size(); ++j) {
      const int sign = compare(order[i], order[j]);
      EXPECT_EQ(sign < 0, i < j);
      EXPECT_EQ(sign > 0, i > j);
    }
  }
}

TEST(RunRows, HaveTheValuesThatWereKeptAndTheirChecksums) {
  const TemporaryFolder folder;
  const auto runs = store_tests::made_up_runs(20);
  {
    Store store(folder.path());
    store.keep(runs);
    store.database().execute("UPDATE runs SET steps = steps + 1 WHERE number = 3");
    store.database().execute("UPDATE timings SET wall_s = 9 WHERE number = 5");
    store.database().execute("DELETE FROM timings WHERE number = 7");
    store.database().execute("UPDATE runs SET id = 'abc' WHERE number = 10");
  }
  const Store store(folder.path(), metric_table(), Access::read);
  RunRows rows(store);
  EXPECT_EQ(rows.count(), 20);
  std::size_t k = 0;
  const std::size_t steps = *rows.find("steps"), wall = *rows.find("wall_s");
  rows.for_each([&](const RunRows::Row& row) {
    EXPECT_EQ(row.run.name(), k == 9 ? "row 10" : "run " + runs[k].id);
    EXPECT_EQ(row.damage, k == 2 ? "runs.checksum" : k == 4 || k == 6 ? "timings.checksum" : k == 9 ? "runs.id" : "");
    EXPECT_TRUE(is_integer(row.values[steps], runs[k].result.steps + (k == 2 ? 1 : 0)));
    ++k;
  });
  EXPECT_EQ(k, runs.size());
  const std::size_t chosen[] = {wall, steps};
  k = 0;
  rows.scan(chosen, [&](const RunRows::Part& part) {
    EXPECT_EQ(part.number, std::int64_t(k) + 1);
    EXPECT_TRUE(is_integer(part.values[1], runs[k].result.steps + (k == 2 ? 1 : 0)));
    ++k;
  });
  EXPECT_EQ(k, runs.size());
  std::vector<std::int64_t> all, in_parts;
  rows.for_each([&](const RunRows::Row& row) { all.push_back(row.run.id); });
  EXPECT_EQ(rows.last(), 20);
  for (std::int64_t after = 0; after < rows.last(); after += 7)
    rows.for_each(after, after + 7, [&](const RunRows::Row& row) { in_parts.push_back(row.run.id); });
  EXPECT_EQ(in_parts, all);
  EXPECT_EQ(rows.at(3).damage, "runs.checksum");
  EXPECT_EQ(rows.at(4).damage, "");
  EXPECT_THROW(rows.at(99), std::runtime_error);
}

TEST(RunRows, ScenariosAndStudiesComeBackUnlessTheyAreDamaged) {
  const TemporaryFolder folder;
  const Scenario scenario = ScenarioSource::open("lagrange_top").resolve();
  {
    Store store(folder.path());
    store.keep_scenarios({&scenario, 1});
    store.keep_study("energy_drift", "./run energy_drift", "{}");
    EXPECT_EQ(store.scenarios().at("lagrange_top").canonical, scenario.canonical());
    const std::string source = store.scenarios().at("lagrange_top").source;
    EXPECT_EQ(ScenarioSource::parse(source, "lagrange_top.toml").resolve().canonical(), scenario.canonical());
    ASSERT_EQ(store.studies().size(), 1u);
    EXPECT_EQ(store.studies()[0].command, "./run energy_drift");
    store.database().execute("UPDATE scenarios SET source = source || ' '");
    store.database().execute("UPDATE studies SET command = 'other'");
  }
  const Store store(folder.path(), metric_table(), Access::read);
  EXPECT_TRUE(store.scenarios().empty());
  EXPECT_TRUE(store.studies().empty());
}

}  // namespace
}  // namespace polhode::study::results::results_test
