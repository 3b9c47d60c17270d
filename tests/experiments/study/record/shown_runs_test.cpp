// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/shown_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace polhode::study::shown_runs_test {
namespace {

/// `motions` motions with `steps` steps each, in the order of a study: the step changes last.
std::vector<std::uint64_t> runs_of_motions(std::uint64_t motions, int steps) {
  std::vector<std::uint64_t> runs;
  for (int step = 0; step < steps; ++step) {
    for (std::uint64_t motion = 0; motion < motions; ++motion) runs.push_back(motion);
  }
  return runs;
}

TEST(ShownRuns, AreAllOfASmallStudy) {
  EXPECT_EQ(shown_runs(runs_of_motions(2, 2), 4), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(shown_runs(runs_of_motions(2, 2), 9), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_TRUE(shown_runs(runs_of_motions(2, 2), 0).empty());
}

TEST(ShownRuns, AreAllRunsOfEvenlyChosenMotions) {
  const auto runs = runs_of_motions(100, 7);
  const auto shown = shown_runs(runs, 30);
  std::map<std::uint64_t, int> found;
  for (const std::size_t i : shown) ++found[runs[i]];
  EXPECT_EQ(found, (std::map<std::uint64_t, int>{{0, 7}, {33, 7}, {66, 7}, {99, 7}}));
  EXPECT_TRUE(std::is_sorted(shown.begin(), shown.end()));
}

TEST(ShownRuns, AreNotMoreThanAskedForWhereMotionsDiffer) {
  std::vector<std::uint64_t> runs = runs_of_motions(4, 1);  // one motion of these has five more runs
  for (int i = 0; i < 5; ++i) runs.push_back(runs[3]);
  EXPECT_EQ(shown_runs(runs, 6), (std::vector<std::size_t>{0}));
  EXPECT_EQ(shown_runs(runs, 8), (std::vector<std::size_t>{0}));
}

TEST(ShownRuns, AreThinnedWhereOneMotionHasTooMany) {
  EXPECT_EQ(shown_runs(runs_of_motions(1, 100), 4), (std::vector<std::size_t>{0, 33, 66, 99}));
  EXPECT_EQ(shown_runs(runs_of_motions(1, 100), 1), (std::vector<std::size_t>{0}));
  EXPECT_EQ(shown_runs(runs_of_motions(3, 100), 5).size(), 5u);
}

TEST(ShownRuns, AreOfMotionsCountedByTheirFirstRuns) {
  // Motions with large numbers come first; each has runs far apart.
  const std::vector<std::uint64_t> runs = {90, 20, 90, 70, 20, 10, 70, 10, 50, 50};
  EXPECT_EQ(shown_runs(runs, 4), (std::vector<std::size_t>{0, 2, 8, 9}));        // the first motion and the last one
  EXPECT_EQ(shown_runs(runs, 6), (std::vector<std::size_t>{0, 2, 3, 6, 8, 9}));  // and the third
}

}  // namespace
}  // namespace polhode::study::shown_runs_test
