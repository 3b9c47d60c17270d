// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/methods/costs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "experiments/methods/ruler.hpp"
#include "experiments/study/curves/envelope.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::methods {
namespace {

constexpr double lost = 1;             ///< error from which the motion is lost
constexpr double least_error = 1e-17;  ///< stands for an error of exactly zero, which has no logarithm

std::string formulation_of(const RunConfig& c) {
  std::string text = fmt::format("{}, {}", name(c.formulation.orientation), name(c.formulation.angular_state));
  if (c.normalize) text += ", normalized";
  if (c.contact && !c.contact->impact_timing.empty()) text += ", " + c.contact->impact_timing;
  return text;
}

EnergyFate fate(const std::vector<const RunRecord*>& followed) {
  static const std::set<std::string> bounded = {"round-off", "bounded", "saturated", "jumps"},
                                     growing = {"random walk", "sublinear", "linear", "quadratic", "faster"};
  EnergyFate found = EnergyFate::unknown;
  for (const RunRecord* run : followed) {
    if (growing.contains(run->result.drift_class)) return EnergyFate::growing;
    if (bounded.contains(run->result.drift_class)) found = EnergyFate::bounded;
  }
  return found;
}

/// True if the error at each step, from the smallest one on, is that of rounding: below 1e-10, or below 1e-8 and not
/// falling with the step.
bool is_exact(const std::vector<WorkPoint>& points) {
  if (points.size() < 2) return false;
  const auto largest =
      std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
  constexpr double rounding = 1e-8;  // rounding error of a motion that amplifies it
  const bool falls = points.front().error < 0.1 * points.back().error;
  return largest->error <= target(targets - 1) || (largest->error <= rounding && !falls);
}

Reach reach_of(const Rungs& ladder, const Ruler& ruler, double time) {
  Reach reach{.tried = true};
  std::vector<WorkPoint> points;
  std::vector<const RunRecord*> followed;
  bool broke_off = false;
  for (auto at = ladder.runs.rbegin(); at != ladder.runs.rend(); ++at) {  // from the smallest step
    const RunRecord& run = **at;
    const auto error = ruler.error(run);
    if (run.result.status == "ok" && error) reach.measured = true;
    if (run.result.status != "refused") reach.ran = true;
    if (!error || *error >= lost) {
      broke_off = true;
      if (!points.empty()) break;  // larger steps agree with the motion by chance
      continue;
    }
    points.push_back(
        {std::max(*error, least_error), static_cast<double>(run.result.evaluations) * time / run.config.t_end, &run});
    followed.push_back(&run);
  }
  reach.energy = fate(followed);
  reach.exact = !broke_off && !ladder.any->config.tolerance && is_exact(points);
  const auto cheapest =
      std::min_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  for (std::size_t k = 0; k < targets; ++k) {
    reach.cost[k] = cost_to_reach(target(k), points);
    if (reach.cost[k] && *reach.cost[k] > budget) reach.cost[k].reset();
    reach.at_most[k] = reach.cost[k] && cheapest->error < target(k);
  }
  if (!points.empty()) reach.cheapest_error = cheapest->error;
  return reach;
}

/// The scenario and its varied keys; the duration too if the study has several of the scenario.
std::string name_of(const RunConfig& config, const std::map<std::string, std::set<double>>& durations) {
  std::string text = motion_of(config);
  if (durations.at(config.scenario).size() == 1) text.resize(text.rfind(", t_end = "));
  return text;
}

template <class Key>
std::size_t place_of(std::map<Key, std::size_t>& seen, const Key& key) {
  return seen.emplace(key, seen.size()).first->second;
}

}  // namespace

std::vector<std::size_t> Costs::problems_of(std::size_t group) const {
  std::vector<std::size_t> found;
  for (std::size_t p = 0; p < problems.size(); ++p) {
    if (problems[p].group == group) found.push_back(p);
  }
  return found;
}

Costs costs_of(const StudyView& study) {
  Costs costs;
  const Ruler ruler(study);
  std::map<std::string, std::size_t> group_places, problem_places;
  std::map<std::pair<std::string, std::string>, std::size_t> contender_places;
  for (const Group& group : groups()) {  // in their fixed order
    const bool present = std::any_of(study.runs.begin(), study.runs.end(),
                                     [&](const RunRecord& run) { return group_of(*run.scenario).name == group.name; });
    if (present) costs.groups.push_back(group), place_of(group_places, group.name);
  }
  std::map<std::string, std::set<double>> durations;
  for (const RunRecord& run : study.runs) durations[run.config.scenario].insert(run.config.t_end);
  for (const Rungs& ladder : ladders(study)) {
    const RunRecord& any = *ladder.any;
    const Group group = group_of(*any.scenario);
    const std::size_t g = place_of(group_places, group.name);
    if (g == costs.groups.size()) costs.groups.push_back(group);
    const std::size_t p = place_of(problem_places, motion_of(any.config));
    if (p == costs.problems.size()) {
      costs.problems.push_back({name_of(any.config, durations), g, characteristic_time(any)});
      costs.reach.emplace_back(costs.contenders.size());
    }
    const std::string formulation = formulation_of(any.config);
    const std::size_t c = place_of(contender_places, {any.config.integrator, formulation});
    if (c == costs.contenders.size()) {
      costs.contenders.push_back({any.config.integrator, formulation, any.config.tolerance.has_value()});
      for (auto& row : costs.reach) row.emplace_back();
    }
    costs.reach[p][c] = reach_of(ladder, ruler, costs.problems[p].time);
  }
  return costs;
}

std::string csv_of(const Costs& costs) {
  constexpr int digits = 7;
  std::vector<std::string> header = {"group",    "motion", "characteristic_time_s", "method", "formulation", "adaptive",
                                     "is_exact", "energy", "error_of_cheapest_run"};
  for (std::size_t k = 0; k < targets; ++k) header.push_back("rhs_per_time_to_" + error_text(k));
  std::string text = csv_row(header);
  for (std::size_t p = 0; p < costs.problems.size(); ++p) {
    const Problem& problem = costs.problems[p];
    for (std::size_t c = 0; c < costs.contenders.size(); ++c) {
      const Reach& reach = costs.reach[p][c];
      const Contender& contender = costs.contenders[c];
      if (!reach.measured) continue;
      const auto* energy = reach.energy == EnergyFate::bounded   ? "bounded"
                           : reach.energy == EnergyFate::growing ? "growing"
                                                                 : "unknown";
      std::vector<std::string> row = {costs.groups[problem.group].name,
                                      problem.motion,
                                      number(problem.time, digits),
                                      contender.method,
                                      contender.formulation,
                                      contender.adaptive ? "yes" : "no",
                                      reach.exact ? "yes" : "no",
                                      energy,
                                      reach.cheapest_error ? number(*reach.cheapest_error, 3) : ""};
      for (const auto& cost : reach.cost) row.push_back(cost ? number(*cost, digits) : "");
      text += csv_row(row);
    }
  }
  return text;
}

}  // namespace polhode::study::methods
