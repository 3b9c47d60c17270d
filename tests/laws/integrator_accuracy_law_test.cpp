// SPDX-License-Identifier: BSD-3-Clause
// The accuracy of an integrator: its order, its tolerance, its scalars.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/laws/integrator_law.hpp"
#include "tests/laws/reference_flow.hpp"

namespace polhode::laws {

/// The same 60 steps in S, or those to a tolerance, differ from those in long double by the round-off of S, and not by
/// less.
template <class S>
void IntegratorLaw::expect_precision(double round_off) const {
  if (!entry().maker<S>() || !entry().make_long_double) return;
  double most = 0, tolerance = 1e-8;
  if (adaptive()) {
    // Steps that a method chooses differ too, each by about its tolerance.
    tolerance = 100 * double(std::numeric_limits<S>::epsilon());
    round_off = std::max(round_off, 1000 * tolerance);
  }
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<S>(trial, f);
    const auto exact = build<long double>(trial, f);
    State<S> state = system->start();
    State<long double> truth{0, state.y.template cast<long double>()};
    const auto a = make<S>(*system, tolerance);
    const auto b = make<long double>(*exact, tolerance);
    a->begin(state);
    b->begin(truth);
    go(*a, state, 1, 60, adaptive());
    go(*b, truth, 1, 60, adaptive());
    const double error = difference(state.y, truth.y);
    EXPECT_LT(error, round_off);
    most = std::max(most, error);
  });
  EXPECT_GT(most, adaptive() ? double(std::numeric_limits<S>::epsilon()) / 10 : round_off / 1e4);
}

namespace integrator_accuracy_law_test {
namespace {

using Real = long double;
using Flat = VectorX<Real>;

// The declared order of a fixed-step method, from both sides: halving h divides the error by 2^p; free bodies may have
// an order of their own, or be exact.
TEST_P(IntegratorLaw, HasTheDeclaredOrder) {
  if (adaptive()) GTEST_SKIP() << "it takes a tolerance, not a step";
  const double floor = 4e-12;  // above the round-off of a run in double; multi-step methods reach their order late
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto exact = build<Real>(trial, f);
    const Flat end = reference_flow(*exact, system->start().y.cast<Real>(), 0, 1);
    const bool free = trial.problem.forces.empty() && !trial.shaken && declared().free_order > 0;
    const int expected = free ? declared().free_order : declared().order;
    if (expected == Declaration::exact_order) {
      for (const std::int64_t n : {1, 15, 240}) EXPECT_LT(difference(run(*system, 0, n).y, end), 2e-13) << n;
      return;
    }
    // Long double has room for the order to show where few steps already come near the round-off of double.
    std::int64_t first = 15;
    double coarse = difference(run(*system, 0, first).y, end);
    const bool extended = entry().make_long_double && (expected > 4 || coarse < 1000 * floor);
    for (; !extended && coarse < 1000 * floor && first > 3; coarse = difference(run(*system, 0, first).y, end))
      first /= 2;
    double order = 0, error = 1;
    const std::int64_t most = declared().solves_joints() ? 960 : 3840;  // their steps are long under sanitizers
    for (std::int64_t n = first; n <= most; n *= 2) {
      const double next = extended ? difference(run(*exact, 0, n).y, end) : difference(run(*system, 0, n).y, end);
      if (next < (extended ? 1e-15 : floor)) break;
      order = std::log2(error / next);
      error = next;
    }
    const bool impulses = declared().joints == JointEquations::impulses;  // their order is 1, and no step is very small
    EXPECT_LT(error, impulses ? 0.1 : 0.01) << "it does not come near the exact motion";
    EXPECT_NEAR(order, expected, 0.25) << "error " << error;
  });
}

// An adaptive method comes nearer as its tolerance falls, and stays within a factor of it.
TEST_P(IntegratorLaw, FollowsItsTolerance) {
  if (!adaptive()) GTEST_SKIP() << "it takes a step, not a tolerance";
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto exact = build<Real>(trial, f);
    const Flat end = reference_flow(*exact, system->start().y.cast<Real>(), 0, 1);
    // The slope of log error against log tolerance, by least squares.
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int k = 5; k <= 11; ++k) {  // at 1e-4 a method of order 8 takes four steps
      const double tolerance = std::pow(10, -k);
      const double error = difference(run(*system, tolerance).y, end);
      EXPECT_LT(error, error_limit(tolerance));
      const double x = -k, y = std::log10(error);
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    EXPECT_NEAR(slope, 1, 0.4) << "slope of log error against log tolerance";
  });
}

TEST_P(IntegratorLaw, ScalarsWorkToTheirPrecision) {
  expect_precision<float>(2e-5);
  expect_precision<double>(4e-14);
  if (!entry().make_long_double || declared().order < 4 || adaptive()) return;
  // Long double shows the order where double has long drowned in its round-off.
  const Trial trial = trials()[3];
  const auto system = build<Real>(trial, {});
  const Flat end = reference_flow(*system, system->start().y, 0, 1);
  double error = 1, order = 0;
  for (std::int64_t n = 64; n <= 16384 && error > 1e-14; n *= 2) {
    const double next = difference(run(*system, 0, n).y, end);
    order = std::log2(error / next);
    error = next;
  }
  EXPECT_LT(error, 1e-14);
  EXPECT_NEAR(order, declared().order, 0.25) << error;
}

// The judge of this file: twice as many steps do not change it.
TEST(ReferenceFlow, HasConverged) {
  std::vector<Trial> all = trials();
  for (Trial& trial : jointed_trials()) all.push_back(std::move(trial));
  for (const Trial& trial : all) {
    for (const Formulation& f : gyroscopic_formulations()) {
      const auto system = build<Real>(trial, f);
      const Flat y = system->start().y;
      EXPECT_LT(difference(reference_flow(*system, y, 0, 1), reference_flow(*system, y, 0, 1, 128)), 5e-17)
          << trial.name << ", " << label(f);
    }
  }
}

}  // namespace
}  // namespace integrator_accuracy_law_test
}  // namespace polhode::laws
