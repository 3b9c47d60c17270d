// SPDX-License-Identifier: BSD-3-Clause
// What may be wrong with a trajectory: each hypothesis changes the reading of the columns, the start, the equations,
// the inertia, the clock or the steps, and so implies a motion of its own.
#pragma once

#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "experiments/judge/faulty_motion.hpp"
#include "experiments/judge/reading.hpp"

namespace polhode::study::judge {

/// What a hypothesis changes; two hypotheses that change the same part are no pair.
enum class Part { attitude_columns, rate_frame, rate_unit, start, gyroscopic_term, turning, inertia, clock, steps };

/// The steps of a first-order method from row to row.
struct RowSteps {
  FirstOrderStep by;
  int per_row = 0;  ///< 0: the exact motion
};

inline constexpr double unknown_miss = std::numeric_limits<double>::infinity();

/// One or two things that may be wrong; as it stands nothing is.
struct Hypothesis {
  std::vector<std::string> causes, words;
  std::set<Part> touched;
  Reading reading;  ///< how the rows are read
  Reading start;    ///< how the numbers of the scenario's start are read
  Equations equations;
  Problem problem;
  RowSteps steps;
  double clock = 1, shift = 0;  ///< a row shows the motion at clock t_s + shift (s)
  bool excused = false;         ///< the hypothesis is no fault although it may fit
  double miss = unknown_miss;   ///< rad, see miss.hpp
};

/// The hypothesis with one more cause; the part itself is still to be changed.
Hypothesis with_cause(Hypothesis h, const char* cause, std::string words, Part touched);

bool disjoint(const Hypothesis& a, const Hypothesis& b);

/// Both changes at once; the hypotheses are disjoint.
Hypothesis both(const Hypothesis& a, const Hypothesis& b);

/// Every other reading of the trajectory's columns. `plain` has nothing wrong and holds the scenario's problem.
std::vector<Hypothesis> other_readings(const Hypothesis& plain, const Trajectory& trajectory);

/// Every fault in the start, the equations and the inertias of the first `moving` bodies.
std::vector<Hypothesis> other_motions(const Hypothesis& plain, std::size_t moving, bool forces_exert_torques);

}  // namespace polhode::study
