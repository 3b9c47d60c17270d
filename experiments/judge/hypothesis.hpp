// SPDX-License-Identifier: BSD-3-Clause
// Hypotheses about the fault of a trajectory: each changes the reading of the columns, the start, the equations, the
// inertia, the clock or the steps, and thereby implies a different motion.
#pragma once

#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "experiments/judge/faulty_motion.hpp"
#include "experiments/judge/reading.hpp"

namespace polhode::study::judge {

/// Part that a hypothesis changes. Two hypotheses that change the same part cannot be combined.
enum class Part { attitude_columns, rate_frame, rate_unit, start, gyroscopic_term, turning, inertia, clock, steps };

/// Steps of a first-order method between consecutive rows.
struct RowSteps {
  FirstOrderStep by;
  int per_row = 0;  ///< number of steps from row to row; 0: the exact motion
};

inline constexpr double unknown_miss = std::numeric_limits<double>::infinity();

/// A hypothesis with one or two causes. Default: no fault.
struct Hypothesis {
  std::vector<std::string> causes, words;
  std::set<Part> touched;
  Reading reading;  ///< reading of the rows
  Reading start;    ///< reading of the numbers of the scenario's start
  Equations equations;
  Problem problem;
  RowSteps steps;
  double clock = 1, shift = 0;  ///< a row shows the motion at the time clock t_s + shift (s)
  bool excused = false;         ///< the hypothesis may fit, but is no fault
  double miss = unknown_miss;   ///< distance of the rows from the motion (miss.hpp), rad
};

/// The hypothesis with the name of one more cause. The caller has to change the part itself.
Hypothesis with_cause(Hypothesis h, const char* cause, std::string words, Part touched);

bool disjoint(const Hypothesis& a, const Hypothesis& b);

/// The combination of two hypotheses, which must be disjoint.
Hypothesis both(const Hypothesis& a, const Hypothesis& b);

/// Hypotheses with every other reading of the trajectory's columns. plain: the hypothesis without a fault, with the
/// scenario's problem.
std::vector<Hypothesis> other_readings(const Hypothesis& plain, const Trajectory& trajectory);

/// Hypotheses with every fault in the start, the equations and the inertias of the first `moving` bodies.
std::vector<Hypothesis> other_motions(const Hypothesis& plain, std::size_t moving, bool forces_exert_torques);

}  // namespace polhode::study::judge
