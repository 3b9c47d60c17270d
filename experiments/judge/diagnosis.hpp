// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a trajectory, found by trying: each reading of its columns, each fault in the equations of
// rotation and each first-order step implies a motion, and the rows either follow that motion or do not.
//
// hypothesis.hpp has what is tried, clock_fit.hpp and step_fit.hpp what is fitted, miss.hpp how far rows are from a
// motion; the decision is here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/judge/reading.hpp"
#include "experiments/judge/trajectory_score.hpp"

namespace polhode::study::judge {

/// How many times better a reading must fit than the plain one, and than every other one, to be named.
inline constexpr double naming_factor = 10;

struct Diagnosis {
  /// Of scores.csv: "none", "unexplained", names of causes with "+" between two at once and "|" between two that the
  /// rows do not tell apart; empty where nothing could be tried.
  std::string name;
  std::string words;                ///< what is wrong, as a clause; empty for "none"
  std::string untried;              ///< why nothing, or not all, could be tried; may be empty
  std::string remark;               ///< what fits but may have another cause than a fault; may be empty
  double miss = 0;                  ///< rad, of the plain reading, see miss.hpp
  double span = 0;                  ///< rad, of the spans over which it was taken
  std::optional<double> factor;     ///< how much better the named reading fits than the plain one
  std::optional<double> margin;     ///< and than the best one of another cause
  std::optional<Trajectory> meant;  ///< the trajectory as it was meant, where a reading of its columns is named
};

/// `plain`: the score of the trajectory as it stands.
Diagnosis diagnose(const Trajectory& trajectory, const Scenario& scenario, const TrajectoryScore& plain);

}  // namespace polhode::study
