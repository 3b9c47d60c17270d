// SPDX-License-Identifier: BSD-3-Clause
// Runs that are carried out faster than they are stored.
#include "experiments/study/workers/workers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "experiments/study/plan/options.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::workers_test {
namespace {

const Experiment fast_tops = {
    .name = "tops",
    .question = "How many runs wait for the store?",
    .defaults = {{"scenario", "peters_hsu"}, {"integrator", "rk4"}, {"dt", "0.1"}, {"tolerance", "1e-6"}}};

/// A plan with so many runs.
Plan planned(std::size_t count) {
  const std::string axis = "body.0.mass=1:2:" + std::to_string(count);
  const std::vector<const char*> words = {"tops", "--vary", axis.c_str()};
  return make_plan(fast_tops, parse_options(fast_tops, int(words.size()), words.data()).options);
}

std::vector<std::uint32_t> all_runs(const Plan& plan) {
  std::vector<std::uint32_t> runs(plan.size());
  std::iota(runs.begin(), runs.end(), 0U);
  return runs;
}

TEST(Workers, WaitForTheStoreOnceManyRunsAreFinished) {
  constexpr std::size_t most = 8192;
  const Plan plan = planned(30'000);
  const std::vector<std::uint32_t> runs = all_runs(plan);
  std::size_t largest = 0;
  const Work work{.key = [](const PlannedRun&) { return std::string("together"); },
                  .carry_out =
                      [](Batch batch, std::atomic<double>&, const Finished& finished) {
                        RunResult result;
                        result.status = "ok";
                        for (std::size_t k = 0; k < batch.size(); ++k) finished(k, RunResult(result));
                      },
                  .finish =
                      [&](const std::vector<RunRecord>& finished) {
                        largest = std::max(largest, finished.size());
                        std::this_thread::sleep_for(std::chrono::milliseconds(300));
                      }};
  const TemporaryFolder folder;
  Store store(folder.path());
  store.keep_scenarios(plan.scenarios);
  std::atomic<bool> no_more{false};
  std::vector<std::uint32_t> stored = run_all("tops", plan, runs, work, 2, store, no_more);
  std::sort(stored.begin(), stored.end());
  EXPECT_EQ(stored, runs);
  EXPECT_LE(largest, most);
}

TEST(Workers, DoNotWaitForAStoreThatHasFailed) {
  const Plan plan = planned(30'000);
  const Work work{.key = [](const PlannedRun&) { return std::string("together"); },
                  .carry_out =
                      [](Batch batch, std::atomic<double>&, const Finished& finished) {
                        for (std::size_t k = 0; k < batch.size(); ++k) finished(k, RunResult());
                      },
                  .finish =
                      [](const std::vector<RunRecord>&) {
                        std::this_thread::sleep_for(std::chrono::milliseconds(300));  // until the workers wait
                        throw std::runtime_error("the disk is full");
                      }};
  const TemporaryFolder folder;
  Store store(folder.path());
  std::atomic<bool> no_more{false};
  EXPECT_THROW(run_all("tops", plan, all_runs(plan), work, 2, store, no_more), std::runtime_error);
  EXPECT_TRUE(no_more);
}

void finish_at_once(Batch batch, std::atomic<double>&, const Finished& finished) {
  RunResult result;
  result.status = "ok";
  for (std::size_t k = 0; k < batch.size(); ++k) finished(k, RunResult(result));
}

TEST(Workers, CommitRunsWhileOthersAreUnderWay) {
  const Plan plan = planned(2);
  const TemporaryFolder folder;
  Store store(folder.path());
  store.keep_scenarios(plan.scenarios);
  std::size_t batches = 0, committed = 0;
  const Work work{.key = [](const PlannedRun&) { return std::string(); },
                  .carry_out =
                      [&](Batch batch, std::atomic<double>& share, const Finished& finished) {
                        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
                        while (batches == 1 && committed == 0 && std::chrono::steady_clock::now() < end)
                          committed = Store(folder.path(), metric_table(), Access::read).ids().size();
                        ++batches;
                        finish_at_once(batch, share, finished);
                      },
                  .finish = [](const std::vector<RunRecord>&) {}};
  std::atomic<bool> no_more{false};
  EXPECT_EQ(run_all("tops", plan, all_runs(plan), work, 1, store, no_more).size(), 2u);
  EXPECT_EQ(committed, 1u);
}

TEST(Workers, KeepFinishedRunsWhereLaterOnesCannotBeFinished) {
  const Plan plan = planned(30'000);
  std::size_t finished = 0;
  const Work work{.key = [](const PlannedRun&) { return std::string("together"); },
                  .carry_out = finish_at_once,
                  .finish =
                      [&](const std::vector<RunRecord>& runs) {
                        if (finished > 0) throw std::runtime_error("the disk is full");
                        finished = runs.size();
                      }};
  const TemporaryFolder folder;
  Store store(folder.path());
  store.keep_scenarios(plan.scenarios);
  std::atomic<bool> no_more{false};
  EXPECT_THROW(run_all("tops", plan, all_runs(plan), work, 2, store, no_more), std::runtime_error);
  EXPECT_GT(finished, 0u);
  EXPECT_EQ(store.ids().size(), finished);
}

}  // namespace
}  // namespace polhode::study::workers_test
