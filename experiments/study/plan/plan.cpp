// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/plan/bound_conditions.hpp"
#include "experiments/study/plan/cells.hpp"
#include "experiments/study/plan/most_runs.hpp"
#include "experiments/study/plan/where.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/text_hash.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline plan {
namespace {

/// The study with the methods that the experiment allows. "all" leaves out the others; naming one is an error.
StudyAxes with_fitting_methods(const Experiment& experiment, StudyAxes study) {
  const auto said = study.axes.find("integrator");
  if (!experiment.fixed_steps_only || said == study.axes.end() || study.table_with("integrator")) return study;
  const bool all = said->second == "all";
  std::string fitting;
  for (const OptionValue& name : axis_values(run_option("integrator"), said->second, study.label("integrator"))) {
    if (all && find_integrator(text_of(name))->declaration.adaptive) continue;
    fitting += (fitting.empty() ? "" : ",") + text_of(name);
  }
  said->second = fitting;
  return study;
}

/// Rejects several durations, and samples, if the experiment derives the duration of a run from its step.
void check_durations(const Experiment& experiment, const StudyAxes& study) {
  if (!experiment.duration) return;
  const auto one = study.axes.find("t-end");
  if (study.table_with("t-end") || (one != study.axes.end() && count_values(one->second) > 1)) {
    throw InputError(fmt::format("{}: {} takes one, since its runs last as long as their steps have it",
                                 study.label("t-end"), experiment.name));
  }
  if (study.axes.contains("samples") || study.table_with("samples")) {
    throw InputError(
        fmt::format("{}: {} looks at every step; leave the option out", study.label("samples"), experiment.name));
  }
}

double cost_of(const RunConfig& config) {
  if (!config.dt) return 200 * config.t_end * (1 - std::log10(*config.tolerance));
  const int stages = std::max(1, find_integrator(config.integrator)->declaration.evaluations_per_step);
  return config.t_end / *config.dt * (stages + 1);
}

/// The run with its identity. Throws std::invalid_argument for an impossible step.
PlannedRun planned(const RunConfig& config, const std::shared_ptr<const Scenario>& scenario) {
  RunConfig motion = config;  // a reference does not change the motion
  motion.reference = false;
  return {.id = run_id(config, scenario->canonical),
          .motion = run_id(motion, scenario->canonical),
          .config = config,
          .scenario = scenario,
          .refusal = refusal(config, *scenario),
          .cost = cost_of(config)};
}

void sort_by_configuration(std::vector<PlannedRun>& runs) {
  std::vector<std::pair<std::vector<OptionValue>, std::size_t>> keys;
  for (std::size_t i = 0; i < runs.size(); ++i) keys.emplace_back(sort_key(runs[i].config), i);
  std::sort(keys.begin(), keys.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : runs[a.second].id < runs[b.second].id;
  });
  std::vector<PlannedRun> sorted;
  for (const auto& [key, i] : keys) sorted.push_back(std::move(runs[i]));
  runs = std::move(sorted);
}

/// Plans the cells of one product of axes and tables.
class Planner {
 public:
  Planner(const Experiment& experiment, const StudyAxes& study, const Options& options, bool reference)
      : experiment_(experiment),
        study_(with_fitting_methods(experiment, study)),
        max_steps_(options.max_steps),
        reference_(reference) {
    check_durations(experiment, study_);
    for (const RunOption& option : run_options()) {
      if (option.needed) needed_.push_back(&option);
      if (study_.has(option.name)) without_effect_.push_back(&option);
    }
    for (const Condition& condition : study_.where) conditions_.emplace_back(condition.text, condition.label);
    counted_ = cells(true).count();
  }

  /// The number of cells, not less than the true one: values that are given twice count twice.
  double most_cells() const { return counted_; }

  /// Makes the runs. Adds to `effective` the names of all options that affect one.
  Plan runs(std::set<std::string>& effective) {
    const Cells all = cells(false);
    StudyCount count{study_.name, static_cast<std::size_t>(all.count()), 0, all.tables()};
    for (const std::string& key : varied_keys()) plan_.varied_keys.push_back(key);
    for (const RunOption& option : run_options()) {
      if (option.on_demand && study_.has(option.name)) plan_.named.insert(option.name);
    }
    for (std::size_t k = 0; k < count.cells; ++k) {
      if (!add_cell(all.at(k), effective)) ++count.left_out;
    }
    if (count.left_out == count.cells) {
      throw InputError(fmt::format("{}: it leaves out all {}; widen it, or the axes", conditions_.front().label(),
                                   study::count(count.cells, "cell")));
    }
    plan_.studies.push_back(std::move(count));
    std::sort(plan_.invariants.begin(), plan_.invariants.end());
    plan_.invariants.erase(std::unique(plan_.invariants.begin(), plan_.invariants.end()), plan_.invariants.end());
    return std::move(plan_);
  }

 private:
  struct Opened {
    ScenarioSource source;
    std::shared_ptr<const Scenario> scenario;  ///< without overrides
    BoundConditions conditions;
  };

  std::set<std::string> varied_keys() const {
    std::set<std::string> keys;
    for (const auto& [key, text] : study_.vary) keys.insert(key);
    for (const PointTable& table : study_.tables) {
      for (const PointColumn& column : table.columns) {
        if (!is_option(column.key)) keys.insert(column.key);
      }
    }
    return keys;
  }

  Cells cells(bool counted) {
    std::vector<Dimension> all = dimensions(study_, counted);
    if (opened_.empty()) open_scenarios(all);
    return Cells(std::move(all), [this](const std::string& name) {
      const Opened& opened = opened_.at(name);
      return Cells::Start{start_of(opened.source, *opened.scenario), opened.scenario.get()};
    });
  }

  /// Opens all scenarios of the study, in their order.
  void open_scenarios(const std::vector<Dimension>& all) {
    const std::string label = study_.label("scenario");
    std::set<std::string> names;
    for (const Dimension& dimension : all) {
      for (std::size_t k = 0; k < dimension.keys.size(); ++k) {
        const RunOption* option = dimension.keys[k].option;
        if (!option || option->role != RunOption::Role::scenario) continue;
        for (std::size_t point = 0; point < dimension.size; ++point) {
          const std::string name = text_of(dimension.value(point, k));
          if (opened_.contains(name)) continue;
          ScenarioSource source = ScenarioSource::open(name, label);
          if (!names.insert(source.name()).second) throw InputError(label + ": '" + source.name() + "' is named twice");
          open(name, std::move(source));
        }
      }
    }
    for (const Where& condition : conditions_) BoundConditions::check_keys(condition, sources());
  }

  void open(const std::string& name, ScenarioSource source) {
    auto scenario = std::make_shared<const Scenario>(source.resolve());
    plan_.scenarios.push_back(*scenario);
    plan_.scenario_names.push_back(name);
    for (const std::string& invariant : scenario->invariants) plan_.invariants.push_back(invariant);
    const std::set<std::string> varied = varied_keys();
    BoundConditions bound(conditions_, source, {varied.begin(), varied.end()});
    opened_.emplace(name, Opened{std::move(source), std::move(scenario), std::move(bound)});
  }

  std::vector<const ScenarioSource*> sources() const {
    std::vector<const ScenarioSource*> all;
    for (const auto& [name, opened] : opened_) all.push_back(&opened.source);
    return all;
  }

  RunConfig start_of(const ScenarioSource& source, const Scenario& scenario) const {
    RunConfig config;
    config.scenario = source.name();
    config.reference = reference_;
    if (!scenario.colliders.empty()) config.contact.emplace();
    return config;
  }

  /// The configuration of the cell. Options that the study does not give have the defaults of the scenario.
  RunConfig configured(const Cell& cell, const ScenarioSource& source, const Scenario& scenario) const {
    RunConfig config = start_of(source, scenario);
    config.varied = cell.varied;
    for (const RunOption& option : run_options()) {
      if (option.role == RunOption::Role::scenario || !option.applies_to(config)) continue;
      const auto given =
          std::find_if(cell.options.begin(), cell.options.end(), [&](const auto& o) { return o.first == &option; });
      if (given != cell.options.end()) option.set(config, given->second);
      else if (option.preset) option.set(config, option.preset(scenario));
    }
    return config;
  }

  /// The scenario with the varied keys of the cell. Neighbouring cells mostly have the same.
  const std::shared_ptr<const Scenario>& variant(const Cell& cell, const ScenarioSource& source) {
    if (!variant_ || variant_of_ != &source || variant_keys_ != cell.varied) {
      variant_ = std::make_shared<const Scenario>(source.resolve(cell.varied));
      variant_of_ = &source;
      variant_keys_ = cell.varied;
    }
    return variant_;
  }

  /// Adds the run of the cell. False: the conditions leave it out.
  bool add_cell(const Cell& cell, std::set<std::string>& effective) {
    const Opened& opened = opened_.at(cell.scenario);
    if (!conditions_.empty()) {
      const RunConfig config = configured(cell, opened.source, *opened.scenario);
      if (!opened.conditions.hold(cell, config)) return false;
    }
    const auto& scenario = variant(cell, opened.source);
    RunConfig config = configured(cell, opened.source, *scenario);
    const bool adaptive = find_integrator(config.integrator)->declaration.adaptive;
    if (experiment_.fixed_steps_only && adaptive) {
      throw InputError(fmt::format("{}: {} chooses its own steps, and {} is about steps; name methods that take --dt",
                                   study_.label("integrator"), config.integrator, experiment_.name));
    }
    for (const RunOption* option : needed_) {
      if (!option->applies_to(config) || option->value(config) != OptionValue{}) continue;
      if (!study_.table_with(option->name)) throw InputError(config.integrator + " needs --" + option->name);
      throw InputError(
          fmt::format("{}: {} needs it, and a row leaves it empty; fill it in, or leave the cell out with "
                      "where: given({})",
                      study_.label(option->name), config.integrator, option->name));
    }
    std::erase_if(without_effect_, [&](const RunOption* option) {
      if (!option->applies_to(config)) return false;
      effective.insert(option->name);
      return true;
    });
    if (config.tolerance) config.max_steps = max_steps_;
    if (experiment_.duration)
      config.t_end = experiment_.duration(config.t_end, config.tolerance ? *config.tolerance : *config.dt);
    try {
      plan_.runs.push_back(planned(config, scenario));
    } catch (const std::invalid_argument& error) {
      throw InputError(study_.label("dt") + ": " + std::string(error.what()));
    }
    return true;
  }

  const Experiment& experiment_;
  StudyAxes study_;
  std::optional<std::int64_t> max_steps_;
  bool reference_;
  std::vector<const RunOption*> needed_;
  std::vector<const RunOption*> without_effect_;  // options of the study that have affected no run yet
  std::vector<Where> conditions_;
  std::map<std::string, Opened> opened_;  // by the name that the study says
  double counted_ = 0;
  std::shared_ptr<const Scenario> variant_;  // the last one
  const ScenarioSource* variant_of_ = nullptr;
  std::vector<Override> variant_keys_;
  Plan plan_;
};

/// Adds the runs of another product of axes of the same experiment to the plan.
void add_plan(Plan& plan, Plan&& other) {
  for (Scenario& s : other.scenarios) {
    const auto known = std::find_if(plan.scenarios.begin(), plan.scenarios.end(),
                                    [&](const Scenario& other_one) { return other_one.name == s.name; });
    if (known == plan.scenarios.end()) plan.scenarios.push_back(std::move(s));
    else if (known->canonical != s.canonical)
      throw InputError("two files are both named " + s.name + ".toml; rename one of them");
  }
  const auto unite = [](std::vector<std::string>& all, const std::vector<std::string>& more) {
    std::set<std::string> united(all.begin(), all.end());
    united.insert(more.begin(), more.end());
    all.assign(united.begin(), united.end());
  };
  unite(plan.varied_keys, other.varied_keys);
  for (std::string& name : other.scenario_names) {
    auto& names = plan.scenario_names;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  unite(plan.invariants, other.invariants);
  plan.named.merge(other.named);
  plan.studies.insert(plan.studies.end(), other.studies.begin(), other.studies.end());
  std::move(other.runs.begin(), other.runs.end(), std::back_inserter(plan.runs));
}

/// Adds an empty value for each key that the product of the run does not vary, and sorts the values by `keys`.
void fill_varied(RunConfig& config, const std::vector<std::string>& keys) {
  std::vector<Override> varied;
  for (const std::string& key : keys) {
    const auto own =
        std::find_if(config.varied.begin(), config.varied.end(), [&](const Override& o) { return o.key == key; });
    varied.push_back(own == config.varied.end() ? Override{key, ""} : *own);
  }
  config.varied = std::move(varied);
}

/// The study with the defaults of a further product of axes.
StudyAxes further(const Experiment& experiment, const StudyAxes& study, const FurtherAxes& more) {
  StudyAxes other = study;
  for (const auto& [axis, text] : more.defaults) {
    const auto before = experiment.defaults.find(axis), now = study.axes.find(axis);
    const bool given =
        now != study.axes.end() && (before == experiment.defaults.end() || now->second != before->second);
    if (!given && !study.table_with(axis)) other.axes[axis] = text;
  }
  if (!more.vary.empty()) other.vary = more.vary;
  return other;
}

/// Throws InputError if one of the options affects no run.
void refuse_without_effect(const StudyAxes& study, const std::set<std::string>& said,
                           const std::set<std::string>& effective) {
  for (const RunOption& option : run_options()) {
    if (!said.contains(option.name) || effective.contains(option.name)) continue;
    throw InputError(fmt::format("{}: it has no effect, because {}; leave it out, {}", study.label(option.name),
                                 option.no_effect, option.remedy));
  }
}

/// All products of axes of a study.
std::vector<Planner> planners_of(const Experiment& experiment, const Options& options, const StudyAxes& study,
                                 Plan& plan) {
  std::vector<Planner> planners;
  planners.emplace_back(experiment, study, options, study.reference || experiment.reference);
  for (const FurtherAxes& more : experiment.more) {
    if (more.by_default_only && !options.plain) continue;
    const StudyAxes other = further(experiment, study, more);
    plan.further_axes.push_back(other.axes);
    planners.emplace_back(experiment, other, options, study.reference || more.reference);
  }
  return planners;
}

}  // namespace

Plan make_plan(const Experiment& experiment, const Options& options) {
  Plan plan;
  double cells = 0;
  std::vector<std::vector<Planner>> planners;
  for (const StudyAxes& study : options.studies) {
    planners.push_back(planners_of(experiment, options, study, plan));
    for (const Planner& planner : planners.back()) cells += planner.most_cells();
  }
  if (cells > static_cast<double>(most_runs)) {
    throw InputError(fmt::format("{} runs are more than the 10 million that a study may have; make the axes shorter",
                                 cells < 1e15 ? fmt::format("{:.0f}", cells) : fmt::format("{:.2g}", cells)));
  }
  std::set<std::string> effective;
  for (std::size_t i = 0; i < planners.size(); ++i) {
    const StudyAxes& study = options.studies[i];
    std::set<std::string> own;
    for (Planner& planner : planners[i]) add_plan(plan, planner.runs(own));
    refuse_without_effect(study, study.said, own);
    effective.merge(own);
  }
  refuse_without_effect(options.studies.front(), options.shared, effective);
  std::set<std::string> motions;  // runs of the same motion that come from several products are kept once
  std::erase_if(plan.runs, [&](const PlannedRun& run) { return !motions.insert(run.motion).second; });
  for (PlannedRun& run : plan.runs) fill_varied(run.config, plan.varied_keys);
  if (experiment.one_run && plan.runs.size() != 1) {
    throw InputError(fmt::format("{} makes one run, and this is {}; give each axis one value, or use energy_drift",
                                 experiment.name, plan.runs.size()));
  }
  const auto sense = [](const PlannedRun& r) { return r.refusal.empty(); };
  sort_by_configuration(plan.runs);
  if (std::none_of(plan.runs.begin(), plan.runs.end(), sense)) {
    throw InputError(plan.runs.front().config.integrator + " on " + plan.runs.front().config.scenario + ": " +
                     plan.runs.front().refusal);
  }
  std::string all;
  for (const PlannedRun& run : plan.runs) all += run.id;
  plan.identity = text_hash(all);
  return plan;
}

std::size_t widen(Plan& plan, const std::vector<RunConfig>& configs) {
  std::set<std::string> ids;
  for (const PlannedRun& run : plan.runs) ids.insert(run.id);
  std::vector<PlannedRun> added;
  for (const RunConfig& config : configs) {
    const auto like = std::find_if(plan.runs.begin(), plan.runs.end(), [&](const PlannedRun& run) {
      return run.config.scenario == config.scenario && run.config.varied == config.varied;
    });
    if (like == plan.runs.end()) throw std::logic_error("a further run of a scenario that the study does not have");
    PlannedRun run = planned(config, like->scenario);
    if (ids.insert(run.id).second) added.push_back(std::move(run));
  }
  for (PlannedRun& run : added) plan.runs.push_back(std::move(run));
  if (!added.empty()) sort_by_configuration(plan.runs);
  return added.size();
}

}  // namespace polhode::study::plan
