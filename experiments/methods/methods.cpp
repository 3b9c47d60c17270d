// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/methods/methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/methods/figures.hpp"
#include "experiments/methods/tables.hpp"
#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::methods {
namespace {

constexpr std::size_t opponents = 5;  // number of opponents in the table of pairs

/// The methods of the study in the order of the catalogue.
std::vector<std::string> methods_of(const Costs& costs) {
  std::set<std::string> present;
  for (const Contender& c : costs.contenders) present.insert(c.method);
  std::vector<std::string> names;
  for (const auto& entry : integrator_catalogue()) {
    if (present.erase(entry.declaration.name) > 0) names.push_back(entry.declaration.name);
  }
  names.insert(names.end(), present.begin(), present.end());
  return names;
}

std::string lower(std::string title) {
  title[0] = static_cast<char>(std::tolower(title[0]));
  return title;
}

/// The methods that are exact on every motion of a group.
std::vector<std::string> methods_exact_on(const Costs& costs, std::size_t group) {
  std::vector<std::string> names;
  for (const std::size_t c : exact_on_all(costs, costs.problems_of(group))) {
    const auto& method = costs.contenders[c].method;
    if (std::find(names.begin(), names.end(), method) == names.end()) names.push_back(method);
  }
  return names;
}

/// Groups by the method that is the cheapest in them, in the order of the groups.
std::string winners(const Costs& costs) {
  std::vector<std::pair<std::string, std::vector<std::string>>> found;
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto ranked = ranking(costs, tasks_of(costs.problems_of(g), usual_target), anyone);
    const std::string method = ranked.empty() ? "no method" : costs.contenders[ranked.front().contender].method;
    const auto known = std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.first == method; });
    (known == found.end() ? found.emplace_back(method, std::vector<std::string>{}) : *known)
        .second.push_back(lower(costs.groups[g].title));
  }
  std::vector<std::string> parts;
  for (const auto& [method, titles] : found) parts.push_back(fmt::format("{} for {}", method, words(titles)));
  bool some_exact = false;
  for (std::size_t g = 0; g < costs.groups.size(); ++g) some_exact = some_exact || !methods_exact_on(costs, g).empty();
  return fmt::format("{} error of {} is reached at the least cost by {}.",
                     some_exact ? "Exact methods aside, an" : "An", error_text(usual_target),
                     fmt::format("{}", fmt::join(parts, "; ")));
}

std::string held_out(const Costs& costs) {
  const auto all = regrets(costs, anyone);
  if (all.empty())
    return "No group has three motions, so that no recommendation could be tried on one that it does not know.";
  std::vector<double> ratios;
  std::size_t failed = 0;
  for (const Regret& r : all) ratios.push_back(r.ratio), failed += !std::isfinite(r.ratio);
  const auto times = [](double x) {
    return std::isfinite(x) ? fmt::format("at most {} times the least cost", number(x))
                            : std::string("more than the budget");
  };
  return fmt::format(
      "On a motion that it was not chosen for, the recommended method costs {} in half of {} tasks and {} in nine of "
      "ten{}.",
      times(quantile(ratios, 0.5)), all.size(), times(quantile(ratios, 0.9)),
      failed == 0 ? "" : fmt::format("; in {} of them it does not reach the error", failed));
}

std::string exact_ones(const Costs& costs) {
  std::vector<std::string> parts;
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto names = methods_exact_on(costs, g);
    if (!names.empty())
      parts.push_back(fmt::format("{} on all {}", words(first_items(names, 5)), lower(costs.groups[g].title)));
  }
  if (parts.empty()) return "";
  return fmt::format("Exact at every step, and so outside the comparison: {}.",
                     fmt::format("{}", fmt::join(parts, "; ")));
}

/// The best method of a group over all errors against the next one.
std::vector<std::string> duel_sentences(const Costs& costs) {
  std::vector<std::string> all;
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    const auto best = representatives(costs, g);
    if (best.size() < 2) continue;
    const PairRatio pair = pair_ratio(costs, costs.problems_of(g), best[1], best[0]);
    const std::string a = label(costs.contenders[best[0]]), b = label(costs.contenders[best[1]]);
    const std::string group = costs.groups[g].title;
    if (pair.problems < 3) {
      all.push_back(
          fmt::format("{}: {} and then {} come first over all errors; that both compete on {} is too little for an "
                      "interval of their ratio.",
                      group, a, b, count(pair.problems, "motion")));
    } else if (pair.low > 1) {
      all.push_back(
          fmt::format("{}: over all errors {} comes first; {} costs {} times as much (95 % interval {} to {} "
                      "over {} motions).",
                      group, a, b, number(pair.ratio), number(pair.low), number(pair.high), pair.problems));
    } else {
      all.push_back(
          fmt::format("{}: over all errors {} comes first, but these motions do not decide between it and {}, "
                      "which costs {} times as much (95 % interval {} to {} over {} motions).",
                      group, a, b, number(pair.ratio), number(pair.low), number(pair.high), pair.problems));
    }
  }
  return all;
}

/// The tasks in which the recommendation changes with one motion left out.
std::vector<std::string> change_sentences(const Costs& costs) {
  std::vector<std::string> all;
  const auto found = regrets(costs, anyone);
  for (std::size_t g = 0; g < costs.groups.size(); ++g) {
    std::size_t tasks = 0, changed = 0;
    std::set<std::string> motions;
    for (const Regret& r : found) {
      if (costs.problems[r.task.problem].group != g) continue;
      ++tasks;
      if (r.other_winner) ++changed, motions.insert(costs.problems[r.task.problem].motion);
    }
    if (changed == 0) continue;
    all.push_back(fmt::format("{}: in {} of {} tasks another method is recommended if the motion is left out ({}).",
                              costs.groups[g].title, changed, tasks, words({motions.begin(), motions.end()})));
  }
  return all;
}

std::vector<std::string> depends() {
  return {
      fmt::format(
          "Costs are right-hand sides per characteristic time of the motion, at most {:g}; a method that spends "
          "more has not solved the task. Each method counts its own: a splitting counts the forces of its kicks and "
          "not its free flows.",
          budget),
      "The error is the largest at 32 instants: for motions the larger of the attitude error (rad) and the position "
      "error over the extent of the motion (over 1 m where that is not known); for impacts the larger of the error of "
      "the "
      "time of the first impact over the characteristic time and the drift of the energy over its scale; for stacks "
      "the "
      "larger of displacement and penetration (m).",
      "A recommendation is the method and formulation that solves the most motions of the group, and among those the "
      "one with the least geometric mean of its cost over the least cost.",
      "A group holds few motions, in the one setting that each scenario file gives. The groups are those of "
      "experiments/methods/groups.cpp."};
}

std::string paragraph(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& s : sentences) text += "- " + s + "\n";
  return text;
}

}  // namespace

Analysis comparison(const StudyView& study) {
  Analysis found{.alone = true, .heading = "Methods over problems"};
  const Costs costs = costs_of(study);
  const bool measured = std::any_of(costs.reach.begin(), costs.reach.end(), [](const auto& row) {
    return std::any_of(row.begin(), row.end(), [](const Reach& r) { return r.measured; });
  });
  if (!measured) {
    found.sentences.emplace_back(
        "No error was measured: no run ended, or neither an exact motion nor a reference is known.");
    return found;
  }
  const auto names = methods_of(costs);
  const Table best = recommended(costs, "The recommended method for each group and error",
                                 [](std::size_t) { return ContenderTest(anyone); });
  found.answer.sentences = {winners(costs)};
  if (auto text = exact_ones(costs); !text.empty()) found.answer.sentences.push_back(std::move(text));
  found.answer.sentences.push_back(held_out(costs));
  found.answer.depends = depends();
  found.answer.table = in_short(costs);
  found.sentences = duel_sentences(costs);
  for (auto& text : change_sentences(costs)) found.sentences.push_back(std::move(text));
  found.method = {
      "A task is a motion and an error, from 1e-2 to 1e-10. Steps are halved, tolerances divided by ten, until the "
      "error "
      "is below 1e-10 or the budget is spent; between two runs the cost is interpolated in the logarithms, never "
      "extrapolated: “at most” marks a cost of a run that is already better. Pairs are compared by the geometric mean "
      "of "
      "their cost ratios over the tasks that both solve, first within each motion, then over motions; the interval is "
      "a "
      "bootstrap of 2000 samples over motions. There is no mean rank and no total over groups.",
      "The cost over the least cost on a motion that is left out judges the recommendations: the method is chosen from "
      "the other motions of the group alone."};
  found.tables = {
      {"recommended", best},
      {"fixed_step",
       recommended(costs, "Among the methods with a fixed step", [&](std::size_t) { return fixed_steps(costs); })},
      {"bounded_energy",
       recommended(costs,
                   "Among the methods whose energy is bounded on some motion of the group and grows on none that they "
                   "follow",
                   [&](std::size_t g) { return bounded_energy(costs, g); })},
      {"cheapest", cheapest(costs)},
      {"pairs", duels(costs, opponents)},
      {"robustness", robustness(costs)},
      {"failures", failures(costs)}};
  found.figures = {solved_against_budget(costs, names), profiles_of_two(costs, names)};
  found.files = {{"costs.csv", csv_of(costs)},
                 {"recommended.csv", recommended_csv(costs)},
                 {"pairs.csv", pairs_csv(costs)},
                 {"regret.csv", regret_csv(costs)}};
  std::string page = paragraph(found.answer.sentences) + "\n" + paragraph(found.sentences) + "\n";
  for (const auto& table : found.tables) page += "**" + table.table.caption + "**\n\n" + markdown(table.table) + "\n";
  page += "What it depends on:\n\n" + paragraph(found.answer.depends) + "\n" + paragraph(found.method);
  found.files.push_back({"methods.md", std::move(page)});
  return found;
}

}  // namespace polhode::study::methods
