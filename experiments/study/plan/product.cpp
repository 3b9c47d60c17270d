// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/product.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline plan {
namespace {

/// "all" methods without those that the study does not allow. To name one of these is an error.
void leave_out(StudyAxes& study, const std::function<bool(const Declaration&)>& unfit) {
  const auto said = study.axes.find("integrator");
  if (said == study.axes.end() || said->second != "all" || study.table_with("integrator")) return;
  std::string fitting;
  for (const OptionValue& name : axis_values(run_option("integrator"), said->second, study.label("integrator"))) {
    if (unfit(find_integrator(text_of(name))->declaration)) continue;
    fitting += (fitting.empty() ? "" : ",") + text_of(name);
  }
  said->second = fitting;
}

/// True if the study leaves the axis at its default, or has the value on it.
bool allows(const StudyAxes& study, const std::string& axis, const std::string& value) {
  const auto said = study.axes.find(axis);
  if (said == study.axes.end() || study.table_with(axis)) return true;
  const auto values = axis_values(run_option(axis), said->second, study.label(axis));
  return std::any_of(values.begin(), values.end(), [&](const OptionValue& v) { return text_of(v) == value; });
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

}  // namespace

Product::Product(const Experiment& experiment, const StudyAxes& study, bool reference)
    : experiment_(experiment), study_(study), reference_(reference) {
  check_durations(experiment, study_);
  for (const RunOption& option : run_options()) {
    if (option.needed) needed_.push_back(&option);
    if (option.preset) with_presets_.push_back(&option);
  }
  for (const Condition& condition : study_.where) conditions_.emplace_back(condition.text, condition.label);
  open_scenarios(dimensions(study_, true));
  const auto has_joints = [](const auto& one) { return !one->scenario->problem.joints.empty(); };
  // A method that solves the equations of joints itself needs some, and takes no stabilization.
  const bool fits_solvers =
      std::any_of(opened_.begin(), opened_.end(), has_joints) && allows(study_, "stabilization", "none");
  const bool always_joints = std::all_of(opened_.begin(), opened_.end(), has_joints);
  leave_out(study_, [&](const Declaration& method) {
    return (experiment.fixed_steps_only && method.adaptive) || (!fits_solvers && method.solves_joints()) ||
           (always_joints && method.refuses_joints);
  });
  counted_ = make_cells(true).count();
  const auto changes_motion = [](const DimensionKey& key) {
    return !key.option || key.option->role == RunOption::Role::scenario || key.option->name == "t-end";
  };
  for (const Dimension& dimension : dimensions(study_, true)) {
    if (std::any_of(dimension.keys.begin(), dimension.keys.end(), changes_motion))
      true_motions_ *= static_cast<double>(dimension.size);
  }
}

std::set<std::string> Product::varied_keys() const {
  std::set<std::string> keys;
  for (const auto& [key, text] : study_.vary) keys.insert(key);
  for (const PointTable& table : study_.tables) {
    for (const PointColumn& column : table.columns) {
      if (!is_option(column.key)) keys.insert(column.key);
    }
  }
  return keys;
}

Cells Product::make_cells(bool counted) {
  std::vector<Dimension> all = dimensions(study_, counted);
  return Cells(std::move(all), [this](const std::string& name) {
    const Opened& opened = *by_name_.at(name);
    return Cells::Start{start_of(opened, *opened.scenario), opened.scenario.get()};
  });
}

void Product::open_scenarios(const std::vector<Dimension>& dimensions) {
  const std::string label = study_.label("scenario");
  const std::set<std::string> varied = varied_keys();
  std::set<std::string> names;
  for (const Dimension& dimension : dimensions) {
    for (std::size_t k = 0; k < dimension.keys.size(); ++k) {
      const RunOption* option = dimension.keys[k].option;
      if (!option || option->role != RunOption::Role::scenario) continue;
      for (std::size_t point = 0; point < dimension.size; ++point) {
        const std::string name = text_of(dimension.value(point, k));
        if (by_name_.contains(name)) continue;
        ScenarioSource source = ScenarioSource::open(name, label);
        if (!names.insert(source.name()).second) throw InputError(label + ": '" + source.name() + "' is named twice");
        auto scenario = std::make_shared<const Scenario>(source.resolve());
        BoundConditions bound(conditions_, source, {varied.begin(), varied.end()});
        opened_.push_back(
            std::make_unique<Opened>(Opened{name, std::move(source), std::move(scenario), std::move(bound)}));
        by_name_[name] = opened_.back().get();
      }
    }
  }
  std::vector<const ScenarioSource*> sources;
  for (const auto& opened : opened_) sources.push_back(&opened->source);
  for (const Where& condition : conditions_) BoundConditions::check_keys(condition, sources);
}

RunConfig Product::start_of(const Opened& opened, const Scenario& scenario) const {
  RunConfig config;
  config.scenario = opened.source.name();
  const bool contact = !scenario.colliders.empty();
  config.reference = reference_ && !contact;
  if (contact) config.contact.emplace();
  if (!scenario.problem.joints.empty()) config.joints.emplace();
  return config;
}

/// The configuration of the cell without its varied keys. Options that the study does not give have the defaults of the
/// scenario.
RunConfig Product::configured(const Cell& cell, const Opened& opened, const Scenario& scenario) const {
  RunConfig config = start_of(opened, scenario);
  for (const RunOption& option : run_options()) {
    if (option.role == RunOption::Role::scenario || !option.applies_to(config)) continue;
    const auto given =
        std::find_if(cell.options.begin(), cell.options.end(), [&](const auto& o) { return o.first == &option; });
    const auto setting = study_.settings.find(option.name);
    if (given != cell.options.end()) option.set(config, given->second);
    else if (setting != study_.settings.end()) option.set(config, setting->second);
    else if (option.preset) option.set(config, option.preset(scenario));
  }
  return config;
}

/// configured(), with the duration that the experiment derives from the step.
RunConfig Product::completed(const Cell& cell, const Opened& opened, const Scenario& scenario) const {
  RunConfig config = configured(cell, opened, scenario);
  // check() refuses a run without a step.
  if (experiment_.duration && (config.tolerance || config.dt))
    config.t_end = experiment_.duration(config.t_end, config.tolerance ? *config.tolerance : *config.dt);
  return config;
}

/// completed(), which is made anew only if `last` does not have it, and put there.
RunConfig Product::completed(const Cell& cell, const Opened& opened, const Scenario& scenario,
                             LastOptions* last) const {
  if (!last) return completed(cell, opened, scenario);
  if (last->scenario != &opened || last->options != cell.options) {
    last->config = completed(cell, opened, scenario);
    last->options = cell.options;
    last->scenario = &opened;
  }
  return last->config;
}

/// `scenario`: that of the run, with the varied keys set.
bool Product::has_own_presets(const RunConfig& config, const Opened& opened, const Scenario& scenario) const {
  return std::any_of(with_presets_.begin(), with_presets_.end(), [&](const RunOption* option) {
    return option->applies_to(config) && option->preset(scenario) != option->preset(*opened.scenario);
  });
}

std::shared_ptr<const Scenario> Product::scenario_of(const Cell& cell, const Opened& opened) {
  if (cell.varied.empty()) return opened.scenario;
  return std::make_shared<const Scenario>(opened.source.resolve(cell.varied, opened.scenario.get()));
}

/// False: the conditions leave out the cell.
bool Product::holds(const Cells::Place& place, Conditions& conditions) const {
  if (conditions_.empty()) return true;
  const Opened& opened = *by_name_.at(cells_->scenario(place));
  const auto value_not_given = [&](const RunOption& option, const Cell& cell) {
    const RunConfig config = configured(cell, opened, *opened.scenario);
    return option.applies_to(config) ? option.value(config) : OptionValue{};
  };
  return conditions.try_emplace(&opened, opened.conditions).first->second.hold(*cells_, place, value_not_given);
}

/// Throws InputError if the run cannot have this configuration.
void Product::check(const RunConfig& config) const {
  if (experiment_.fixed_steps_only && find_integrator(config.integrator)->declaration.adaptive) {
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
}

void Product::open() { cells_.emplace(make_cells(false)); }

std::uint64_t Product::cells() const { return static_cast<std::uint64_t>(cells_->count()); }
std::vector<std::string> Product::tables() const { return cells_->tables(); }

Product::Part Product::for_each(std::span<const std::uint64_t> cells,
                                const std::function<void(std::uint64_t cell, Run&& run)>& use) const {
  Part part;
  Conditions conditions;
  std::vector<const RunOption*> without_effect;
  for (const RunOption& option : run_options()) {
    if (study_.has(option.name)) without_effect.push_back(&option);
  }
  // The last run: neighbouring cells mostly have its scenario, or all its options.
  Cell last;
  const Opened* opened = nullptr;
  std::shared_ptr<const Scenario> scenario;
  std::optional<RunConfig> config;  // without the varied keys; absent if some of these give options their defaults
  Cells::Place place;
  for (const std::uint64_t k : cells) {
    cells_->find(k, place);
    if (!holds(place, conditions)) {
      ++part.left_out;
      continue;
    }
    Cell cell = cells_->at(place);
    const Opened& of_cell = opened_of(cell);
    if (opened != &of_cell) scenario.reset(), config.reset();
    opened = &of_cell;
    if (!scenario || last.varied != cell.varied) scenario = scenario_of(cell, *opened);
    Run run;
    run.same_options = config && last.options == cell.options && !has_own_presets(*config, *opened, *scenario);
    if (run.same_options) {
      run.config = *config;
    } else {
      run.config = completed(cell, *opened, *scenario);
      check(run.config);
      run.own_presets = has_own_presets(run.config, *opened, *scenario);
      std::erase_if(without_effect, [&](const RunOption* option) {
        if (!option->applies_to(run.config)) return false;
        part.effective.insert(option->name);
        return true;
      });
      config.reset();
      if (!run.own_presets) config = run.config;
    }
    run.config.varied = cell.varied;
    run.scenario = scenario;
    last = std::move(cell);
    try {
      use(k, std::move(run));
    } catch (const std::invalid_argument& error) {
      throw InputError(study_.label("dt") + ": " + std::string(error.what()));
    }
  }
  return part;
}

void Product::refuse_empty() const {
  throw InputError(fmt::format("{}: it leaves out all {}; widen it, or the axes", conditions_.front().label(),
                               count(cells(), "cell")));
}

Product::Run Product::run(std::uint64_t cell, std::shared_ptr<const Scenario> scenario, LastOptions* last) const {
  Cell of = cells_->at(cell);
  const Opened& opened = opened_of(of);
  Run run;
  run.scenario = scenario ? std::move(scenario) : scenario_of(of, opened);
  run.config = completed(of, opened, *run.scenario, last);
  run.config.varied = std::move(of.varied);
  return run;
}

RunConfig Product::config(std::uint64_t cell, LastOptions* last) const {
  Cell of = cells_->at(cell);
  const Opened& opened = opened_of(of);
  RunConfig config = completed(of, opened, *opened.scenario, last);
  config.varied = std::move(of.varied);
  return config;
}

}  // namespace polhode::study::plan
