// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/in_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace polhode::study::in_order_test {
namespace {

class InOrder : public testing::TestWithParam<std::size_t> {};  // number of threads

TEST_P(InOrder, PartsAreUsedInTheirOrder) {
  std::vector<std::size_t> used;
  std::atomic<bool> in_use{false};
  in_order(200, GetParam(), [&](std::size_t part) -> UsePart {
    std::this_thread::sleep_for(std::chrono::microseconds(part % 7 == 0 ? 500 : 0));
    return [&, part] {
      EXPECT_FALSE(in_use.exchange(true));
      used.push_back(part);
      in_use = false;
    };
  });
  std::vector<std::size_t> all(200);
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_EQ(used, all);
}

TEST_P(InOrder, FewPartsAreMadeAhead) {
  std::atomic<std::size_t> made{0}, most{0};
  std::size_t used = 0;
  in_order(300, GetParam(), [&](std::size_t) -> UsePart {
    ++made;
    return [&] {
      if (used == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the others go on meanwhile
      most = std::max<std::size_t>(most, made - used);
      ++used;
    };
  });
  EXPECT_LE(most, 2 * GetParam());
}

TEST_P(InOrder, AsManyPartsAreMadeAheadAsIsSaid) {
  if (std::min<std::size_t>(GetParam(), std::thread::hardware_concurrency()) < 2)
    GTEST_SKIP() << "skipped, because one thread makes no part ahead";
  std::atomic<std::size_t> made{0}, most{0};
  std::size_t used = 0;
  const auto make = [&](std::size_t part) -> UsePart {
    ++made;
    for (int wait = 0; part == 0 && made < 40 && wait < 10000; ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return [&] {
      most = std::max<std::size_t>(most, made - used);
      ++used;
    };
  };
  in_order(300, GetParam(), make, 40);
  EXPECT_EQ(most, 40U);
  EXPECT_EQ(used, 300U);
}

TEST_P(InOrder, TheFirstFailureIsRethrownAfterThePartsBeforeIt) {
  for (const std::string fails : {"make", "use"}) {
    std::size_t used = 0;
    const auto run = [&] {
      in_order(100, GetParam(), [&](std::size_t part) -> UsePart {
        const bool failing = part >= 20;
        if (part == 20) std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the next one fails before it
        if (failing && fails == "make") throw std::runtime_error(std::to_string(part));
        return [&, part, failing] {
          if (failing) throw std::runtime_error(std::to_string(part));
          ++used;
        };
      });
    };
    try {
      run();
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "20");
    }
    EXPECT_EQ(used, 20U);
  }
}

TEST_P(InOrder, NoPartsAreNoWork) {
  in_order(0, GetParam(), [](std::size_t) -> UsePart { throw std::logic_error("there is no part"); });
}

INSTANTIATE_TEST_SUITE_P(Threads, InOrder, testing::Values(1U, 2U, 5U));

}  // namespace
}  // namespace polhode::study::in_order_test
