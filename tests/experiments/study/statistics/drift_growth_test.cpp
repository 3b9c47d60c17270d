// SPDX-License-Identifier: BSD-3-Clause
// Drifts whose law is known: hardly a decided class is wrong, most are decided, and the intervals hold the truth about
// as often as they say.
#include "experiments/study/statistics/drift_growth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <random>
#include <thread>
#include <vector>

#include "experiments/study/metrics/drift_class.hpp"

namespace polhode::study::drift_growth_test {
namespace {

using std::numbers::pi;
using Random = std::mt19937;

constexpr int samples = 8000, seeds = 200;
constexpr double t_end = 100;

/// drift = trend(t/t_end) + oscillation + random walk + noise, less its value at the start.
struct Law {
  const char* expected;
  double exponent;
  std::function<double(double)> trend;
  double slope;                      ///< slope of the least-squares line, per t_end
  double amplitude = 0;              ///< amplitude of the oscillation, which has a second harmonic
  double shortest = 1, longest = 5;  ///< period, s
  double walk = 0;                   ///< standard deviation at the end
  double noise = 0;
  double least_decided = 0.95;
};

struct Counts {
  int decided = 0, right = 0, exponent_covered = 0, slope_covered = 0;
  double width = 0;  ///< mean half width of the exponent's interval
};

void run(const Law& law, int seed, Counts& counts) {
  Random random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double period = law.shortest + (law.longest - law.shortest) * uniform(random), phase = 2 * pi * uniform(random);
  BlockMeans blocks;
  double walk = 0, start = 0, largest = 0, sum_t = 0, sum_tt = 0, sum_d = 0, sum_td = 0;
  for (int k = 0; k <= samples; ++k) {
    const double t = t_end * k / samples, u = 2 * pi * t / period + phase;
    double d = law.trend(t / t_end) + law.amplitude * (std::sin(u) + 0.3 * std::sin(2 * u)) + walk;
    if (law.noise > 0) d += law.noise * normal(random);
    if (k == 0) start = d;
    d -= start;
    blocks.add(t, d);
    largest = std::max(largest, std::abs(d));
    sum_t += t;
    sum_tt += t * t;
    sum_d += d;
    sum_td += t * d;
    if (law.walk > 0) walk += law.walk * normal(random) / std::sqrt(samples);
  }
  const double n = samples + 1, slope = (n * sum_td - sum_t * sum_d) / (n * sum_tt - sum_t * sum_t);
  const auto growth = growth_of(blocks.finish());
  ASSERT_TRUE(growth);
  EXPECT_LE(growth->low, growth->exponent);
  EXPECT_LE(growth->exponent, growth->high);
  const DriftClass c = classify({.blocks = blocks.finish(),
                                 .largest = largest,
                                 .largest_early = largest,
                                 .round_off = 1e-12,
                                 .scale = 1e6,
                                 .samples = samples + 1,
                                 .t_end = t_end,
                                 .impacts = {}});
  counts.decided += c.name != "undecided";
  counts.right += c.name == law.expected;
  // The exponent of a bounded drift is that of its noise, below 0.
  counts.exponent_covered += std::max(growth->low, 0.0) <= law.exponent && law.exponent <= growth->high;
  counts.slope_covered += std::abs(slope - law.slope / t_end) <= growth->slope_half_width_95;
  counts.width += (growth->high - growth->low) / 2 / seeds;
}

Counts run(const Law& law) {
  Counts counts;
  for (int seed = 1; seed <= seeds; ++seed) run(law, seed, counts);
  return counts;
}

double none(double) { return 0; }
double linear(double s) { return s; }
double quadratic(double s) { return s * s; }

void PrintTo(const Law& law, std::ostream* out) {
  *out << law.expected << ", amplitude " << law.amplitude << ", walk " << law.walk << ", noise " << law.noise;
}

class Drifts : public testing::TestWithParam<Law> {};

TEST_P(Drifts, HaveTheirClassAndTheirIntervals) {
  const Law& law = GetParam();
  const Counts counts = run(law);
  EXPECT_GE(counts.right, 0.98 * counts.decided);
  EXPECT_GE(counts.decided, law.least_decided * seeds);
  // 95 % of 200 is 190; a binomial number is below 180 once in a thousand times.
  if (law.exponent > 0) {
    EXPECT_GE(counts.exponent_covered, 180);
  }
  EXPECT_GE(counts.slope_covered, 180);
  EXPECT_LE(counts.width, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Laws, Drifts,
                         testing::Values(Law{"bounded", 0, none, 0, 1}, Law{"bounded", 0, none, 0, 1, 0.3, 0.7},
                                         Law{"bounded", 0, none, 0, 1, 1, 5, 0, 0.3},
                                         Law{"bounded", 0, none, 0, 0, 1, 5, 0, 1},
                                         Law{"linear", 1, linear, 1, 1, 1, 5, 0, 0.05},
                                         Law{"linear", 1, linear, 1, 5, 1, 2, 0, 0.05, 0.8},
                                         Law{"linear", 1, linear, 1, 0, 1, 5, 0.1, 0, 0.35},
                                         Law{"quadratic", 2, quadratic, 1, 2, 1, 5, 0, 0.05},
                                         Law{"random walk", 0.5, none, 0, 0, 1, 5, 1, 0, 0.6},
                                         Law{"random walk", 0.5, none, 0, 0, 1, 5, 1, 0.1, 0.4}));

TEST(Drift, OfAFewOscillationsIsLeftUndecided) {
  const Law law{"bounded", 0, none, 0, 1, 30, 45};
  EXPECT_EQ(run(law).decided, 0);
}

TEST(Drift, WithoutEnoughOrFiniteNumbersHasNoClass) {
  BlockMeans few;
  for (int k = 0; k < 31; ++k) few.add(k, k);
  EXPECT_FALSE(growth_of(few.finish()));
  BlockMeans zero;
  for (int k = 0; k < 100; ++k) zero.add(k, 0);
  EXPECT_FALSE(growth_of(zero.finish()));
  BlockMeans broken;
  for (int k = 0; k < 100; ++k) broken.add(k, k == 50 ? std::nan("") : k);
  EXPECT_FALSE(growth_of(broken.finish()));
}

/// A drift with or without an oscillation, over blocks of other times for each n.
std::vector<BlockMean> made_up_drift(int n, bool oscillates) {
  std::mt19937 random(static_cast<unsigned>(n));
  std::normal_distribution<double> normal;
  std::vector<BlockMean> blocks;
  for (int k = 0; k < 40 + n / 2; ++k) {
    const double t = 0.1 * (k + 0.5) * (1 + 0.01 * n);
    blocks.push_back({t, 0.3 * t + 0.05 * normal(random) + (oscillates ? 2 * std::sin(3 * t) : 0)});
  }
  return blocks;
}

void expect_the_same(const DriftGrowth& a, const DriftGrowth& b) {
  EXPECT_EQ(a.secular, b.secular);
  EXPECT_EQ(a.exponent, b.exponent);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_EQ(a.slope_half_width_95, b.slope_half_width_95);
  EXPECT_EQ(a.change, b.change);
  EXPECT_EQ(a.change_limit, b.change_limit);
  EXPECT_EQ(a.rest, b.rest);
  EXPECT_EQ(a.oscillation, b.oscillation);
  EXPECT_EQ(a.misfit, b.misfit);
}

/// The times of the blocks that are kept from one series to the next change no digit.
TEST(Drift, IsTheSameAfterOtherSeries) {
  constexpr int times = 24;  // more than are kept
  std::vector<DriftGrowth> alone;
  for (int n = 0; n < times; ++n) {
    for (const bool oscillates : {false, true}) {
      std::thread([&] { alone.push_back(growth_of(made_up_drift(n, oscillates)).value()); }).join();  // nothing kept
    }
  }
  for (int pass = 0; pass < 2; ++pass) {
    std::size_t i = 0;
    for (int n = 0; n < times; ++n) {
      for (const bool oscillates : {false, true}) {
        SCOPED_TRACE(n);
        const auto blocks = made_up_drift(n, oscillates);
        const auto growth = growth_of(blocks);
        ASSERT_TRUE(growth);
        expect_the_same(*growth, alone[i++]);
        EXPECT_EQ(slope_half_width_95(blocks), growth->slope_half_width_95);
      }
    }
  }
}

/// Blocks whose times are in another unit share what is kept of their times.
TEST(Drift, IsTheSameInAnyUnitOfTime) {
  constexpr double unit = 4;  // no time is rounded
  for (const bool oscillates : {false, true}) {
    const auto blocks = made_up_drift(60, oscillates);
    auto longer = blocks;
    for (BlockMean& block : longer) block.t *= unit;
    const auto growth = growth_of(blocks), other = growth_of(longer);
    ASSERT_TRUE(growth && other);
    EXPECT_EQ(slope_half_width_95(longer), growth->slope_half_width_95 / unit);
    DriftGrowth expected = *growth;
    expected.slope_half_width_95 /= unit;
    expect_the_same(*other, expected);
  }
}

/// Fits take eight cosines at a time, and transforms 32.
TEST(Drift, IsDecidedWithAnyNumberOfBlocks) {
  for (std::size_t n = fewest_blocks; n < 140; ++n) {
    SCOPED_TRACE(n);
    std::mt19937 random(static_cast<unsigned>(n));
    std::normal_distribution<double> normal;
    std::vector<BlockMean> blocks;
    for (std::size_t k = 0; k < n; ++k) {
      const double t = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
      blocks.push_back({t, t * t + 0.001 * normal(random)});
    }
    const auto growth = growth_of(blocks);
    ASSERT_TRUE(growth);
    EXPECT_TRUE(growth->secular);
    EXPECT_NEAR(growth->exponent, 2, 0.03);
    EXPECT_GT(growth->high, growth->low);
  }
}

TEST(Drift, OfOneSizeOverTheBlocksIsTheSameInAnyUnit) {
  BlockMeans small, large;
  for (int k = 0; k < 1000; ++k) {
    const double d = k + 30 * std::sin(0.3 * k);
    small.add(k, 1e-200 * d);
    large.add(k, 1e200 * d);
  }
  const auto a = growth_of(small.finish()), b = growth_of(large.finish());
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->exponent, b->exponent, 1e-9);
  EXPECT_NEAR(a->exponent, 1, 0.01);
  EXPECT_TRUE(a->secular);
}

}  // namespace
}  // namespace polhode::study::drift_growth_test
