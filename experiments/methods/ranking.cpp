// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/methods/ranking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "core/math/portable_random.hpp"

namespace polhode::study::methods {
namespace {

constexpr int resamples = 2000;  // number of resamples of the bootstrap

/// Least cost of a task among contenders; +inf if none of them reaches it.
double least_cost(const Costs& costs, Task task, const std::vector<std::size_t>& contenders) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t c : contenders) {
    const Reach& reach = costs.reach[task.problem][c];
    if (!reach.exact && reach.cost[task.target]) least = std::min(least, *reach.cost[task.target]);
  }
  return least;
}

bool is_exact_on(const Costs& costs, std::size_t contender, const std::set<std::size_t>& problems) {
  return std::all_of(problems.begin(), problems.end(), [&](std::size_t p) { return costs.reach[p][contender].exact; });
}

}  // namespace

std::vector<Task> tasks_of(std::span<const std::size_t> problems, std::optional<std::size_t> target) {
  std::vector<Task> tasks;
  for (const std::size_t p : problems) {
    for (std::size_t k = 0; k < targets; ++k) {
      if (!target || *target == k) tasks.push_back({p, k});
    }
  }
  return tasks;
}

std::vector<std::size_t> exact_on_all(const Costs& costs, std::span<const std::size_t> problems) {
  const std::set<std::size_t> all(problems.begin(), problems.end());
  std::vector<std::size_t> found;
  for (std::size_t c = 0; c < costs.contenders.size(); ++c) {
    if (!all.empty() && is_exact_on(costs, c, all)) found.push_back(c);
  }
  return found;
}

std::vector<Ranked> ranking(const Costs& costs, const std::vector<Task>& tasks, const ContenderTest& allowed) {
  std::set<std::size_t> problems;
  for (const Task& task : tasks) problems.insert(task.problem);
  std::vector<std::size_t> competing;
  for (std::size_t c = 0; c < costs.contenders.size(); ++c) {
    if (allowed(c) && !is_exact_on(costs, c, problems)) competing.push_back(c);
  }
  std::vector<double> least;
  for (const Task& task : tasks) least.push_back(least_cost(costs, task, competing));
  std::vector<Ranked> ranked;
  for (const std::size_t c : competing) {
    Ranked r{.contender = c};
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const Reach& reach = costs.reach[tasks[i].problem][c];
      if (!reach.exact && !reach.cost[tasks[i].target]) continue;
      ++r.solved;
      if (!reach.exact) r.log_ratio += std::log(*reach.cost[tasks[i].target] / least[i]);
    }
    if (r.solved == 0) continue;
    r.log_ratio /= static_cast<double>(r.solved);
    ranked.push_back(r);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.solved != b.solved ? a.solved > b.solved : a.log_ratio < b.log_ratio;
  });
  return ranked;
}

const Ranked* runner_up(const Costs& costs, const std::vector<Ranked>& ranked) {
  for (const Ranked& r : ranked) {
    if (costs.contenders[r.contender].method != costs.contenders[ranked.front().contender].method) return &r;
  }
  return nullptr;
}

std::vector<Regret> regrets(const Costs& costs, const ContenderTest& allowed) {
  std::vector<Regret> all;
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto problems = costs.problems_of(g);
    if (problems.size() < 3) continue;
    for (std::size_t k = 0; k < targets; ++k) {
      const auto with_all = ranking(costs, tasks_of(problems, k), allowed);
      for (const std::size_t left_out : problems) {
        std::vector<std::size_t> others;
        for (const std::size_t p : problems) {
          if (p != left_out) others.push_back(p);
        }
        const auto known = ranking(costs, tasks_of(others, k), allowed);
        const std::vector<std::size_t> one = {left_out};
        const auto best = ranking(costs, tasks_of(one, k), allowed);
        if (known.empty() || best.empty()) continue;
        Regret regret{.task = {left_out, k}, .recommended = known.front().contender};
        const Reach& reach = costs.reach[left_out][regret.recommended];
        const double least = *costs.reach[left_out][best.front().contender].cost[k];
        regret.ratio = reach.exact     ? 1
                       : reach.cost[k] ? *reach.cost[k] / least
                                       : std::numeric_limits<double>::infinity();
        regret.other_winner =
            costs.contenders[regret.recommended].method != costs.contenders[with_all.front().contender].method;
        all.push_back(regret);
      }
    }
  }
  return all;
}

double quantile(std::vector<double> numbers, double share) {
  std::sort(numbers.begin(), numbers.end());
  const double place = std::ceil(share * static_cast<double>(numbers.size()));
  return numbers[static_cast<std::size_t>(std::max(place, 1.0)) - 1];
}

PairRatio pair_ratio(const Costs& costs, std::span<const std::size_t> problems, std::size_t first, std::size_t second) {
  PairRatio pair;
  std::vector<double> logs;  // mean over the targets, by problem
  for (const std::size_t p : problems) {
    const Reach &a = costs.reach[p][first], &b = costs.reach[p][second];
    if (a.exact || b.exact) continue;
    double sum = 0;
    std::size_t n = 0;
    for (std::size_t k = 0; k < targets; ++k) {
      if (a.cost[k] && b.cost[k]) sum += std::log(*a.cost[k] / *b.cost[k]), ++n;
      else if (a.cost[k]) ++pair.only_first;
      else if (b.cost[k]) ++pair.only_second;
    }
    if (n == 0) continue;
    logs.push_back(sum / static_cast<double>(n));
    pair.tasks += n;
  }
  pair.problems = logs.size();
  if (logs.empty()) return pair;
  const auto n = static_cast<int>(logs.size());
  double sum = 0;
  for (const double x : logs) sum += x;
  pair.ratio = std::exp(sum / n);
  PortableRandom random(1);
  std::vector<double> means;
  for (int i = 0; i < resamples; ++i) {
    double of_sample = 0;
    for (int j = 0; j < n; ++j) of_sample += logs[static_cast<std::size_t>(random.below(n))];
    means.push_back(of_sample / n);
  }
  std::sort(means.begin(), means.end());
  pair.low = std::exp(means[resamples / 40 - 1]);
  pair.high = std::exp(means[resamples - resamples / 40]);
  return pair;
}

std::vector<std::size_t> representatives(const Costs& costs, std::size_t group) {
  const auto tasks = tasks_of(costs.problems_of(group), std::nullopt);
  std::set<std::string> seen;
  std::set<std::size_t> chosen;
  for (const Contender& contender : costs.contenders) {
    if (!seen.insert(contender.method).second) continue;
    const auto own =
        ranking(costs, tasks, [&](std::size_t c) { return costs.contenders[c].method == contender.method; });
    if (!own.empty()) chosen.insert(own.front().contender);
  }
  std::vector<std::size_t> best;
  for (const Ranked& r : ranking(costs, tasks, [&](std::size_t c) { return chosen.contains(c); }))
    best.push_back(r.contender);
  return best;
}

}  // namespace polhode::study::methods
