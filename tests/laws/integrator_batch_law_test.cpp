// SPDX-License-Identifier: BSD-3-Clause
// Several steps in one call of an integrator: the same bytes as single steps, and the same samples for the driver.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "tests/laws/integrator_law.hpp"

namespace polhode::laws {

template <class S>
void IntegratorLaw::expect_advance_is_single_steps() const {
  if (!entry().maker<S>()) return;
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<S>(trial, f);
    for (const double t0 : {0.0, 0.3}) {
      const double h = 0.007;
      State<S> at_once = system->start();
      at_once.t = t0;
      State<S> one_by_one = at_once;
      const auto a = make<S>(*system), b = make<S>(*system);
      a->begin(at_once);
      b->begin(one_by_one);
      ASSERT_TRUE(a->advance(at_once, h, 25).ok());
      for (int k = 1; k <= 25; ++k) {
        ASSERT_TRUE(b->step(one_by_one, h).ok());
        one_by_one.t = t0 + k * h;  // the time of the driver
      }
      EXPECT_TRUE(same_bytes(at_once, one_by_one));
      EXPECT_EQ(a->evaluations(), b->evaluations());
    }
  });
}

namespace integrator_batch_law_test {
namespace {

TEST_P(IntegratorLaw, AdvanceIsSingleStepsToTheBit) {
  if (adaptive()) GTEST_SKIP() << "it chooses its steps";
  expect_advance_is_single_steps<float>();
  expect_advance_is_single_steps<double>();
  expect_advance_is_single_steps<long double>();
}

// A method that projects and measures within a batch does it as the driver would, step by step.
TEST_P(IntegratorLaw, BatchesAreSingleStepsToTheBit) {
  if (adaptive()) GTEST_SKIP() << "it chooses its steps";
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto whole = make(*system), single = make(*system);
    if (!whole->takes_batches()) return;
    for (const bool project : {false, true}) {
      const StepBatch batch{.h = 0.007, .count = 20, .t0 = 0.25, .first = 3, .project = project};
      State<double> x = system->start();
      x.t = batch.time(0);
      State<double> y = x;
      whole->begin(x);
      single->begin(y);
      std::vector<Sample> samples(20);
      StepBatch seen = batch;
      seen.samples = samples.data();
      ASSERT_TRUE(whole->advance(x, seen).ok());
      for (int k = 1; k <= 20; ++k) {
        ASSERT_TRUE(single->step(y, batch.h).ok());
        y.t = 0.25 + (3 + k) * 0.007;
        double injected = 0;
        if (project) {
          const double before = system->measure(y.y).energy();
          system->project(y.y);
          single->discard_history(y);
          if (system->projection_changes_energy()) injected = system->measure(y.y).energy() - before;
        }
        EXPECT_TRUE(same_bytes(samples[std::size_t(k - 1)],
                               Sample{y.t, system->measure(y.y), y.y[system->layout().work()], injected}));
      }
      EXPECT_TRUE(same_bytes(x, y));
      EXPECT_EQ(whole->evaluations(), single->evaluations());
      State<double> unseen = system->start();
      unseen.t = batch.time(0);
      whole->begin(unseen);
      ASSERT_TRUE(whole->advance(unseen, batch).ok());
      EXPECT_TRUE(same_bytes(unseen, y)) << "whether anybody looks or not";
    }
  });
}

/// A method that hides that it takes stretches: the driver projects and measures for it.
class Stepwise final : public Integrator<double> {
 public:
  explicit Stepwise(IntegratorPointer<double> inner) : inner_(std::move(inner)) {}
  void begin(const State<double>& state) override { inner_->begin(state); }
  StepResult step(State<double>& state, double h) override { return inner_->step(state, h); }
  std::int64_t evaluations() const override { return inner_->evaluations(); }
  void discard_history(const State<double>& state) override { inner_->discard_history(state); }

 private:
  IntegratorPointer<double> inner_;
};

// A run shows the same digits whether the method takes its steps by stretches or one by one.
TEST_P(IntegratorLaw, TheDriverSeesTheSameWithAndWithoutBatches) {
  if (adaptive()) GTEST_SKIP() << "it chooses its steps";
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    for (const bool normalize : {false, true}) {
      for (const bool all_states : {false, true}) {
        // A whole batch, a part of one, and a shorter step.
        const Schedule schedule{.t_end = 0.5, .dt = 0.0073, .samples = {}, .normalize = normalize};
        const auto run = [&](Integrator<double>& integrator, Rows& rows, State<double>& state) {
          rows.all_states = all_states;
          return simulate(*system, *system, integrator, state, schedule, rows);
        };
        const auto whole = make(*system);
        Stepwise single(make(*system));
        Rows a, b;
        State<double> x = system->start(), y = x;
        const RunOutcome first = run(*whole, a, x), second = run(single, b, y);
        EXPECT_TRUE(first.status == RunStatus::ok && second.status == RunStatus::ok) << first.message << second.message;
        EXPECT_EQ(first.steps, second.steps);
        EXPECT_EQ(first.evaluations, second.evaluations);
        EXPECT_EQ(x.t, 0.5);
        EXPECT_TRUE(same_bytes(x, y));
        if (!normalize) {
          State<double> by_hand = system->start();
          const auto integrator = make(*system);
          integrator->begin(by_hand);
          ASSERT_TRUE(integrator->advance(by_hand, 0.0073, 68).ok());
          ASSERT_TRUE(integrator->step(by_hand, 0.5 - 68 * 0.0073).ok());
          EXPECT_EQ(x.y, by_hand.y);
        }
        ASSERT_EQ(a.samples.size(), b.samples.size());
        ASSERT_EQ(a.samples.size(), 70u);
        for (std::size_t k = 0; k < a.samples.size(); ++k) EXPECT_TRUE(same_bytes(a.samples[k], b.samples[k])) << k;
        ASSERT_EQ(a.states.size(), all_states ? 70u : 1u);
        for (std::size_t k = 0; k < a.states.size(); ++k) EXPECT_TRUE(same_bytes(a.states[k], b.states[k])) << k;
      }
    }
  });
}

}  // namespace
}  // namespace integrator_batch_law_test
}  // namespace polhode::laws
