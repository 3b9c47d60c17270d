// SPDX-License-Identifier: BSD-3-Clause
// Runs of a study, grouped for the comparison of arithmetics. A problem is a motion, a formulation and a method. A
// family is a problem in one arithmetic: its runs down a ladder of steps, from one or several starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/precision/growth_estimate.hpp"
#include "experiments/study/curves/curves.hpp"
#include "experiments/study/statistics/order_estimate.hpp"

namespace polhode::study::precision {

/// All runs of a family at one step (s) or tolerance, each with its counterpart in the most precise family.
struct Rung {
  double step = 0;
  struct Run {
    const RunRecord* run;
    const RunRecord* exact;  ///< run of the same start and step in the most precise arithmetic; null: none
  };
  std::vector<Run> runs;
};

struct Family {
  Precision precision = Precision::double_precision;
  bool compensated = false;
  std::vector<Rung> rungs;  ///< largest step first

  const RunConfig& config() const { return rungs.front().runs.front().run->config; }
  bool adaptive() const { return config().tolerance.has_value(); }
  std::string arithmetic() const;  ///< name of the arithmetic: "float, compensated"
};

struct RoundingProblem {
  std::string method;
  std::string motion, formulation;  ///< options that differ from other problems of the study; empty if none does
  std::vector<Family> families;     ///< families in ascending order of precision, plain before compensated
  std::string label() const;        ///< method, formulation and motion: "rk4 (matrix) on detest_b5"
};

/// The problems of a study, in the order of its runs. They point to the records of the study.
std::vector<RoundingProblem> problems_of(const StudyView& study);

/// Root mean square of the error over the starts; NaN if one of the runs was not completed, absent if the quantity was
/// not measured in all of them.
std::optional<double> error_of(const Rung& rung, const Quantity& quantity);
/// The same for the most precise runs: the truncation error. Absent if there is no higher precision.
std::optional<double> truncation_of(const Rung& rung, const Quantity& quantity);

/// Rounding and truncation errors of a ladder. Rounding is detected if the error of a run exceeds that of its
/// counterpart in higher precision.
struct Split {
  OrderEstimate truncation;              ///< order, from the steps at which the error is truncation alone
  std::optional<double> takes_over;      ///< largest step below which rounding always exceeds truncation
  std::optional<double> rounding_power;  ///< p in rounding ∝ step^p, over the steps at which rounding dominates
  double least_error = 0, at_step = 0;   ///< least error of the ladder, and its step
  bool has_yardstick = false;            ///< there are runs in a higher precision
};
/// The errors of a family. Absent if the quantity is not measured.
std::optional<Split> split(const Family& family, const Quantity& quantity);

/// The relative energy drift of a run against time.
std::vector<PathPoint> energy_path(const RunRecord& run);
/// The attitude error (rad) of a run against time.
std::vector<PathPoint> attitude_path(const RunRecord& run);

/// True if the energy drift of this run is due to rounding: more than ten times that of its counterpart, and more than
/// ten times the error of its measurement in double.
bool is_rounding(const Rung::Run& run);
/// True if, in addition, its attitude error is more than ten times that of its counterpart.
bool is_rounding_in_attitude(const Rung::Run& run);

}  // namespace polhode::study::precision
