// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/rerun/rerun.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/rerun/comparison.hpp"
#include "experiments/study/run/run.hpp"
#include "tests/experiments/study/query/stored_studies.hpp"
#include "tests/experiments/study/store/stored_runs.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::rerun::rerun_test {
namespace {

std::vector<Repeated> repeated(const std::vector<FoundRun>& runs) {
  const std::atomic<bool> no{false};
  std::vector<Repeated> all;
  repeat(runs, 2, no, no, [&](const Repeated& one) { all.push_back(one); });
  return all;
}

TEST(Rerun, ADigitThatIsNotTheSameIsNamedWithBothValues) {
  RunConfig config;
  config.scenario = "top";
  config.integrator = "rk4";
  config.dt = 0.125;
  const TemporaryFolder folder;
  RunRecord run = query_tests::run_of(query_tests::top, config);
  run.result = carry_out(run.config, *run.scenario, {}, nullptr);
  query_tests::keep_in(folder.path(), query_tests::top, run);
  {
    const ResultStores stores({folder.path().string()});
    const auto all = repeated(all_runs(stores));
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].why_not, "");
    EXPECT_TRUE(all[0].differences.empty());
  }
  const double energy = *run.result.energy_initial;
  run.result.energy_initial = std::nextafter(energy, 100);
  run.result.seconds = 77;  // wall times are not compared
  query_tests::keep_in(folder.path(), query_tests::top, run);
  {
    const ResultStores stores({folder.path().string()});
    const auto all = repeated(all_runs(stores));
    ASSERT_EQ(all.size(), 1u);
    ASSERT_EQ(all[0].differences.size(), 1u);
    EXPECT_EQ(all[0].differences[0].name, "energy_initial_J");
    EXPECT_EQ(std::stod(all[0].differences[0].stored), std::nextafter(energy, 100));
    EXPECT_EQ(std::stod(all[0].differences[0].again), energy);
  }
  run.id = "0123456789abcdef";
  query_tests::keep_in(folder.path(), query_tests::top, run);
  const ResultStores stores({folder.path().string()});
  const auto other = repeated({stores.find("0123")});
  ASSERT_EQ(other.size(), 1u);
  EXPECT_NE(other[0].why_not.find("its id is not that of what the store says of it"), std::string::npos);
}

TEST(Rerun, ARunIsToldAsSoonAsItHasEnded) {
  const TemporaryFolder folder;
  for (const double dt : {0.125, 0.25, 0.5}) {
    RunConfig config;
    config.scenario = "top";
    config.integrator = "rk4";
    config.dt = dt;
    query_tests::keep_in(folder.path(), query_tests::top, query_tests::run_of(query_tests::top, config));
  }
  const ResultStores stores({folder.path().string()});
  ASSERT_EQ(all_runs(stores).size(), 3u);
  std::atomic<bool> no_more{false};
  const std::atomic<bool> stop{false};
  std::size_t told = 0;
  repeat(all_runs(stores), 1, no_more, stop, [&](const Repeated&) {
    ++told;
    no_more = true;
  });
  EXPECT_EQ(told, 1u) << "the others had not begun";
}

TEST(Rerun, EveryMetricAndCurveIsCompared) {
  const RunResult whole = store_tests::made_up_run(4).result;
  EXPECT_TRUE(differences(whole, whole).empty());
  for (const Metric& metric : metric_table()) {
    RunResult other = whole;
    with_value(metric, other, [&]<class Value>(Value& value) {
      if constexpr (std::is_same_v<Value, std::string>) value += "x";
      else if constexpr (std::is_same_v<Value, std::int64_t>) ++value;
      else if constexpr (std::is_same_v<Value, std::optional<double>>)
        value = value ? std::nullopt : std::optional(1.0);
      else value.begin()->second = std::nextafter(value.begin()->second, 1e300);
    });
    const auto found = differences(whole, other);
    ASSERT_EQ(found.size(), 1u) << metric.column;
    EXPECT_EQ(found[0].name, metric.column == "invariant_drifts_max_rel" ? "p_phi_drift_max_rel" : metric.column);
  }
  RunResult other = whole;
  other.series[1].energy_drift_rel = std::nextafter(other.series[1].energy_drift_rel, 0);
  other.t_reached = std::nextafter(other.t_reached, 0);
  const auto found = differences(whole, other);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "t_reached_s");
  EXPECT_EQ(found[1].name, "series, point 2");
  RunResult without = whole;
  without.series.clear();
  without.attitude_errors.clear();
  EXPECT_TRUE(differences(without, whole).empty()) << "curves that were not kept are not compared";
}

TEST(Rerun, TheDrawIsThatOfTheSeed) {
  std::vector<FoundRun> runs;
  for (std::uint64_t k = 0; k < 100; ++k) runs.push_back({nullptr, id_of_number(k)});
  const auto ids = [](const std::vector<FoundRun>& drawn) {
    std::vector<std::string> all;
    for (const FoundRun& run : drawn) all.push_back(run.id);
    return all;
  };
  const auto a = ids(drawn(runs, 10, 1)), b = ids(drawn(runs, 10, 1)), c = ids(drawn(runs, 10, 2));
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
  EXPECT_EQ(a.size(), 10u);
  EXPECT_TRUE(std::is_sorted(a.begin(), a.end()));
  EXPECT_EQ(std::adjacent_find(a.begin(), a.end()), a.end());
  EXPECT_EQ(drawn(runs, 1000, 1).size(), 100u);
}

}  // namespace
}  // namespace polhode::study::rerun::rerun_test
