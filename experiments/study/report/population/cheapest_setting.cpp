// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/population/cheapest_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline population {
namespace {

constexpr double nearly_all = 0.95;  // share of the runs that reach the error
constexpr std::size_t most_rows = 5;

std::string step_words(bool adaptive, double step) {
  return adaptive ? "tolerance = " + rounded(step) : fmt::format("dt = {} s", rounded(step));
}

std::string capital(std::string text) {
  text.front() = 'A';
  return text;
}

}  // namespace

const std::array<double, CheapestSetting::decades.size()> CheapestSetting::limits = [] {
  std::array<double, decades.size()> all{};
  std::transform(decades.begin(), decades.end(), all.begin(), [](int decade) { return std::pow(10.0, decade); });
  return all;
}();

void CheapestSetting::add(const RunRecord& run) {
  ++outcomes_[run.result.status];
  const auto& step = run.config.tolerance ? run.config.tolerance : run.config.dt;
  if (run.result.status == "refused" || !step) return;
  const Key key(run.config.integrator, run.config.tolerance.has_value(), *step);
  const auto count = [&](Settings& settings, const std::optional<double>& error) {
    if (settings.size() == most_settings && !settings.contains(key)) {
      too_many_ = true;
      return;
    }
    Setting& setting = settings[key];
    ++setting.runs;
    if (run.result.status != "ok" || !error || !std::isfinite(*error)) return;
    ++setting.with_error;
    for (std::size_t k = 0; k < decades.size(); ++k) setting.reached[k] += *error <= limits[k];
    setting.cost.add(static_cast<double>(run.result.evaluations));
  };
  count(attitude_, run.result.attitude_error_max);
  count(position_, run.result.position_error_max);
}

/// The setting of each method with the least median cost among those that reach the error in nearly all runs.
std::map<std::string, CheapestSetting::Settings::const_iterator> CheapestSetting::cheapest(const Settings& settings,
                                                                                           std::size_t decade) const {
  std::map<std::string, Settings::const_iterator> found;
  for (auto at = settings.begin(); at != settings.end(); ++at) {
    const Setting& s = at->second;
    const bool reaches = double(s.reached[decade]) >= nearly_all * double(s.runs);
    if (!reaches || s.with_error == 0 || *s.cost.quantile(0.5) <= 0) continue;
    const auto [known, added] = found.emplace(std::get<0>(at->first), at);
    if (!added && *s.cost.quantile(0.5) < *known->second->second.cost.quantile(0.5)) known->second = at;
  }
  return found;
}

Answer CheapestSetting::ranked(const Settings& settings, const char* what, const char* unit) const {
  Answer answer;
  std::size_t best = decades.size(), most = 0;
  for (std::size_t k = 0; k < decades.size(); ++k) {
    if (const std::size_t n = cheapest(settings, k).size(); n > most) most = n, best = k;
  }
  if (best == decades.size()) {
    answer.sentences.push_back(
        fmt::format("No method has {} error of at most 0.1 {} in 95 % of its runs, at any of its steps or tolerances.",
                    what, unit));
    answer.sentences.emplace_back("Smaller steps or tolerances would decide.");
    return answer;
  }
  const auto found = cheapest(settings, best);
  std::vector<Settings::const_iterator> order;
  for (const auto& [method, at] : found) order.push_back(at);
  const auto cost = [](Settings::const_iterator at) { return *at->second.cost.quantile(0.5); };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return cost(a) < cost(b); });
  const auto& [key, first] = *order.front();
  const auto& [method, adaptive, step] = key;
  const std::string target = fmt::format("1e{} {}", decades[best], unit);
  answer.sentences.push_back(fmt::format(
      "{} error of at most {} in 95 % of the runs takes the fewest right-hand sides with {} at {}: {} of its {} runs "
      "there reach it, with a median of about {} right-hand sides.",
      capital(what), target, method, step_words(adaptive, step), first.reached[best], first.runs,
      number(cost(order.front()))));
  if (order.size() > 1) {
    const auto& [next_method, next_adaptive, next_step] = order[1]->first;
    const double ratio = cost(order[1]) / cost(order[0]);
    answer.sentences.push_back(fmt::format("{} {} at {} with {} times as many.",
                                           ratio <= 1.2 ? "A tie within 20 %:" : "Next is", next_method,
                                           step_words(next_adaptive, next_step), number(ratio)));
  } else {
    answer.sentences.emplace_back("No other method of the study reaches it in 95 % of its runs.");
  }
  Table table{.caption = fmt::format("The cheapest step or tolerance of each method with an error of at most {} in 95 "
                                     "% of its runs",
                                     target),
              .columns = {{"method", "", Column::Kind::name},
                          {"step or tolerance", "", Column::Kind::text},
                          {"runs"},
                          {"of these reach it"},
                          {"right-hand sides, median"}},
              .rows = {}};
  for (const auto at : order) {
    if (table.rows.size() == most_rows) break;
    const auto& [name, by_tolerance, at_step] = at->first;
    table.rows.push_back({name, step_words(by_tolerance, at_step), std::to_string(at->second.runs),
                          std::to_string(at->second.reached[best]), number(cost(at))});
  }
  answer.table = std::move(table);
  answer.depends.emplace_back("It holds for the distribution of scenarios, starts and formulations of these runs.");
  answer.depends.emplace_back(
      "The cost counts evaluations of the right-hand side; the median is within 1 % of a run's cost.");
  answer.depends.emplace_back("Costs are those of the steps that were run, and not read between them.");
  return answer;
}

Answer CheapestSetting::answer() const {
  const auto errors = [](const Settings& settings) {
    return std::any_of(settings.begin(), settings.end(), [](const auto& s) { return s.second.with_error > 0; });
  };
  Answer answer;
  if (too_many_)
    answer.sentences.emplace_back(
        "Steps or tolerances differ from run to run, so that the study recommends none; the same steps for all runs "
        "would decide.");
  else if (errors(attitude_)) answer = ranked(attitude_, "an attitude", "rad");
  else if (errors(position_)) answer = ranked(position_, "a position", "m");
  else
    answer.sentences.emplace_back(
        "These runs do not tell which method is right: no error against an exact motion was measured; --reference "
        "measures errors against a reference motion where there is no contact.");
  std::vector<std::string> lost;
  for (const char* status : {"diverged", "failed", "refused"}) {
    if (const auto at = outcomes_.find(status); at != outcomes_.end())
      lost.push_back(fmt::format("{} {}", at->second, status));
  }
  if (!lost.empty()) {
    std::size_t all = 0;
    for (const auto& [status, n] : outcomes_) all += n;
    answer.sentences.push_back(fmt::format("Of {} runs {}.", all, words(lost)));
  }
  return answer;
}

}  // namespace polhode::study::report::population
