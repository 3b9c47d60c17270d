// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/study/plan/deal.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study {
namespace {

/// The values of one column: the first ones, and how many there are.
std::string values_text(const Plan& plan, const std::string& name, std::size_t column) {
  const auto found = plan.values.find(name);
  if (found == plan.values.end()) return {};
  std::string line;
  for (const std::uint32_t i : found->second.runs) {
    const std::string value = config_cells(plan.run(i).config, plan.named)[column];
    if (!value.empty()) line += (line.empty() ? "" : ", ") + rounded(value);
  }
  const auto& [count, shown] = found->second;
  return shown.size() == count ? line : line + fmt::format(", … ({} values)", count);
}

/// The cells of each study, if they are more than the runs.
std::string studies_text(const Plan& plan) {
  std::string text;
  std::size_t cells = 0, left_out = 0;
  for (const StudyCount& study : plan.studies) {
    cells += study.cells;
    left_out += study.left_out;
    if (study.name.empty() && study.left_out == 0) continue;
    text += fmt::format("{}{}", study.name.empty() ? "" : study.name + ": ", count(study.cells, "cell"));
    if (study.left_out > 0) text += fmt::format(", of which where leaves out {}", study.left_out);
    text += '\n';
  }
  const std::size_t twice = cells - left_out - plan.size();
  if (twice > 0)
    text += fmt::format("{} the same run as another, which is carried out once\n",
                        twice == 1 ? "1 cell is" : fmt::format("{} cells are", twice));
  return text;
}

}  // namespace

std::string glance_text(const Experiment& experiment, const Plan& chosen) {
  double cost = 0;
  std::size_t cells = 0;
  for (const PlanRow& row : chosen.rows) cost += row.cost * chosen.runs_of_a_row;
  for (const StudyCount& study : chosen.studies) cells += study.cells;
  const double runs = static_cast<double>(chosen.size()) * chosen.runs_of_a_row;
  const double digits = std::pow(10, std::floor(std::log10(runs)) - 2);  // three are known
  return fmt::format("{}: {}; by {} of them about {:.0f} runs and {:.2g} right-hand sides\n", experiment.name,
                     count(cells, "cell"), chosen.size(), std::round(runs / digits) * digits, cost);
}

std::string plan_text(const Experiment& experiment, const Plan& plan, const std::filesystem::path& folder,
                      const std::vector<std::uint64_t>& done) {
  double cost = 0;
  std::size_t there = 0;
  std::vector<Unfinished> refused;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    cost += plan.rows[i].cost;
    if (std::binary_search(done.begin(), done.end(), plan.rows[i].id)) ++there;
    if (plan.rows[i].refused) refused.push_back({"will be refused", plan.run(i).refusal});
  }
  std::string text = fmt::format("{}: {}, about {:.2g} right-hand sides, into {}\n", experiment.name,
                                 count(plan.size(), "run"), cost, folder.string());
  text += studies_text(plan);
  if (there > 0) text += fmt::format("{} of {} are there already\n", there, count(plan.size(), "run"));
  text += reasons(refused);
  if (experiment.refine) text += "further runs follow from the results of these\n";
  const auto names = config_columns(plan.varied_keys, plan.named);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (const std::string line = values_text(plan, names[k], k); !line.empty())
      text += fmt::format("  {:<15} {}\n", names[k], line);
  }
  for (const StudyCount& study : plan.studies) {
    for (const std::string& table : study.tables)
      text += fmt::format("  {}{}\n", study.name.empty() ? "" : study.name + ": ", table);
  }
  return text;
}

std::string shard_text(const Plan& plan, const Shard& shard, const std::vector<std::uint64_t>& done) {
  const std::vector<std::size_t> shards = deal(plan, shard.count);
  std::size_t own = 0, there = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (shards[i] != shard.number) continue;
    ++own;
    there += std::binary_search(done.begin(), done.end(), plan.rows[i].id);
  }
  return fmt::format("shard {}/{}: {}, of which {} {} there already\n", shard.number, shard.count, count(own, "run"),
                     there, there == 1 ? "is" : "are");
}

}  // namespace polhode::study
