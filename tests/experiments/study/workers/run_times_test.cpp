// SPDX-License-Identifier: BSD-3-Clause
// Times of runs: what follows from times that are known. No measured time is compared.
#include "experiments/study/workers/run_times.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/study/plan/options.hpp"

namespace polhode::study::run_times_tests::run_times_test {
namespace {

const Experiment timed_tops = {
    .name = "tops",
    .question = "How long do runs take?",
    .defaults = {{"scenario", "peters_hsu"}, {"integrator", "rk4"}, {"dt", "0.1"}, {"tolerance", "1e-6"}}};

Plan planned(std::vector<std::string> words) {
  words.insert(words.begin(), "tops");
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  return make_plan(timed_tops, parse_options(timed_tops, int(argv.size()), argv.data()).options);
}

std::vector<const PlannedRun*> pointers_to(const std::vector<PlannedRun>& runs) {
  std::vector<const PlannedRun*> all;
  for (const PlannedRun& run : runs) all.push_back(&run);
  return all;
}

/// The time of a run is known for the first and the last of the plan.
RunTimes times_of(const Plan& plan, double first, double last, const Timing& timing = {}) {
  const std::vector<PlannedRun> runs = plan.runs();
  const std::vector<const PlannedRun*> missing = pointers_to(runs);
  const std::vector<KnownTime> known = {{missing.front(), first}, {missing.back(), last}};
  return run_times(missing, known, timing);
}

TEST(RunTimes, GrowWithTheNumberOfStepsFromAPartThatEachRunHas) {
  const Plan plan = planned({"--dt", "0.01,0.02,0.04"});  // 4 : 2 : 1 steps
  const RunTimes times = times_of(plan, 9, 3);
  ASSERT_EQ(times.seconds.size(), 3U);
  EXPECT_NEAR(times.seconds[0], 9, 1e-9);
  EXPECT_NEAR(times.seconds[1], 5, 1e-9);
  EXPECT_NEAR(times.seconds[2], 3, 1e-9);
  EXPECT_EQ(times.known, 1);
}

TEST(RunTimes, AreAPowerOfTheTolerance) {
  const Plan plan = planned({"--integrator", "cvode_adams", "--tolerance", "1e-8,1e-6,1e-4"});
  const RunTimes times = times_of(plan, 400, 4);
  EXPECT_NEAR(times.seconds[1], 40, 0.01);
}

TEST(RunTimes, OfAKindComeToWhatItsKnownRunsTookBetweenTheEndsToo) {
  const Plan plan = planned({"--dt", "0.01,0.02,0.04"});
  const std::vector<PlannedRun> runs = plan.runs();
  const std::vector<const PlannedRun*> missing = pointers_to(runs);
  const std::vector<KnownTime> known = {{missing[0], 9}, {missing[1], 13.5}, {missing[2], 3}};  // 5 by the line
  const RunTimes times = run_times(missing, known, {});
  const double off = (9 + 13.5 + 3) / (9 + 5 + 3);
  EXPECT_NEAR(times.seconds[0], 9 * off, 1e-9);
  EXPECT_NEAR(times.seconds[1], 5 * off, 1e-9);
  EXPECT_NEAR(times.seconds[2], 3 * off, 1e-9);
}

TEST(RunTimes, OfShortRunsAreRepeatedForBestTimes) {
  const Plan plan = planned({"--dt", "0.01,0.02,0.04"});
  Timing timing;
  timing.best_times = true;
  const RunTimes times = times_of(plan, 0.09, 0.024, timing);
  EXPECT_NEAR(times.seconds[0], 0.09, 1e-9);
  EXPECT_NEAR(times.seconds[1], 0.046, 1e-9);
  EXPECT_NEAR(times.seconds[2], 5 * 0.024, 1e-9);
}

TEST(RunTimes, OfAKindThatWasNotTimedFollowTheOthers) {
  const Plan plan = planned({"--integrator", "heun,rk4", "--dt", "0.01,0.02"});
  const std::vector<PlannedRun> runs = plan.runs();
  const std::vector<const PlannedRun*> missing = pointers_to(runs);
  Timing timing;
  timing.budget = 0;
  const std::vector<KnownTime> known = {{missing[0], 6}, {missing[1], 3}};
  const RunTimes times = run_times(missing, known, timing);
  EXPECT_NEAR(times.seconds[2], 6 * missing[2]->cost / missing[0]->cost, 0.01);
  EXPECT_GT(times.known, 0.2);
  EXPECT_LT(times.known, 0.5);
}

TEST(RunTimes, OfAKindThatWasNotTimedFollowThoseWithItsResponse) {
  const Plan plan = planned({"--scenario", "stack", "--integrator", "semi_implicit_euler", "--response",
                             "sequential_impulses,single_impulse", "--vary", "body.box.repeat=[1,1,2];[1,1,4]"});
  const std::vector<PlannedRun> runs = plan.runs();
  const std::vector<const PlannedRun*> missing = pointers_to(runs);
  ASSERT_EQ(missing.size(), 4U);
  const auto known_time = [](const PlannedRun& run) {
    return run.config.contact->response == "single_impulse" ? 1.0 : 50.0;
  };
  std::vector<KnownTime> known;
  for (const PlannedRun* run : missing) {
    if (run->scenario->problem.moving() == 2) known.push_back({run, known_time(*run)});
  }
  Timing timing;
  timing.budget = 0;
  const RunTimes times = run_times(missing, known, timing);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const double bodies = static_cast<double>(missing[i]->scenario->problem.moving());
    const double cost = missing[i]->cost / known.front().run->cost;
    EXPECT_NEAR(times.seconds[i] / (known_time(*missing[i]) * cost * bodies / 2), 1, 0.02) << i;
  }
}

TEST(RunTimes, ATrueMotionIsMadeOnceForTheRunsThatShareIt) {
  const Plan plan = planned({"--dt", "0.01,0.02,0.04", "--vary", "body.0.mass=1;2"});
  EXPECT_EQ(plan.most_true_motions(), 2);
  Timing timing;
  timing.budget = 1;
  const std::vector<PlannedRun> runs = plan.runs();
  const RunTimes times = run_times(pointers_to(runs), {}, timing);
  ASSERT_EQ(times.true_motions.size(), 6U);
  EXPECT_EQ(std::count_if(times.true_motions.begin(), times.true_motions.end(), [](double made) { return made > 0; }),
            2);
}

TEST(RunTimes, AChoiceStandsForAllRunsAndTheirMotionsAreMadeOnce) {
  RunTimes times;
  times.seconds = {3, 1};
  times.true_motions = {4, 4};
  EXPECT_EQ(time_of_all(times, 2, 2, 1), 12);          // all runs: as they are
  EXPECT_EQ(time_of_all(times, 2, 2, 2), 7);           // side by side
  EXPECT_EQ(time_of_all(times, 1000, 5, 1), 2020);     // 500 times four seconds, and five motions
  EXPECT_EQ(time_of_all(times, 1000, 5, 2), 1510);     // the longer run bounds each pair
  EXPECT_EQ(time_of_all(times, 1000, 1, 1), 2008);     // the choice needs two already
  EXPECT_EQ(time_of_all(times, 10, 1e6, 1), 20 + 40);  // no more motions than runs
  EXPECT_EQ(time_of_all({}, 10, 1, 1), 0);
}

TEST(RunTimes, MotionsDifferInKeysOfTheScenarioAndInTheDuration) {
  EXPECT_EQ(planned({"--dt", "0.01,0.02"}).most_true_motions(), 1);
  EXPECT_EQ(planned({"--dt", "0.01,0.02", "--t-end", "1,2,3", "--vary", "body.0.mass=1;2"}).most_true_motions(), 6);
  EXPECT_EQ(planned({"--scenario", "dzhanibekov,lagrange_top", "--integrator", "heun,rk4"}).most_true_motions(), 2);
}

TEST(RunTimes, WhatIsLeftGoesOnAsTheSecondHalfDid) {
  EXPECT_DOUBLE_EQ(time_of_whole(3, 1, 0.5), 3);
  EXPECT_DOUBLE_EQ(time_of_whole(2, 0.5, 0.25), 4);   // at a steady rate
  EXPECT_DOUBLE_EQ(time_of_whole(1, 0.5, 0.4), 3.5);  // five times slower at the end: 0.5 s for a tenth
  EXPECT_DOUBLE_EQ(time_of_whole(1, 0.5, 0), 2);      // the half is not known
  EXPECT_DOUBLE_EQ(time_of_whole(1, 0.5, 0.5), 2);    // nothing was done in the second half
}

TEST(RunTimes, OfFallingBodiesAreBetweenThoseSeenAndThoseAtRest) {
  EXPECT_DOUBLE_EQ(time_of_falling(1, 4), 2);
  EXPECT_DOUBLE_EQ(time_of_falling(4, 1), 4);  // the fall took longer than rest would
}

TEST(RunTimes, OfWorkersThatTakeOneRunAfterTheOther) {
  const std::vector<double> seconds = {5, 3, 2, 2};
  EXPECT_EQ(time_of_workers(seconds, 1), 12);
  EXPECT_EQ(time_of_workers(seconds, 2), 7);
  EXPECT_EQ(time_of_workers(seconds, 9), 5);
  EXPECT_EQ(time_of_workers({}, 3), 0);
}

}  // namespace
}  // namespace polhode::study::run_times_tests::run_times_test
