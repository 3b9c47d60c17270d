// SPDX-License-Identifier: BSD-3-Clause
// The laws of a schedule, for every method that takes steps of a given size: sizes given one by one make the motion
// that the fixed loop makes; a run starts at the time of its state; and a run stops at once if an observer requests it.
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/laws/integrator_trials.hpp"

namespace polhode::laws::schedule_law_test {
namespace {

constexpr double h = 1.0 / 64;

class ScheduleLaw : public OverTheCatalogue {
 protected:
  void SetUp() override {
    if (adaptive()) GTEST_SKIP() << "it chooses its steps";
  }
};

INSTANTIATE_TEST_SUITE_P(Catalogue, ScheduleLaw, testing::ValuesIn(method_names()),
                         [](const auto& param_info) { return param_info.param; });

void expect_same(const Rows& a, const Rows& b) {
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t k = 0; k < a.samples.size(); ++k) {
    ASSERT_TRUE(same_bytes(a.samples[k], b.samples[k])) << k;
    ASSERT_TRUE(same_bytes(a.states[k], b.states[k])) << k;
  }
}

// Powers of two, so that no sum of them is rounded.
TEST_P(ScheduleLaw, GivenStepsAreThoseOfTheFixedLoop) {
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    for (const bool normalize : {false, true}) {
      Schedule schedule{.t_end = 1, .dt = h, .samples = {}, .normalize = normalize};
      Rows fixed, given;
      State<double> x = system->start(), y = x;
      ASSERT_EQ(simulate(*system, *system, *make(*system), x, schedule, fixed).status, RunStatus::ok);
      schedule.next_step = [] { return h; };
      ASSERT_EQ(simulate(*system, *system, *make(*system), y, schedule, given).status, RunStatus::ok);
      ASSERT_EQ(fixed.samples.size(), 65u);
      expect_same(fixed, given);
      EXPECT_TRUE(same_bytes(x, y));
    }
  });
}

TEST_P(ScheduleLaw, ARunStartsAtTheTimeOfItsState) {
  if (declared().multi_step) GTEST_SKIP() << "a second run forgets the history of the first";
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    Schedule schedule{.t_end = 1, .dt = h, .samples = {}};
    Rows whole, first, second;
    State<double> x = system->start(), y = x;
    ASSERT_EQ(simulate(*system, *system, *make(*system), x, schedule, whole).status, RunStatus::ok);
    schedule.t_end = 0.25;
    ASSERT_EQ(simulate(*system, *system, *make(*system), y, schedule, first).status, RunStatus::ok);
    schedule.t_end = 1;
    const RunOutcome outcome = simulate(*system, *system, *make(*system), y, schedule, second);
    ASSERT_EQ(outcome.status, RunStatus::ok);
    EXPECT_EQ(outcome.steps, 48);
    EXPECT_LT(difference(x.y, y.y), 1e-13) << "a method that iterates may start from another guess";
    EXPECT_EQ(y.t, 1);
    ASSERT_EQ(second.samples.size(), 49u);
    for (std::size_t k = 0; k < 49; ++k) EXPECT_EQ(second.samples[k].t, whole.samples[16 + k].t);
  });
}

// Steps end where none is given, are cut at t_end, and are as long as requested.
TEST_P(ScheduleLaw, GivenStepsAreTakenAsTheyCome) {
  const Trial trial = own_trials().front();
  const auto system = build<double>(trial, {});
  const std::vector<double> sizes = {0.01, 0.05, 0.003, 0.0};
  std::size_t next = 0;
  Schedule schedule{.t_end = 0.2, .samples = {}, .next_step = [&] { return sizes.at(next++); }};
  Rows rows;
  State<double> state = system->start();
  RunOutcome outcome = simulate(*system, *system, *make(*system), state, schedule, rows);
  EXPECT_EQ(outcome.status, RunStatus::ok);
  EXPECT_EQ(outcome.steps, 3);
  EXPECT_EQ(state.t, 0.01 + 0.05 + 0.003);
  State<double> by_hand = state;
  const auto method = make(*system);
  method->begin(by_hand);
  for (const double size : {0.07, 0.2 - (state.t + 0.07)}) ASSERT_TRUE(method->step(by_hand, size).ok());
  schedule.next_step = [] { return 0.07; };
  outcome = simulate(*system, *system, *make(*system), state, schedule, rows);
  EXPECT_EQ(outcome.steps, 2);
  EXPECT_EQ(state.t, 0.2);
  EXPECT_LT(difference(state.y, by_hand.y), 1e-14) << "the last one was cut";
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    State<double> again = system->start();
    schedule.next_step = [bad] { return bad; };
    EXPECT_THROW(simulate(*system, *system, *make(*system), again, schedule, rows), std::invalid_argument) << bad;
  }
  schedule.samples = 5;
  EXPECT_THROW(simulate(*system, *system, *make(*system), state, schedule, rows), std::invalid_argument);
}

/// Requests a stop after so many states.
struct Stopper final : Observer {
  explicit Stopper(int most_states) : most(most_states) {}
  int most, seen = 0;
  std::atomic<bool> stop{false};
  std::size_t on_samples(std::span<const Sample> samples) override { return samples.size(); }
  void on_state(const State<double>&, const Sample&) override { stop = ++seen == most; }
  double next_state() const override { return 0; }
};

TEST_P(ScheduleLaw, AnObserverStopsARunWhereItLooks) {
  const Trial trial = own_trials().front();
  const auto system = build<double>(trial, {});
  for (const bool given : {false, true}) {
    Schedule schedule{.t_end = 1, .dt = h, .samples = {}};
    if (given) schedule.next_step = [] { return h; };
    Stopper stopper(6);
    State<double> state = system->start();
    const RunOutcome outcome = simulate(*system, *system, *make(*system), state, schedule, stopper, &stopper.stop);
    EXPECT_EQ(outcome.status, RunStatus::interrupted);
    EXPECT_EQ(outcome.steps, 5);
    EXPECT_EQ(state.t, 5 * h);
  }
}

}  // namespace
}  // namespace polhode::laws::schedule_law_test
