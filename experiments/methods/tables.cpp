// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/methods/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::methods {
namespace {

constexpr std::array<std::size_t, 3> asked = {1, 4, 7};           // 1e-3, 1e-6, 1e-9
constexpr std::array<std::size_t, 5> in_table = {0, 2, 4, 6, 8};  // 1e-2, 1e-4, …

/// Geometric mean of the costs of a contender over problems that it solves; absent if it solves none with a cost.
std::optional<double> mean_cost(const Costs& costs, const std::vector<std::size_t>& problems, std::size_t contender,
                                std::size_t target) {
  double sum = 0;
  int n = 0;
  for (const std::size_t p : problems) {
    const Reach& reach = costs.reach[p][contender];
    if (!reach.exact && reach.cost[target]) sum += std::log(*reach.cost[target]), ++n;
  }
  return n == 0 ? std::nullopt : std::optional(std::exp(sum / n));
}

bool some_bound(const Costs& costs, const std::vector<std::size_t>& problems, std::size_t contender,
                std::size_t target) {
  return std::any_of(problems.begin(), problems.end(), [&](std::size_t p) {
    return !costs.reach[p][contender].exact && costs.reach[p][contender].at_most[target];
  });
}

/// Ratio of the runner-up to the winner, as the ranking has it.
double ratio(const Ranked& winner, const Ranked& next) { return std::exp(next.log_ratio - winner.log_ratio); }

std::string solved_text(const Ranked& r, std::size_t tasks) {
  return r.solved == tasks ? "" : fmt::format("{} of {}", r.solved, tasks);
}

}  // namespace

bool anyone(std::size_t) { return true; }

ContenderTest fixed_steps(const Costs& costs) {
  return [&costs](std::size_t c) { return !costs.contenders[c].adaptive; };
}

ContenderTest bounded_energy(const Costs& costs, std::size_t group) {
  return [&costs, problems = costs.problems_of(group)](std::size_t c) {
    bool some = false;
    for (const std::size_t p : problems) {
      const EnergyFate fate = costs.reach[p][c].energy;
      if (fate == EnergyFate::growing) return false;
      some = some || fate == EnergyFate::bounded;
    }
    return some;
  };
}

std::string label(const Contender& contender) {
  return fmt::format("{} ({})", contender.method, contender.formulation);
}

Table recommended(const Costs& costs, const std::string& caption,
                  const std::function<ContenderTest(std::size_t group)>& allowed) {
  using Kind = Column::Kind;
  Table table{.caption = caption,
              .columns = {{"group", "", Kind::text},
                          {"error at most"},
                          {"method", "", Kind::text},
                          {"formulation", "", Kind::text},
                          {"right-hand sides in a characteristic time"},
                          {"bound", "", Kind::text},
                          {"solves", "", Kind::text},
                          {"next method", "", Kind::text},
                          {"times as much"}},
              .rows = {}};
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto problems = costs.problems_of(g);
    for (const std::size_t k : asked) {
      const auto tasks = tasks_of(problems, k);
      const auto ranked = ranking(costs, tasks, allowed(g));
      if (ranked.empty()) {
        table.rows.push_back({costs.groups[g].title, error_text(k), "none reaches it", "", "", "", "", "", ""});
        continue;
      }
      const Ranked& winner = ranked.front();
      const Contender& c = costs.contenders[winner.contender];
      const Ranked* next = runner_up(costs, ranked);
      const auto cost = mean_cost(costs, problems, winner.contender, k);
      table.rows.push_back({costs.groups[g].title, error_text(k), c.method, c.formulation, cost ? number(*cost) : "",
                            some_bound(costs, problems, winner.contender, k) ? "at most" : "",
                            solved_text(winner, tasks.size()), next ? costs.contenders[next->contender].method : "",
                            next && next->solved == winner.solved ? number(ratio(winner, *next)) : ""});
    }
  }
  return without_empty_columns(std::move(table));
}

Table in_short(const Costs& costs) {
  using Kind = Column::Kind;
  Table table{.caption = "The recommended method for each kind of problem, by the error that is asked for",
              .columns = {{"group", "", Kind::text}},
              .rows = {}};
  for (const std::size_t k : asked) table.columns.push_back({"to " + error_text(k), "", Kind::text});
  table.columns.push_back({fmt::format("right-hand sides in a characteristic time, to {}", error_text(usual_target))});
  table.columns.push_back({"next method there", "", Kind::text});
  table.columns.push_back({"times as much"});
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto problems = costs.problems_of(g);
    std::vector<std::string> row = {costs.groups[g].title};
    for (const std::size_t k : asked) {
      const auto ranked = ranking(costs, tasks_of(problems, k), anyone);
      row.push_back(ranked.empty() ? "none" : costs.contenders[ranked.front().contender].method);
    }
    const auto ranked = ranking(costs, tasks_of(problems, usual_target), anyone);
    const Ranked* next = ranked.empty() ? nullptr : runner_up(costs, ranked);
    const auto cost =
        ranked.empty() ? std::nullopt : mean_cost(costs, problems, ranked.front().contender, usual_target);
    row.push_back(cost ? number(*cost) : "");
    row.push_back(next ? costs.contenders[next->contender].method : "");
    row.push_back(next && next->solved == ranked.front().solved ? number(ratio(ranked.front(), *next)) : "");
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table cheapest(const Costs& costs) {
  using Kind = Column::Kind;
  Table table{
      .caption =
          "The cheapest method for each motion and error; ≈, grey on the page: the second costs at most 20 % more",
      .columns = {{"group", "", Kind::text}, {"motion", "", Kind::name}},
      .rows = {}};
  for (const std::size_t k : in_table) table.columns.push_back({error_text(k), "", Kind::text});
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    for (const std::size_t p : costs.problems_of(g)) {
      std::vector<std::string> row = {costs.groups[g].title, costs.problems[p].motion};
      for (const std::size_t k : in_table) {
        const std::vector<std::size_t> one = {p};
        const auto ranked = ranking(costs, tasks_of(one, k), anyone);
        if (ranked.empty()) {
          row.emplace_back("none");
          continue;
        }
        std::string text = costs.contenders[ranked.front().contender].method;
        const Ranked* next = runner_up(costs, ranked);
        if (next && ratio(ranked.front(), *next) <= tie) text += " ≈ " + costs.contenders[next->contender].method;
        row.push_back(std::move(text));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table duels(const Costs& costs, std::size_t opponents) {
  using Kind = Column::Kind;
  Table table{.caption =
                  "The best method of each group over all errors, against the next ones in pairs: geometric mean "
                  "of the ratio of costs, with its 95 % interval by bootstrap over the motions",
              .columns = {{"group", "", Kind::text},
                          {"best", "", Kind::text},
                          {"against", "", Kind::text},
                          {"costs times as much"},
                          {"from"},
                          {"to"},
                          {"motions"},
                          {"only the best reaches"},
                          {"only the other reaches"}},
              .rows = {}};
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto best = representatives(costs, g);
    const auto problems = costs.problems_of(g);
    for (std::size_t i = 1; i < std::min(best.size(), opponents + 1); ++i) {
      const PairRatio pair = pair_ratio(costs, problems, best[i], best[0]);
      const bool interval = pair.problems > 1;
      table.rows.push_back({costs.groups[g].title, label(costs.contenders[best[0]]), label(costs.contenders[best[i]]),
                            pair.problems ? number(pair.ratio) : "", interval ? number(pair.low) : "",
                            interval ? number(pair.high) : "", std::to_string(pair.problems),
                            std::to_string(pair.only_second), std::to_string(pair.only_first)});
    }
  }
  return table;
}

Table robustness(const Costs& costs) {
  using Kind = Column::Kind;
  Table table{.caption =
                  "Each motion left out in turn: what the method that is recommended for the others costs on it, "
                  "over the least cost",
              .columns = {{"group", "", Kind::text},
                          {"tasks"},
                          {"median"},
                          {"nine in ten below"},
                          {"worst"},
                          {"does not reach the error"},
                          {"other method recommended"}},
              .rows = {}};
  std::map<std::size_t, std::vector<Regret>> by_group;
  for (const Regret& r : regrets(costs, anyone)) by_group[costs.problems[r.task.problem].group].push_back(r);
  for (const auto& [g, all] : by_group) {
    std::vector<double> ratios;
    std::size_t failed = 0, other = 0;
    for (const Regret& r : all) {
      ratios.push_back(r.ratio);
      failed += !std::isfinite(r.ratio);
      other += r.other_winner;
    }
    const auto text = [](double x) { return std::isfinite(x) ? number(x) : "not reached"; };
    table.rows.push_back({costs.groups[g].title, std::to_string(all.size()), text(quantile(ratios, 0.5)),
                          text(quantile(ratios, 0.9)), text(quantile(ratios, 1)), std::to_string(failed),
                          std::to_string(other)});
  }
  return table;
}

Table failures(const Costs& costs) {
  using Kind = Column::Kind;
  Table table{.caption = "Methods that do not come below an error of 1e-2 in any formulation within the budget",
              .columns = {{"group", "", Kind::text},
                          {"motion", "", Kind::name},
                          {"error stays larger", "", Kind::text},
                          {"broke off in every run", "", Kind::text},
                          {"refused", "", Kind::text}},
              .rows = {}};
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    for (const std::size_t p : costs.problems_of(g)) {
      std::vector<std::string> order;
      std::set<std::string> reached, measured, ran;
      for (std::size_t c = 0; c < costs.contenders.size(); ++c) {
        const Reach& reach = costs.reach[p][c];
        const std::string& method = costs.contenders[c].method;
        if (!reach.tried) continue;
        if (std::find(order.begin(), order.end(), method) == order.end()) order.push_back(method);
        if (reach.cost[0]) reached.insert(method);
        if (reach.measured) measured.insert(method);
        if (reach.ran) ran.insert(method);
      }
      std::vector<std::string> larger, broke_off, refused;
      for (const auto& method : order) {
        if (reached.contains(method)) continue;
        auto& list = measured.contains(method) ? larger : ran.contains(method) ? broke_off : refused;
        list.push_back(method);
      }
      if (larger.empty() && broke_off.empty() && refused.empty()) continue;
      table.rows.push_back(
          {costs.groups[g].title, costs.problems[p].motion, words(larger), words(broke_off), words(refused)});
    }
  }
  return without_empty_columns(std::move(table));
}

std::string recommended_csv(const Costs& costs) {
  std::string text = csv_row({"group", "error_at_most", "rank", "method", "formulation", "solved", "tasks",
                              "mean_cost_over_least", "rhs_per_characteristic_time"});
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto problems = costs.problems_of(g);
    for (std::size_t k = 0; k < targets; ++k) {
      const auto tasks = tasks_of(problems, k);
      const auto ranked = ranking(costs, tasks, anyone);
      for (std::size_t i = 0; i < ranked.size(); ++i) {
        const Contender& c = costs.contenders[ranked[i].contender];
        text += csv_row({costs.groups[g].name, error_text(k), std::to_string(i + 1), c.method, c.formulation,
                         std::to_string(ranked[i].solved), std::to_string(tasks.size()),
                         csv_cell(std::exp(ranked[i].log_ratio)),
                         csv_cell(mean_cost(costs, problems, ranked[i].contender, k))});
      }
    }
  }
  return text;
}

std::string pairs_csv(const Costs& costs) {
  std::string text = csv_row({"group", "first_method", "first_formulation", "second_method", "second_formulation",
                              "motions", "tasks", "only_first", "only_second", "cost_ratio", "low_95", "high_95"});
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    auto best = representatives(costs, g);
    std::sort(best.begin(), best.end());
    const auto problems = costs.problems_of(g);
    for (std::size_t i = 0; i < best.size(); ++i) {
      for (std::size_t j = i + 1; j < best.size(); ++j) {
        const PairRatio pair = pair_ratio(costs, problems, best[i], best[j]);
        const Contender &a = costs.contenders[best[i]], &b = costs.contenders[best[j]];
        const auto cell = [&](double x) { return pair.problems ? csv_cell(x) : std::string(); };
        text += csv_row({costs.groups[g].name, a.method, a.formulation, b.method, b.formulation,
                         std::to_string(pair.problems), std::to_string(pair.tasks), std::to_string(pair.only_first),
                         std::to_string(pair.only_second), cell(pair.ratio), cell(pair.low), cell(pair.high)});
      }
    }
  }
  return text;
}

std::string regret_csv(const Costs& costs) {
  std::string text = csv_row({"group", "left_out", "error_at_most", "recommended_method", "recommended_formulation",
                              "cost_over_least", "reaches_it", "other_method_than_with_it"});
  for (const Regret& r : regrets(costs, anyone)) {
    const Problem& problem = costs.problems[r.task.problem];
    const Contender& c = costs.contenders[r.recommended];
    text +=
        csv_row({costs.groups[problem.group].name, problem.motion, error_text(r.task.target), c.method, c.formulation,
                 csv_cell(r.ratio), std::isfinite(r.ratio) ? "yes" : "no", r.other_winner ? "yes" : "no"});
  }
  return text;
}

}  // namespace polhode::study::methods
