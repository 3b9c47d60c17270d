// SPDX-License-Identifier: BSD-3-Clause
// Drifts whose law is known: the class is right in 95 % of seeds, the intervals hold the truth about as often, and real
// runs show what their methods are known for.
#include "experiments/study/drift_growth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <random>

#include "experiments/study/run.hpp"

namespace polhode::study {
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
  double slope;                   ///< of the least-squares line, per t_end
  double amplitude = 0;           ///< of the oscillation, with a second harmonic
  double shortest = 1, longest = 5;  ///< period, s
  double walk = 0;                ///< standard deviation at the end
  double noise = 0;
};

struct Counts {
  int right = 0, exponent_covered = 0, slope_covered = 0;
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
  const auto growth = growth_of(blocks.finish(), largest);
  ASSERT_TRUE(growth);
  EXPECT_LE(growth->low, growth->exponent);
  EXPECT_LE(growth->exponent, growth->high);
  counts.right += growth_class(growth->exponent, growth->secular) == law.expected;
  counts.exponent_covered += growth->low <= law.exponent && law.exponent <= growth->high;
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
  const Counts counts = run(GetParam());
  EXPECT_GE(counts.right, 0.95 * seeds);
  // 95 % of 200 is 190; a binomial number is below 180 once in a thousand times.
  EXPECT_GE(counts.exponent_covered, 180);
  EXPECT_GE(counts.slope_covered, 180);
  EXPECT_LE(counts.width, 0.3);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, Drifts,
    testing::Values(Law{"bounded", 0, none, 0, 1}, Law{"bounded", 0, none, 0, 1, 0.3, 0.7},
                    Law{"bounded", 0, none, 0, 1, 1, 5, 0, 0.3}, Law{"bounded", 0, none, 0, 0, 1, 5, 0, 1},
                    Law{"linear", 1, linear, 1, 1, 1, 5, 0, 0.05}, Law{"linear", 1, linear, 1, 5, 1, 2, 0, 0.05},
                    Law{"linear", 1, linear, 1, 0, 1, 5, 0.1}, Law{"quadratic", 2, quadratic, 1, 2, 1, 5, 0, 0.05},
                    Law{"random walk", 0.5, none, 0, 0, 1, 5, 1}, Law{"random walk", 0.5, none, 0, 0, 1, 5, 1, 0.1}));

TEST(Drift, OfAFewOscillationsSaysThatLongerTimesAreUnknown) {
  const Law law{"bounded", 0, none, 0, 1, 25, 45};
  const Counts counts = run(law);
  EXPECT_GE(counts.right, 0.95 * seeds);
  EXPECT_GE(counts.width, 0.45);
}

TEST(Drift, WithoutEnoughOrFiniteNumbersHasNoClass) {
  BlockMeans few;
  for (int k = 0; k < 31; ++k) few.add(k, k);
  EXPECT_FALSE(growth_of(few.finish(), 30));
  BlockMeans zero;
  for (int k = 0; k < 100; ++k) zero.add(k, 0);
  EXPECT_FALSE(growth_of(zero.finish(), 0));
  BlockMeans broken;
  for (int k = 0; k < 100; ++k) broken.add(k, k == 50 ? std::nan("") : k);
  EXPECT_FALSE(growth_of(broken.finish(), 99));
}

TEST(Drift, OfOneSizeOverTheBlocksIsTheSameInAnyUnit) {
  BlockMeans small, large;
  for (int k = 0; k < 1000; ++k) {
    const double d = k + 30 * std::sin(0.3 * k);
    small.add(k, 1e-200 * d);
    large.add(k, 1e200 * d);
  }
  const auto a = growth_of(small.finish(), 1e-197), b = growth_of(large.finish(), 1e203);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->exponent, b->exponent, 1e-9);
  EXPECT_EQ(growth_class(a->exponent, a->secular), "linear");
}

RunResult result_of(const std::string& method, double dt, double t_end_s, AngularState state) {
  static const Scenario scenario = ScenarioSource::open("hairer_vilmart").resolve();
  RunConfig config;
  config.scenario = scenario.name;
  config.integrator = method;
  config.formulation.angular_state = state;
  config.dt = dt;
  config.t_end = t_end_s;
  return carry_out(config, scenario, {}, nullptr);
}

TEST(Drift, OfRk4OnTheFreeTopIsSecularUnderItsOscillation) {
  // REFERENCE_RESULTS, section 2: J/s at h = 0.1, 0.05, 0.025.
  const struct { double h, rate; } published[] = {{0.1, -6.06e-8}, {0.05, -1.90e-9}, {0.025, -5.96e-11}};
  for (const auto& [h, rate] : published) {
    const RunResult r = result_of("rk4", h, 400, AngularState::velocity_body);
    EXPECT_NEAR(*r.energy_drift_rate, rate, 0.03 * std::abs(rate));
    EXPECT_LE(*r.energy_drift_rate_ci, 0.03 * std::abs(rate));
    EXPECT_EQ(r.drift_class, "linear");
    EXPECT_NEAR(*r.drift_exponent, 1, 0.02);
  }
  const RunResult world = result_of("rk4", 0.1, 400, AngularState::velocity_world);
  EXPECT_NEAR(*world.energy_drift_rate, 1.68e-6, 0.03 * 1.68e-6);
  EXPECT_EQ(world.drift_class, "linear");
}

TEST(Drift, OfOtherMethodsIsWhatTheyAreKnownFor) {
  EXPECT_EQ(result_of("dmv", 0.05, 400, AngularState::velocity_body).drift_class, "round-off");
  EXPECT_EQ(result_of("lie_midpoint", 0.05, 400, AngularState::velocity_body).drift_class, "bounded");
  const RunResult rotor = result_of("exact_rotor", 0.01, 2000, AngularState::velocity_body);
  EXPECT_LT(*rotor.drift_exponent_low, 1);
  const RunResult euler = result_of("explicit_euler", 1e-3, 10, AngularState::velocity_body);
  EXPECT_EQ(euler.drift_class, "linear");  // growth of E at a rate ∝ h, not yet felt by itself
  EXPECT_GT(*euler.energy_drift_rate, 10 * *euler.energy_drift_rate_ci);
}

}  // namespace
}  // namespace polhode::study
