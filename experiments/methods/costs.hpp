// SPDX-License-Identifier: BSD-3-Clause
// The cost of each method in each formulation on each motion to reach each error: the data of all comparisons.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/methods/groups.hpp"
#include "experiments/methods/ladder.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::methods {

/// A method in one formulation; with contact, with one timing of impacts.
struct Contender {
  std::string method;
  std::string formulation;  ///< "quaternion, velocity_body" or "matrix, momentum_world, event_located"
  bool adaptive = false;
};

struct Problem {
  std::string motion;     ///< "lagrange_top", with its varied keys
  std::size_t group = 0;  ///< index into Costs::groups
  double time = 0;        ///< characteristic time, s
};

/// The course of the energy in the runs that follow the motion.
enum class EnergyFate {
  unknown,
  bounded,  ///< the energy stays at round-off, bounded or settled in some run, and grows in none
  growing   ///< the energy grows in some run
};

/// One contender on one problem.
struct Reach {
  bool tried = false;     ///< the study has runs of it, be they refused
  bool ran = false;       ///< some run was not refused
  bool measured = false;  ///< some run ended and has an error
  /// True if the errors of all runs, from the largest step on, are rounding errors: no approximation.
  bool exact = false;
  EnergyFate energy = EnergyFate::unknown;
  /// Right-hand sides per characteristic time; absent if the error was not reached within the budget. Between two runs
  /// it is interpolated linearly in the logarithms.
  std::array<std::optional<double>, targets> cost{};
  std::optional<double> cheapest_error{};  ///< error of the cheapest run that follows the motion
  std::array<bool, targets> at_most{};     ///< the cheapest run has a smaller error: the cost is an upper bound
};

struct Costs {
  std::vector<Group> groups;  ///< those of the study
  std::vector<Problem> problems;
  std::vector<Contender> contenders;
  std::vector<std::vector<Reach>> reach;  ///< [problem][contender]

  std::vector<std::size_t> problems_of(std::size_t group) const;
};

Costs costs_of(const StudyView& study);

/// costs.csv: a row for each motion and contender that was measured, with seven digits.
std::string csv_of(const Costs& costs);

}  // namespace polhode::study::methods
