// SPDX-License-Identifier: BSD-3-Clause
// Programs that are fed while they run.
#include "experiments/study/text/child_process.hpp"

#include <gtest/gtest.h>

namespace polhode::study::report::child_process_test {
namespace {

TEST(ChildProcess, MayPrintWhileItIsFedMoreThanAPipeHolds) {
  auto child = ChildProcess::start({"cat"}, ".", {}, ChildProcess::Input::fed);
  ASSERT_TRUE(child);
  std::string fed;
  for (int i = 0; i < 3'000'000; ++i) fed.push_back(char('a' + i % 23));
  EXPECT_TRUE(child->feed({reinterpret_cast<const std::uint8_t*>(fed.data()), fed.size()}));
  const auto outcome = child->wait();
  EXPECT_EQ(outcome.exit_status, 0);
  EXPECT_TRUE(outcome.printed == fed);
}

TEST(ChildProcess, SaysWhenItReadsNoMore) {
  auto child = ChildProcess::start({"false"}, ".", {}, ChildProcess::Input::fed);
  ASSERT_TRUE(child);
  const std::vector<std::uint8_t> much(3'000'000, 0);
  EXPECT_FALSE(child->feed(much));
  EXPECT_EQ(child->wait().exit_status, 1);
}

}  // namespace
}  // namespace polhode::study::report::child_process_test
