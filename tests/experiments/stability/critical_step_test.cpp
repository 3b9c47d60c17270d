// SPDX-License-Identifier: BSD-3-Clause
// The search for a critical step on made-up scans.
#include "experiments/stability/critical_step.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace polhode::study::stability::critical_step_test {
namespace {

/// Scans, then bisects as the study does; the number of further steps is returned.
std::pair<CriticalStep, int> search(const std::function<bool(double)>& stable, double ratio) {
  std::vector<TriedStep> tried;
  for (double dt = 0.01; dt < 100; dt *= ratio) tried.push_back({dt, stable(dt)});
  int further = 0;
  for (;; ++further) {
    const auto found = critical_step(tried);
    const auto dt = next_step(found);
    if (!dt || further == 100) return {found, further};
    tried.push_back({*dt, stable(*dt)});
  }
}

TEST(CriticalStep, IsBracketedToThreePerMille) {
  for (const double limit : {0.0123, 2.0, 2 * std::numbers::sqrt2, 77.0}) {
    const auto [found, further] = search([&](double dt) { return dt < limit; }, 1.3);
    EXPECT_EQ(found.kind, CriticalStep::Kind::found);
    EXPECT_LT(found.holds, limit);
    EXPECT_GE(found.fails, limit);
    EXPECT_LE(found.fails - found.holds, 0.003 * found.fails);
    EXPECT_LE(further, 7);
    EXPECT_FALSE(found.holds_again);
  }
}

TEST(CriticalStep, StableWindowsAboveItDoNotHideIt) {
  const auto [found, further] = search([](double dt) { return dt < 1 || (dt > 3 && dt < 9) || dt > 50; }, 1.3);
  EXPECT_NEAR(found.fails, 1, 0.003);
  EXPECT_TRUE(found.holds_again);
}

TEST(CriticalStep, MayBeAbsentOrBelowAllSteps) {
  const auto none = search([](double) { return true; }, 1.5).first;
  EXPECT_EQ(none.kind, CriticalStep::Kind::none);
  EXPECT_GT(none.holds, 60);
  const auto always = search([](double) { return false; }, 1.5).first;
  EXPECT_EQ(always.kind, CriticalStep::Kind::from_start);
  EXPECT_DOUBLE_EQ(always.fails, 0.01);
}

}  // namespace
}  // namespace polhode::study::stability::critical_step_test
