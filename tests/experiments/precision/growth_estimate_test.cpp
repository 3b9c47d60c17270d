// SPDX-License-Identifier: BSD-3-Clause
// The growth of made-up errors: random walks, sums of them, straight lines and what does not grow.
#include "experiments/precision/growth_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace polhode::study::precision::growth_estimate_test {
namespace {

constexpr int samples = 128;

/// Values at each of 128 instants and the start.
template <class Value>
std::vector<PathPoint> path(const Value& value) {
  std::vector<PathPoint> points;
  for (int k = 0; k <= samples; ++k) points.push_back({0.5 * k, value(k)});
  return points;
}

struct Walk {
  std::vector<PathPoint> energy = path([](int) { return 0.0; }), attitude = energy;
};
Walk walk(std::mt19937_64& random, double bias = 0) {
  std::normal_distribution<double> step;
  Walk w;
  for (std::size_t k = 1; k < w.energy.size(); ++k) {
    w.energy[k].value = w.energy[k - 1].value + step(random) + bias;
    w.attitude[k].value = w.attitude[k - 1].value + w.energy[k].value;
  }
  return w;
}

TEST(Growth, PowersOfTimeAreFound) {
  for (const double p : {0.5, 1.0, 1.5, 2.0}) {
    const auto exponent = path_exponent(path([&](int k) { return -3e-12 * std::pow(k, p); }));
    ASSERT_TRUE(exponent);
    EXPECT_NEAR(*exponent, p, 0.01);
  }
  EXPECT_NEAR(*path_exponent(path([](int) { return 2.0; })), 0, 1e-12);
}

TEST(Growth, TheScaleAndTheUnitOfTimeDoNotMatter) {
  std::mt19937_64 random(7);
  const auto energy = walk(random).energy;
  auto scaled = energy;
  for (PathPoint& p : scaled) p = {p.t * 1024, p.value / 4096};
  EXPECT_NEAR(*path_exponent(scaled), *path_exponent(energy), 1e-12);
}

TEST(Growth, RandomWalksGrowAsTheRootOfTime) {
  std::mt19937_64 random(1937);
  constexpr int ensembles = 60, runs = 40;
  int covered = 0;
  for (int e = 0; e < ensembles; ++e) {
    std::vector<double> energy, attitude;
    for (int i = 0; i < runs; ++i) {
      const Walk w = walk(random);
      energy.push_back(*path_exponent(w.energy));
      attitude.push_back(*path_exponent(w.attitude));
    }
    const auto of_energy = estimate_growth(energy), of_attitude = estimate_growth(attitude);
    ASSERT_TRUE(of_energy && of_attitude);
    EXPECT_EQ(of_energy->paths, std::size_t(runs));
    EXPECT_EQ(judge_energy_growth(*of_energy), Growth::random_walk) << of_energy->exponent;
    EXPECT_NEAR(of_attitude->exponent, 1.5, 0.3);
    covered += std::abs(of_energy->exponent - 0.5) <= of_energy->half_width_95;
  }
  // 57 of 60 are expected; the interval is neither too narrow nor too wide.
  EXPECT_GE(covered, 52);
  EXPECT_LT(covered, ensembles);
}

TEST(Growth, BiasMakesItLinear) {
  std::mt19937_64 random(3);
  std::vector<double> energy, attitude;
  for (int i = 0; i < 20; ++i) {
    const Walk w = walk(random, 2);
    energy.push_back(*path_exponent(w.energy));
    attitude.push_back(*path_exponent(w.attitude));
  }
  EXPECT_EQ(judge_energy_growth(*estimate_growth(energy)), Growth::linear);
  EXPECT_EQ(judge_attitude_growth(*estimate_growth(attitude)), Growth::linear);
}

TEST(Growth, WhatCannotBeToldIsNotTold) {
  EXPECT_FALSE(path_exponent({}));
  EXPECT_FALSE(path_exponent(path([](int) { return 0.0; })));
  auto short_path = path([](int k) { return double(k); });
  short_path.resize(9);
  EXPECT_FALSE(path_exponent(short_path)) << "two octaves of three points";
  EXPECT_FALSE(estimate_growth({0.5, 0.6}));
  EXPECT_EQ(judge_energy_growth({0.5, 0.3, 4}), Growth::not_told) << "a wide interval";
  EXPECT_EQ(judge_energy_growth({1.4, 0.05, 40}), Growth::not_told) << "none of them";
  EXPECT_EQ(judge_energy_growth({0.03, 0.02, 40}), Growth::bounded);
  EXPECT_EQ(judge_attitude_growth({1.0, 0.05, 40}), Growth::bounded);
  EXPECT_EQ(judge_attitude_growth({1.52, 0.1, 40}), Growth::random_walk);
}

}  // namespace
}  // namespace polhode::study::precision::growth_estimate_test
