// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/versions.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/text_hash.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline plan {
namespace {

constexpr std::size_t most_runs = 10'000'000;

/// An option with its values in this study; no values if the study does not give it.
struct PlannedAxis {
  const RunOption* option;
  std::vector<OptionValue> values;
};

/// The methods of the study. "all" leaves out methods that the experiment does not allow; naming one is an error.
std::vector<OptionValue> fitting_methods(const Experiment& experiment, const Options& options,
                                         std::vector<OptionValue> chosen) {
  const auto fits = [&](const OptionValue& name) {
    return !experiment.fixed_steps_only || !find_integrator(std::get<std::string>(name))->declaration.adaptive;
  };
  if (options.axes.at("integrator") == "all") std::erase_if(chosen, [&](const OptionValue& n) { return !fits(n); });
  for (const OptionValue& name : chosen) {
    if (fits(name)) continue;
    throw InputError(fmt::format("{}: {} chooses its own steps, and {} is about steps; name methods that take --dt",
                                 options.label("integrator"), text_of(name), experiment.name));
  }
  return chosen;
}

/// Rejects several durations, and samples, if the experiment derives the duration of a run from its step.
void check_durations(const Experiment& experiment, const Options& options, const PlannedAxis& axis) {
  if (!experiment.duration) return;
  if (axis.option->name == "t-end" && axis.values.size() > 1) {
    throw InputError(fmt::format("{}: {} takes one, since its runs last as long as their steps have it",
                                 options.label("t-end"), experiment.name));
  }
  if (axis.option->name == "samples" && !axis.values.empty()) {
    throw InputError(
        fmt::format("{}: {} looks at every step; leave the option out", options.label("samples"), experiment.name));
  }
}

/// All axes except the scenario, in the order of the table of run options.
std::vector<PlannedAxis> read_axes(const Experiment& experiment, const Options& options) {
  std::vector<PlannedAxis> axes;
  for (const RunOption& option : run_options()) {
    if (option.role == RunOption::Role::scenario) continue;
    PlannedAxis axis{&option, axis_values(option, options)};
    if (option.role == RunOption::Role::method)
      axis.values = fitting_methods(experiment, options, std::move(axis.values));
    check_durations(experiment, options, axis);
    axes.push_back(std::move(axis));
  }
  return axes;
}

/// The product of the varied keys.
std::vector<std::vector<Override>> variants(const Options& options) {
  auto vary = options.vary;
  std::sort(vary.begin(), vary.end());
  std::vector<std::vector<Override>> all = {{}};
  for (const auto& [key, text] : vary) {
    std::vector<std::vector<Override>> longer;
    for (const auto& prefix : all) {
      const auto found = options.places.find("vary." + key);
      const std::string place = found == options.places.end() ? "" : found->second;
      for (const std::string& value : toml_values(text, Override{key, "", place}.label())) {
        longer.push_back(prefix);
        longer.back().push_back({key, value, place});
      }
    }
    all = std::move(longer);
    if (all.size() > most_runs) throw InputError("--vary: more than 10 million runs");
  }
  return all;
}

double cost_of(const RunConfig& config) {
  if (!config.dt) return 200 * config.t_end * (1 - std::log10(*config.tolerance));
  const int stages = std::max(1, find_integrator(config.integrator)->declaration.evaluations_per_step);
  return config.t_end / *config.dt * (stages + 1);
}

/// The run with its identity. Throws std::invalid_argument for an impossible step.
PlannedRun planned(const RunConfig& config, const std::shared_ptr<const Scenario>& scenario) {
  const std::string text = fmt::format("{}\n{}\n", results_version, scenario->canonical);
  RunConfig said = config;  // keys that this run does not change are not part of its identity
  std::erase_if(said.varied, [](const Override& o) { return o.value.empty(); });
  RunConfig motion = said;  // a reference does not change the motion
  motion.reference = false;
  return {.id = text_hash(text + identity_of(said)),
          .motion = text_hash(text + identity_of(motion)),
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

class Planner {
 public:
  Planner(const Experiment& experiment, const Options& options, bool reference)
      : experiment_(experiment),
        axes_(read_axes(experiment, options)),
        variants_(variants(options)),
        dt_label_(options.label("dt")),
        max_steps_(options.max_steps),
        reference_(reference) {
    for (const auto& [key, text] : options.vary) plan_.varied_keys.push_back(key);
    std::sort(plan_.varied_keys.begin(), plan_.varied_keys.end());
    for (const PlannedAxis& axis : axes_) {
      if (axis.option->on_demand && !axis.values.empty()) plan_.named.insert(axis.option->name);
    }
    std::set<std::string> seen;
    for (const std::string& name : split_list(options.axes.at("scenario"), ',', options.label("scenario"))) {
      const ScenarioSource source = ScenarioSource::open(name, options.label("scenario"));
      if (!seen.insert(source.name()).second)
        throw InputError(options.label("scenario") + ": '" + source.name() + "' is named twice");
      add_scenario(source);
    }
  }

  Plan finish() {
    std::sort(plan_.invariants.begin(), plan_.invariants.end());
    plan_.invariants.erase(std::unique(plan_.invariants.begin(), plan_.invariants.end()), plan_.invariants.end());
    return std::move(plan_);
  }

 private:
  void add_scenario(const ScenarioSource& source) {
    plan_.scenarios.push_back(source.resolve());
    for (const std::string& invariant : plan_.scenarios.back().invariants) plan_.invariants.push_back(invariant);
    for (const auto& variant : variants_) {
      const auto scenario = std::make_shared<const Scenario>(source.resolve(variant));
      RunConfig config;
      config.scenario = source.name();
      config.varied = variant;
      config.reference = reference_;
      if (!scenario->colliders.empty()) config.contact.emplace();
      add_product(std::move(config), scenario, 0);
    }
  }

  /// Adds the product of the axes from the k-th on; the options of earlier axes are set in config.
  void add_product(RunConfig config, const std::shared_ptr<const Scenario>& scenario, std::size_t k) {
    if (k == axes_.size()) return add_run(std::move(config), scenario);
    const auto& [option, values] = axes_[k];
    if (!option->applies_to(config)) return add_product(std::move(config), scenario, k + 1);
    if (values.empty()) {
      if (option->needed) throw InputError(config.integrator + " needs --" + option->name);
      if (option->preset) option->set(config, option->preset(*scenario));
      return add_product(std::move(config), scenario, k + 1);
    }
    for (const OptionValue& value : values) {
      RunConfig next = config;
      option->set(next, value);
      add_product(std::move(next), scenario, k + 1);
    }
  }

  void add_run(RunConfig config, const std::shared_ptr<const Scenario>& scenario) {
    if (config.tolerance) config.max_steps = max_steps_;
    if (experiment_.duration)
      config.t_end = experiment_.duration(config.t_end, config.tolerance ? *config.tolerance : *config.dt);
    add_planned(config, scenario);
  }

  void add_planned(const RunConfig& config, const std::shared_ptr<const Scenario>& scenario) {
    try {
      plan_.runs.push_back(planned(config, scenario));
    } catch (const std::invalid_argument& error) {
      throw InputError(dt_label_ + ": " + std::string(error.what()));
    }
    if (plan_.runs.size() > most_runs) throw InputError("more than 10 million runs; make the axes shorter");
  }

  const Experiment& experiment_;
  std::vector<PlannedAxis> axes_;
  std::vector<std::vector<Override>> variants_;
  std::string dt_label_;
  std::optional<std::int64_t> max_steps_;
  bool reference_;
  Plan plan_;
};

/// Adds the runs of another product of axes of the same experiment to the plan.
void add_plan(Plan& plan, Plan&& other) {
  for (Scenario& s : other.scenarios) {
    const auto same = [&](const Scenario& known) { return known.name == s.name; };
    if (std::none_of(plan.scenarios.begin(), plan.scenarios.end(), same)) plan.scenarios.push_back(std::move(s));
  }
  const auto unite = [](std::vector<std::string>& all, const std::vector<std::string>& more) {
    std::set<std::string> united(all.begin(), all.end());
    united.insert(more.begin(), more.end());
    all.assign(united.begin(), united.end());
  };
  unite(plan.varied_keys, other.varied_keys);
  unite(plan.invariants, other.invariants);
  plan.named.merge(other.named);
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

/// The options of a further product of axes.
Options further(const Experiment& experiment, const Options& options, const FurtherAxes& more) {
  Options other = options;
  for (const auto& [axis, text] : more.defaults) {
    const auto before = experiment.defaults.find(axis), now = options.axes.find(axis);
    const bool given =
        now != options.axes.end() && (before == experiment.defaults.end() || now->second != before->second);
    if (!given) other.axes[axis] = text;
  }
  if (!more.vary.empty()) other.vary = more.vary;
  return other;
}

/// Throws InputError if an axis is given that has no effect on any run.
void refuse_axes_without_effect(const Options& options, const std::vector<PlannedRun>& runs) {
  for (const RunOption& option : run_options()) {
    const auto matters = [&](const PlannedRun& run) { return option.applies_to(run.config); };
    if (!options.said.contains(option.name) || std::any_of(runs.begin(), runs.end(), matters)) continue;
    throw InputError(fmt::format("{}: it has no effect, because {}; leave it out, {}", options.label(option.name),
                                 option.no_effect, option.remedy));
  }
}

}  // namespace

Plan make_plan(const Experiment& experiment, const Options& options) {
  Plan plan = Planner(experiment, options, options.reference || experiment.reference).finish();
  for (const FurtherAxes& more : experiment.more) {
    if (more.by_default_only && !options.plain) continue;
    const Options other = further(experiment, options, more);
    plan.further_axes.push_back(other.axes);
    add_plan(plan, Planner(experiment, other, options.reference || more.reference).finish());
  }
  std::set<std::string> motions;  // runs of the same motion that come from several products are kept once
  std::erase_if(plan.runs, [&](const PlannedRun& run) { return !motions.insert(run.motion).second; });
  for (PlannedRun& run : plan.runs) fill_varied(run.config, plan.varied_keys);
  if (experiment.one_run && plan.runs.size() != 1) {
    throw InputError(fmt::format("{} makes one run, and this is {}; give each axis one value, or use energy_drift",
                                 experiment.name, plan.runs.size()));
  }
  refuse_axes_without_effect(options, plan.runs);
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
