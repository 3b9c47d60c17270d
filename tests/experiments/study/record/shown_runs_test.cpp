// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/shown_runs.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace polhode::study {
namespace {

/// Runs of `motions` values of a varied key with `steps` steps each, in the order of a study: the step changes last.
std::vector<RunConfig> runs_of_motions(int motions, int steps) {
  std::vector<RunConfig> runs;
  for (int step = 0; step < steps; ++step) {
    for (int motion = 0; motion < motions; ++motion) {
      RunConfig run;
      run.scenario = "top";
      run.varied = {{"body.0.mass", std::to_string(motion), ""}};
      run.dt = 1.0 / (step + 1);
      runs.push_back(run);
    }
  }
  return runs;
}

std::vector<std::size_t> shown_of(const std::vector<RunConfig>& runs, std::size_t most) {
  std::vector<const RunConfig*> all;
  for (const RunConfig& run : runs) all.push_back(&run);
  return shown_runs(all, most);
}

TEST(ShownRuns, AreAllOfASmallStudy) {
  EXPECT_EQ(shown_of(runs_of_motions(2, 2), 4), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(shown_of(runs_of_motions(2, 2), 9), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_TRUE(shown_of(runs_of_motions(2, 2), 0).empty());
}

TEST(ShownRuns, AreAllRunsOfEvenlyChosenMotions) {
  const auto runs = runs_of_motions(100, 7);
  const auto shown = shown_of(runs, 30);
  std::map<std::string, int> found;
  for (const std::size_t i : shown) ++found[runs[i].varied[0].value];
  EXPECT_EQ(found, (std::map<std::string, int>{{"0", 7}, {"33", 7}, {"66", 7}, {"99", 7}}));
  EXPECT_TRUE(std::is_sorted(shown.begin(), shown.end()));
}

TEST(ShownRuns, OfTwoScenariosAreTwoMotions) {
  std::vector<RunConfig> runs(6);
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].scenario = i < 3 ? "top" : "box";
  EXPECT_EQ(shown_of(runs, 3), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(ShownRuns, AreNotMoreThanAskedForWhereMotionsDiffer) {
  std::vector<RunConfig> runs = runs_of_motions(4, 1);  // one motion of these has five more runs
  for (int i = 0; i < 5; ++i) runs.push_back(runs[3]);
  EXPECT_EQ(shown_of(runs, 6), (std::vector<std::size_t>{0}));
  EXPECT_EQ(shown_of(runs, 8), (std::vector<std::size_t>{0}));
}

TEST(ShownRuns, AreThinnedWhereOneMotionHasTooMany) {
  EXPECT_EQ(shown_of(runs_of_motions(1, 100), 4), (std::vector<std::size_t>{0, 33, 66, 99}));
  EXPECT_EQ(shown_of(runs_of_motions(1, 100), 1), (std::vector<std::size_t>{0}));
  EXPECT_EQ(shown_of(runs_of_motions(3, 100), 5).size(), 5u);
}

}  // namespace
}  // namespace polhode::study
