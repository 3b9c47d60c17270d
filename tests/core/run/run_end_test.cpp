// SPDX-License-Identifier: BSD-3-Clause
// Ends of runs that do not come to their end: by an exception in a step, by too many steps, by a request to stop.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <new>
#include <stdexcept>

#include "core/run/simulate.hpp"

namespace polhode::run_end_test {
namespace {

/// Moves nothing. It calls `in_step`, which the test sets, in each step; its steps are 1 ms at most.
class Scripted final : public Integrator<double> {
 public:
  std::function<void(State<double>&, int)> in_step = [](State<double>&, int) {};
  void begin(const State<double>&) override {}
  StepResult step(State<double>& state, double h) override {
    in_step(state, ++steps);
    state.t += std::min(h, 1e-3);
    return {};
  }
  std::int64_t evaluations() const override { return steps; }
  int steps = 0;
};

struct Blind final : Observer {
  std::size_t on_samples(std::span<const Sample> samples) override { return samples.size(); }
};

struct RunEnd : testing::Test {
  Scripted method;
  Schedule schedule{.t_end = 100, .adaptive = true, .samples = {}};
  std::atomic<bool> stop{false};

  RunOutcome run() {
    Problem problem;
    problem.bodies.emplace_back();
    problem.starts.emplace_back();
    const auto system = make_system<double>(problem, {});
    State<double> state = system->start();
    Blind blind;
    return simulate(*system, *system, method, state, schedule, blind, &stop);
  }
};

TEST_F(RunEnd, WhatIsThrownInAStepIsItsFailure) {
  for (const bool adaptive : {true, false}) {
    method.steps = 0;
    method.steps = 0;
    schedule.adaptive = adaptive;
    method.in_step = [](State<double>&, int step) {
      if (step == 3) throw std::invalid_argument("a box has no size");
    };
    const RunOutcome outcome = run();
    EXPECT_EQ(outcome.status, RunStatus::failed);
    EXPECT_EQ(outcome.message, "a box has no size at t = 0.002 s");
    EXPECT_EQ(outcome.steps, 2);
    EXPECT_EQ(outcome.t, 0.002);
  }
}

TEST_F(RunEnd, ARunWhoseStateIsLostHasDivergedWhateverIsThrown) {
  method.in_step = [](State<double>& state, int step) {
    if (step < 3) return;
    state.y[0] = std::numeric_limits<double>::quiet_NaN();
    throw std::invalid_argument("a pose is not finite");
  };
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.status, RunStatus::diverged);
  EXPECT_EQ(outcome.message, "the state ceased to be finite at t = 0.002 s");
}

TEST_F(RunEnd, WantOfMemoryIsNoFaultOfTheMethod) {
  method.in_step = [](State<double>&, int) { throw std::bad_alloc(); };
  EXPECT_THROW(run(), std::bad_alloc);
}

TEST_F(RunEnd, AnAdaptiveMethodHasALimitOfSteps) {
  schedule.most_steps = 1000;
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.status, RunStatus::failed);
  EXPECT_EQ(outcome.steps, 1000);
  for (const char* word : {"1000 steps", "--max-steps", "--tolerance", "t = 1 s"}) {
    EXPECT_NE(outcome.message.find(word), std::string::npos) << outcome.message;
  }
}

TEST_F(RunEnd, TheLimitIsNotReachedWhereTheLastStepEndsTheRun) {
  schedule.t_end = 0.1;
  schedule.most_steps = 1 + 100;  // 100 steps of 1 ms, and what rounding leaves
  EXPECT_EQ(run().status, RunStatus::ok);
}

// Steps may be slow: of a pile of a thousand bodies they take a second each.
TEST_F(RunEnd, ARequestToStopIsSeenAfterEachStep) {
  for (const bool adaptive : {true, false}) {
    method.steps = 0;
    method.steps = 0;
    stop = false;
    schedule.adaptive = adaptive;
    method.in_step = [this](State<double>&, int step) { stop = step == 5; };
    const RunOutcome outcome = run();
    EXPECT_EQ(outcome.status, RunStatus::interrupted);
    EXPECT_EQ(outcome.steps, 5);
  }
}

}  // namespace
}  // namespace polhode::run_end_test
