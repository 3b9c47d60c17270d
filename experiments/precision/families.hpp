// SPDX-License-Identifier: BSD-3-Clause
// The runs of a study sorted for the question of rounding: a problem is a motion, a formulation and a method; a family
// is the problem in one arithmetic, its runs down a ladder of steps from one or many starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/statistics/order_estimate.hpp"

namespace polhode::study::precision {

/// All runs of a family at one step, or tolerance, each with its counterpart in the most precise family.
struct Rung {
  double step = 0;
  struct Run {
    const RunRecord* run;
    const RunRecord* exact;  ///< the same start and step in the most precise arithmetic; null: this is it
  };
  std::vector<Run> runs;
};

struct Family {
  Precision precision = Precision::dual;
  bool compensated = false;
  std::vector<Rung> rungs;  ///< largest step first

  const RunConfig& config() const { return rungs.front().runs.front().run->config; }
  bool adaptive() const { return config().tolerance.has_value(); }
  std::string arithmetic() const;  ///< "float, compensated"
};

struct RoundingProblem {
  std::string method;
  std::string motion, formulation;  ///< what tells it from others of the study; empty where nothing does
  std::vector<Family> families;     ///< by precision, plain before compensated
  std::string label() const;        ///< "rk4, matrix, on detest_b5"
};

/// The problems of a study, in the order of its runs. They point to the records of the study.
std::vector<RoundingProblem> problems_of(const StudyView& study);

/// Root mean square of the error over the starts; NaN if one of the runs was not completed, absent if the quantity was
/// not measured in all of them.
std::optional<double> error_of(const Rung& rung, const Quantity& quantity);
/// The same for the most precise runs: the truncation error. Absent if there is no higher precision.
std::optional<double> truncation_of(const Rung& rung, const Quantity& quantity);

/// What a ladder shows. Rounding is seen where a run is off by more than one in higher precision.
struct Split {
  OrderEstimate truncation;              ///< order, and the steps at which truncation alone shows
  std::optional<double> takes_over;      ///< the largest step from which on rounding is more than truncation
  std::optional<double> rounding_power;  ///< p in rounding ∝ step^p over the steps at which it dominates
  double least_error = 0, at_step = 0;
  bool has_yardstick = false;  ///< there are runs in a higher precision
};
/// The errors of a family. Absent if the quantity is not measured.
std::optional<Split> split(const Family& family, const Quantity& quantity);

/// True where this run's energy drift is rounding: ten times that of its counterpart, and of what double can measure.
bool is_rounding(const Rung::Run& run);
/// True where besides its attitude error is ten times that of its counterpart.
bool is_rounding_in_attitude(const Rung::Run& run);

}  // namespace polhode::study::precision
