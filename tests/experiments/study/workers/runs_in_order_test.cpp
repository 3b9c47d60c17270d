// SPDX-License-Identifier: BSD-3-Clause
// Finished runs that are used in the order of the plan, while others are under way.
#include "experiments/study/workers/runs_in_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace polhode::study::runs_in_order_test {
namespace {

std::vector<std::uint32_t> numbers_to(std::size_t end) {
  std::vector<std::uint32_t> numbers(end);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

void finish(RunsInOrder& runs, const std::vector<std::uint32_t>& numbers) {
  std::vector<RunRecord> records(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) records[k].id = std::to_string(numbers[k]);
  runs.add(numbers, records);
}

/// Appends the ids of the runs of each part to `used`.
MakePart into(std::vector<std::string>& used) {
  return [&used](std::vector<RunRecord>&& runs) -> UsePart {
    std::vector<std::string> ids;
    for (const RunRecord& run : runs) ids.push_back(run.id);
    return [&used, ids = std::move(ids)] { used.insert(used.end(), ids.begin(), ids.end()); };
  };
}

std::vector<std::string> ids_to(std::size_t end) {
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < end; ++k) ids.push_back(std::to_string(k));
  return ids;
}

TEST(RunsInOrder, AreUsedInTheOrderOfThePlanWhateverTheirOwn) {
  constexpr std::size_t count = 10 * runs_of_a_part + 7;
  std::vector<std::string> used;
  RunsInOrder runs(count, into(used));
  std::vector<std::uint32_t> order = numbers_to(count);
  std::mt19937 random(1);
  std::shuffle(order.begin(), order.end(), random);
  for (std::size_t k = 0; k < count; k += 100) {
    finish(runs, {order.begin() + std::ptrdiff_t(k), order.begin() + std::ptrdiff_t(std::min(k + 100, count))});
    runs.work();
  }
  for (int k = 0; k < 11; ++k) runs.work();
  EXPECT_EQ(runs.used(), 11U);
  EXPECT_EQ(used, ids_to(count));
}

TEST(RunsInOrder, AreUsedAsSoonAsTheirTurnHasCome) {
  std::vector<std::string> used;
  RunsInOrder runs(3 * runs_of_a_part, into(used));
  std::vector<std::uint32_t> first = numbers_to(runs_of_a_part);
  const std::uint32_t last = first.back();
  first.pop_back();
  finish(runs, first);
  runs.work();
  EXPECT_TRUE(used.empty());
  finish(runs, {last});
  runs.work();
  EXPECT_EQ(used, ids_to(runs_of_a_part));
  EXPECT_EQ(runs.used(), 1U);
}

TEST(RunsInOrder, AreForgottenOnceTooManyWait) {
  constexpr std::size_t before = 2 * runs_of_a_part, end = RunsInOrder::most_waiting + 5 * runs_of_a_part;
  std::vector<std::string> used;
  RunsInOrder runs(end, into(used));
  finish(runs, numbers_to(before));
  runs.work();
  runs.work();
  ASSERT_EQ(runs.used(), 2U);
  std::vector<std::uint32_t> order = numbers_to(end);
  order.erase(order.begin(), order.begin() + before);
  std::reverse(order.begin(), order.end());
  for (const std::uint32_t number : order) {
    finish(runs, {number});
    runs.work();
  }
  EXPECT_EQ(runs.used(), 2U);
  EXPECT_EQ(used, ids_to(before));
}

TEST(RunsInOrder, MayBeMadeOnSeveralThreads) {
  constexpr std::size_t count = RunsInOrder::most_waiting, parts = count / runs_of_a_part;  // none is forgotten
  std::vector<std::string> used;
  RunsInOrder runs(count, into(used));
  std::vector<std::thread> threads;
  for (int k = 0; k < 3; ++k) {
    threads.emplace_back([&] {
      while (runs.used() < parts) runs.work();
    });
  }
  const std::vector<std::uint32_t> order = numbers_to(count);
  for (std::size_t k = 0; k < count; k += 64)
    finish(runs, {order.begin() + std::ptrdiff_t(k), order.begin() + std::ptrdiff_t(k + 64)});
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(used, ids_to(count));
}

TEST(RunsInOrder, PassOnWhatIsThrown) {
  RunsInOrder refused(runs_of_a_part, [](std::vector<RunRecord>&&) -> UsePart { throw std::runtime_error("make"); });
  finish(refused, numbers_to(runs_of_a_part));
  EXPECT_THROW(refused.work(), std::runtime_error);
  RunsInOrder full(runs_of_a_part, [](std::vector<RunRecord>&&) -> UsePart {
    return [] { throw std::runtime_error("the disk is full"); };
  });
  finish(full, numbers_to(runs_of_a_part));
  EXPECT_THROW(full.work(), std::runtime_error);
  EXPECT_EQ(full.used(), 0U);
}

}  // namespace
}  // namespace polhode::study::runs_in_order_test
