// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/methods/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "experiments/methods/tables.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/plain_panel.hpp"

namespace polhode::study::methods {
namespace {

constexpr std::size_t most_coloured = 10;
constexpr std::array<const char*, 4> well_known = {"rk4", "semi_implicit_euler", "implicit_midpoint", "odeint_dopri5"};

std::size_t place_in(const std::vector<std::string>& catalogue, const std::string& method) {
  return static_cast<std::size_t>(std::find(catalogue.begin(), catalogue.end(), method) - catalogue.begin());
}

/// The contenders that stand for their methods in a group: exact ones too.
std::vector<std::size_t> shown_in(const Costs& costs, std::size_t group) {
  std::vector<std::size_t> shown = representatives(costs, group);
  std::set<std::string> methods;
  for (const std::size_t c : shown) methods.insert(costs.contenders[c].method);
  for (const std::size_t c : exact_on_all(costs, costs.problems_of(group))) {
    if (methods.insert(costs.contenders[c].method).second) shown.push_back(c);
  }
  return shown;
}

/// The share of `tasks` numbers that are at most x, at a few x a decade from `begin` to `end`.
std::vector<std::pair<double, double>> shares(const std::vector<double>& numbers, std::size_t tasks, double begin,
                                              double end) {
  constexpr double in_a_decade = 8;
  const int n = std::max(1, static_cast<int>(std::lround(in_a_decade * std::log10(end / begin))));
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i <= n; ++i) {
    const double x = i == n ? end : begin * std::pow(end / begin, static_cast<double>(i) / n);
    const auto solved = std::count_if(numbers.begin(), numbers.end(), [&](double cost) { return cost <= x; });
    points.emplace_back(x, static_cast<double>(solved) / static_cast<double>(tasks));
  }
  return points;
}

/// The methods in colour: those that are recommended for the usual error, those that are the best over all errors, then
/// well known ones.
std::set<std::string> coloured(const Costs& costs) {
  std::vector<std::string> names;
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto ranked = ranking(costs, tasks_of(costs.problems_of(g), usual_target), anyone);
    if (!ranked.empty()) names.push_back(costs.contenders[ranked.front().contender].method);
  }
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto best = representatives(costs, g);
    if (!best.empty()) names.push_back(costs.contenders[best.front()].method);
  }
  names.insert(names.end(), well_known.begin(), well_known.end());
  std::set<std::string> chosen;
  for (const auto& name : names) {
    if (chosen.size() < most_coloured) chosen.insert(name);
  }
  return chosen;
}

Figure two_a_row(Figure figure, std::vector<Panel> panels) {
  std::erase_if(panels, [](const Panel& panel) { return panel.curves.empty(); });
  add_rows(figure, std::move(panels), 2);
  figure.variants = {""};
  note_marks(figure);
  return figure;
}

}  // namespace

Figure solved_against_budget(const Costs& costs, const std::vector<std::string>& catalogue) {
  const std::set<std::string> in_colour = coloured(costs);
  std::vector<Panel> panels;
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto problems = costs.problems_of(g);
    const auto tasks = tasks_of(problems, std::nullopt);
    std::vector<PlainCurve> curves;
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::pair<std::size_t, std::vector<double>>> all;
    for (const std::size_t c : shown_in(costs, g)) {
      std::vector<double> spent;
      for (const Task& task : tasks) {
        if (const auto& cost = costs.reach[task.problem][c].cost[task.target]) spent.push_back(*cost);
      }
      if (spent.empty()) continue;
      least = std::min(least, *std::min_element(spent.begin(), spent.end()));
      all.emplace_back(c, std::move(spent));
    }
    if (all.empty()) continue;
    for (auto& [c, spent] : all) {
      const auto& method = costs.contenders[c].method;
      curves.push_back({.label = method,
                        .method = place_in(catalogue, method),
                        .points = shares(spent, tasks.size(), least, budget)});
    }
    Panel panel =
        plain_panel(costs.groups[g].title, {"rhs_per_characteristic_time", "right-hand sides in a characteristic time"},
                    {"share_solved", "share solved", Scale::linear}, curves);
    for (auto& curve : panel.curves) curve.muted = !in_colour.contains(curve.label);
    std::stable_partition(panel.curves.begin(), panel.curves.end(), [](const auto& c) { return c.muted; });
    panels.push_back(std::move(panel));
  }
  return two_a_row(
      {.name = "solved_against_budget",
       .title = "Tasks solved within a budget",
       .caption =
           "Share of the tasks (a motion and an error from 1e-2 to 1e-10) that each method has solved, against the "
           "right-hand sides that it may spend in a characteristic time of the motion. Each method in the formulation "
           "that is its best one in the group. A task that is not solved within the budget counts as never solved. No "
           "total over the groups: it would weigh them by how many motions each happens to have.",
       .methods = catalogue},
      std::move(panels));
}

Figure profiles_of_two(const Costs& costs, const std::vector<std::string>& catalogue) {
  constexpr double widest = 100;
  std::vector<Panel> panels;
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto best = representatives(costs, g);
    if (best.size() < 2) continue;
    const auto tasks = tasks_of(costs.problems_of(g), std::nullopt);
    std::array<std::vector<double>, 2> ratios;
    std::size_t solved = 0;
    for (const Task& task : tasks) {
      const Reach &a = costs.reach[task.problem][best[0]], &b = costs.reach[task.problem][best[1]];
      if (a.exact || b.exact || (!a.cost[task.target] && !b.cost[task.target])) continue;
      ++solved;
      constexpr double never = std::numeric_limits<double>::infinity();
      const double x = a.cost[task.target].value_or(never), y = b.cost[task.target].value_or(never);
      if (x / std::min(x, y) <= widest) ratios[0].push_back(x / std::min(x, y));
      if (y / std::min(x, y) <= widest) ratios[1].push_back(y / std::min(x, y));
    }
    if (solved == 0) continue;
    std::vector<PlainCurve> curves;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& method = costs.contenders[best[i]].method;
      curves.push_back(
          {.label = method, .method = place_in(catalogue, method), .points = shares(ratios[i], solved, 1, widest)});
    }
    panels.push_back(plain_panel(costs.groups[g].title, {"cost_over_lesser", "cost over that of the cheaper one"},
                                 {"share_solved", "share solved", Scale::linear}, curves));
  }
  return two_a_row(
      {.name = "profiles_of_two",
       .title = "The best method and the next one",
       .caption = "Performance profile of two methods for each group: share of the tasks that each solves at a cost of "
                  "at most so many times that of the cheaper one of the two. Two at a time only: with more of them a "
                  "profile can name the wrong one (Gould & Scott 2016).",
       .methods = catalogue},
      std::move(panels));
}

}  // namespace polhode::study::methods
