// SPDX-License-Identifier: BSD-3-Clause
// Comparisons of contenders over the problems of a group, from their costs alone.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "experiments/methods/costs.hpp"

namespace polhode::study::methods {

/// A task: a problem (index into Costs::problems) and a target (index of the error to be reached).
struct Task {
  std::size_t problem = 0, target = 0;
};
/// All tasks of some problems with one target, or with all.
std::vector<Task> tasks_of(std::span<const std::size_t> problems, std::optional<std::size_t> target);

struct Ranked {
  std::size_t contender = 0;
  std::size_t solved = 0;  ///< number of tasks
  double log_ratio = 0;    ///< mean over the solved tasks of ln(cost / least cost); 0 for a task solved exactly
};

using ContenderTest = std::function<bool(std::size_t contender)>;

/// The contenders that solve a task, best first: those that solve more tasks before those that solve less, then by
/// log_ratio, then in the order of the catalogue. Contenders that are exact on every problem of the tasks do not
/// compete. The least cost of a task is that of the allowed contenders that compete.
std::vector<Ranked> ranking(const Costs& costs, const std::vector<Task>& tasks, const ContenderTest& allowed);

/// Contenders that are exact on all the problems.
std::vector<std::size_t> exact_on_all(const Costs& costs, std::span<const std::size_t> problems);

/// The first contender of another method in a ranking.
const Ranked* runner_up(const Costs& costs, const std::vector<Ranked>& ranked);

/// The cost of the recommendation on a problem that is not used for it: the contender that is recommended for the other
/// problems of the group, its cost on this one over the least cost.
struct Regret {
  Task task;
  std::size_t recommended = 0;  ///< contender
  double ratio = 0;             ///< +inf if it does not reach the error and another one does
  bool other_winner = false;    ///< another method is recommended without the problem than with it
};
/// The regrets for all targets and all problems of groups with at least three problems. Tasks that no contender solves
/// are left out.
std::vector<Regret> regrets(const Costs& costs, const ContenderTest& allowed);

/// The smallest of the numbers that at least this share of them does not exceed; the numbers may be infinite.
double quantile(std::vector<double> numbers, double share);

/// The ratio of the costs of two contenders.
struct PairRatio {
  std::size_t problems = 0, tasks = 0;          ///< those that both solve
  std::size_t only_first = 0, only_second = 0;  ///< tasks that one of them alone solves
  double ratio = 0;                             ///< geometric mean of cost of the first over cost of the second
  double low = 0, high = 0;  ///< 95 % interval by bootstrap over the problems; equal to ratio for one
};
/// Tasks that one of them solves exactly are left out: it has no cost for an error.
PairRatio pair_ratio(const Costs& costs, std::span<const std::size_t> problems, std::size_t first, std::size_t second);

/// The best contender of each method in a group, over all targets, whatever the other methods cost; the best method
/// first. Methods that solve nothing or are exact are left out.
std::vector<std::size_t> representatives(const Costs& costs, std::size_t group);

}  // namespace polhode::study::methods
