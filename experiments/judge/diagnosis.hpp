// SPDX-License-Identifier: BSD-3-Clause
// Diagnosis of the fault of a trajectory by trial: each reading of its columns, each fault in the equations of rotation
// and each first-order step implies a motion, with which the rows are compared.
//
// Hypotheses: hypothesis.hpp; fitted parameters: clock_fit.hpp and step_fit.hpp; distance of the rows from a motion:
// miss.hpp. The decision is made here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/judge/reading.hpp"
#include "experiments/judge/trajectory_score.hpp"

namespace polhode::study::judge {

/// Smallest ratio of misses for a hypothesis to be named: it must fit this many times better than the plain reading,
/// and than every other hypothesis.
inline constexpr double naming_factor = 10;

struct Diagnosis {
  /// Name in scores.csv: "none", "unexplained", or names of causes, with "+" between two that occur together and "|"
  /// between two that the rows do not distinguish; empty if nothing could be tried.
  std::string name;
  std::string words;                ///< description of the fault, as a clause; empty for "none"
  std::string untried;              ///< reason for which no hypothesis, or not all, could be tried; may be empty
  std::string remark;               ///< hypothesis that fits but may have a cause other than a fault; may be empty
  double miss = 0;                  ///< miss of the plain reading (miss.hpp), rad
  double span = 0;                  ///< rotation over the spans on which the miss was measured, rad
  std::optional<double> factor;     ///< miss of the plain reading over that of the named hypothesis
  std::optional<double> margin;     ///< least miss of the hypotheses with another cause over that of the named one
  std::optional<Trajectory> meant;  ///< corrected trajectory, if the fault is a reading of its columns
};

/// Diagnoses a trajectory. plain: its score without correction.
Diagnosis diagnose(const Trajectory& trajectory, const Scenario& scenario, const TrajectoryScore& plain);

}  // namespace polhode::study::judge
