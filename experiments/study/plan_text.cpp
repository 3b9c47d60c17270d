// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study {
namespace {

constexpr std::size_t most_values = 24;  // values of an axis that are printed

/// The values of one column, in the order in which they are met: the first ones, and how many there are.
class Values {
 public:
  void add(const std::string& value) {
    if (!value.empty() && seen_.insert(value).second && shown_.size() < most_values) shown_.push_back(rounded(value));
  }
  std::string text() const {
    std::string line;
    for (const std::string& value : shown_) line += (line.empty() ? "" : ", ") + value;
    return seen_.size() == shown_.size() ? line : line + fmt::format(", … ({} values)", seen_.size());
  }

 private:
  std::unordered_set<std::string> seen_;
  std::vector<std::string> shown_;
};

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

std::string plan_text(const Experiment& experiment, const Plan& plan, const std::filesystem::path& folder,
                      const std::vector<std::uint64_t>& done) {
  double cost = 0;
  std::size_t there = 0;
  std::vector<Unfinished> refused;
  const auto names = config_columns(plan.varied_keys, plan.named);
  std::vector<Values> values(names.size());
  Variants variants;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const PlannedRun run = plan.run(i, &variants);
    cost += plan.rows[i].cost;
    if (std::binary_search(done.begin(), done.end(), plan.rows[i].id)) ++there;
    if (!run.refusal.empty()) refused.push_back({"will be refused", run.refusal});
    const auto cells = config_cells(run.config, plan.named);
    for (std::size_t k = 0; k < names.size(); ++k) values[k].add(cells[k]);
  }
  std::string text = fmt::format("{}: {}, about {:.2g} right-hand sides, into {}\n", experiment.name,
                                 count(plan.size(), "run"), cost, folder.string());
  text += studies_text(plan);
  if (there > 0) text += fmt::format("{} of {} are there already\n", there, count(plan.size(), "run"));
  text += reasons(refused);
  if (experiment.refine) text += "further runs follow from the results of these\n";
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (const std::string line = values[k].text(); !line.empty()) text += fmt::format("  {:<15} {}\n", names[k], line);
  }
  for (const StudyCount& study : plan.studies) {
    for (const std::string& table : study.tables)
      text += fmt::format("  {}{}\n", study.name.empty() ? "" : study.name + ": ", table);
  }
  return text;
}

}  // namespace polhode::study
