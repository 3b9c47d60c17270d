// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/plan.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>

#include "collision/broad_phase.hpp"
#include "collision/contact/impact_timing.hpp"
#include "collision/narrow_phase.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/scenario/narrow_phase_choice.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study {
namespace {

/// Raised whenever a change of the code changes a digit of a result: stored runs of an older version are then made
/// anew.
constexpr int results_version = 4;
constexpr std::size_t most_runs = 10'000'000;
constexpr std::size_t most_listed = 20;  // names in an error

std::string hash(std::string_view text) { return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size())); }

/// The items of an axis whose values are names.
std::vector<std::string> names(const Options& options, const std::string& axis, const std::vector<std::string>& known) {
  const auto found = options.axes.find(axis);
  if (found == options.axes.end()) return {};
  std::vector<std::string> items;
  for (const std::string& item : split_list(found->second, ',', options.label(axis))) {
    if (std::find(known.begin(), known.end(), item) == known.end()) {
      if (known.empty())
        throw InputError(options.label(axis) + ": there is none in this version; leave the option out");
      const std::vector<std::string_view> all(known.begin(), known.end());
      throw InputError(options.label(axis) + ": no '" + item + "'" +
                       (all.size() > most_listed ? suggestion_of_many(item, all, "--list " + axis + "s")
                                                 : suggestion(item, "There are", all)));
    }
    if (std::find(items.begin(), items.end(), item) == items.end()) items.push_back(item);
  }
  return items;
}

template <class T>
std::vector<T> choices(const Options& options, const std::string& axis,
                       const std::vector<std::pair<std::string, T>>& all, T preset) {
  std::vector<std::string> known;
  for (const auto& [text, value] : all) known.push_back(text);
  std::vector<T> values;
  for (const std::string& item : names(options, axis, known)) {
    for (const auto& [text, value] : all) {
      if (text == item) values.push_back(value);
    }
  }
  if (values.empty()) values.push_back(preset);
  return values;
}

std::vector<double> positive(const Options& options, const std::string& axis, const char* unit) {
  const auto found = options.axes.find(axis);
  if (found == options.axes.end()) return {};
  std::vector<double> values = numbers(found->second, options.label(axis));
  for (const double x : values) {
    if (x > 0) continue;
    throw InputError(
        fmt::format("{}: {} is not positive; it must be a positive number{}", options.label(axis), x, unit));
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// The values of all axes but the scenario's.
struct Axes {
  std::vector<std::string> integrators;
  std::vector<Orientation> orientations;
  std::vector<AngularState> angular_states;
  std::vector<bool> gyroscopic, normalise;
  std::vector<RotationFrom> rotation_from;
  std::vector<Precision> precisions;
  std::vector<int> orders;
  std::vector<std::optional<Summation>> summations;
  std::vector<double> steps, tolerances, durations;
  std::vector<std::optional<std::int64_t>> samples;
  std::vector<std::string> broad_phases, narrow_phases, responses, impact_timings;
};

/// The names of an axis, among those of a catalogue; `otherwise` where the study does not speak of it (empty: by the
/// scenario).
template <class Entry>
std::vector<std::string> catalogue_names(const Options& options, const char* axis, const std::vector<Entry>& catalogue,
                                         const char* otherwise) {
  std::vector<std::string> known;
  for (const Entry& entry : catalogue) known.push_back(entry.name);
  const auto found = options.axes.find(axis);
  if (found == options.axes.end()) return {otherwise};
  return found->second == "all" ? known : names(options, axis, known);
}

std::vector<std::string> integrator_names(const Experiment& experiment, const Options& options) {
  std::vector<std::string> known, fitting;
  for (const IntegratorEntry& e : integrator_catalogue()) {
    known.push_back(e.declaration.name);
    if (!e.declaration.adaptive || !experiment.fixed_steps_only) fitting.push_back(e.declaration.name);
  }
  if (options.axes.at("integrator") == "all") return fitting;
  const auto chosen = names(options, "integrator", known);
  for (const std::string& name : chosen) {
    if (std::find(fitting.begin(), fitting.end(), name) != fitting.end()) continue;
    throw InputError(fmt::format("{}: {} chooses its own steps, and {} is about steps; name methods that take --dt",
                                 options.label("integrator"), name, experiment.name));
  }
  return chosen;
}

Axes read_axes(const Experiment& experiment, const Options& options) {
  Axes axes;
  axes.integrators = integrator_names(experiment, options);
  axes.orientations = choices<Orientation>(options, "orientation",
                                           {{"quaternion", Orientation::quaternion}, {"matrix", Orientation::matrix}},
                                           Orientation::quaternion);
  axes.angular_states = choices<AngularState>(options, "angular-state",
                                              {{"velocity_world", AngularState::velocity_world},
                                               {"velocity_body", AngularState::velocity_body},
                                               {"momentum_world", AngularState::momentum_world}},
                                              AngularState::velocity_world);
  axes.gyroscopic = choices<bool>(options, "gyroscopic", {{"on", true}, {"off", false}}, true);
  axes.normalise = choices<bool>(options, "normalize", {{"never", false}, {"step", true}}, false);
  axes.rotation_from = choices<RotationFrom>(
      options, "rotation-from", {{"normalised", RotationFrom::normalised}, {"stored", RotationFrom::stored}},
      RotationFrom::normalised);
  axes.precisions = choices<Precision>(
      options, "precision",
      {{"float", Precision::single}, {"double", Precision::dual}, {"long_double", Precision::extended}},
      Precision::dual);
  axes.summations = choices<std::optional<Summation>>(
      options, "summation", {{"plain", Summation::plain}, {"compensated", Summation::compensated}}, std::nullopt);
  for (const double n : positive(options, "order", "")) {
    if (n != std::floor(n) || n > 100)
      throw InputError(fmt::format("{}: {} is not an order", options.label("order"), n));
    axes.orders.push_back(static_cast<int>(n));
  }
  axes.steps = positive(options, "dt", " of seconds");
  axes.tolerances = positive(options, "tolerance", "");
  for (const double x : axes.tolerances) {
    if (x < 1) continue;
    throw InputError(fmt::format("{}: {} is too large; it must be below 1", options.label("tolerance"), x));
  }
  axes.durations = positive(options, "t-end", " of seconds");
  if (experiment.duration && axes.durations.size() > 1) {
    throw InputError(fmt::format("{}: {} takes one, since its runs last as long as their steps have it",
                                 options.label("t-end"), experiment.name));
  }
  for (const double n : positive(options, "samples", "")) {
    if (n != std::floor(n) || n > 1e9) {
      throw InputError(fmt::format("{}: {} is not a whole number below 1e9", options.label("samples"), n));
    }
    axes.samples.emplace_back(static_cast<std::int64_t>(n));
  }
  if (experiment.duration && !axes.samples.empty()) {
    throw InputError(
        fmt::format("{}: {} looks at every step; leave the option out", options.label("samples"), experiment.name));
  }
  if (axes.samples.empty()) axes.samples.emplace_back(std::nullopt);
  axes.broad_phases = catalogue_names(options, "broad-phase", broad_phase_catalogue(), "sweep_and_prune");
  axes.narrow_phases = catalogue_names(options, "narrow-phase", narrow_phase_catalogue(), "");
  axes.responses = catalogue_names(options, "response", response_catalogue(), "sequential_impulses");
  axes.impact_timings = catalogue_names(options, "impact-timing", impact_timing_catalogue(), "time_stepping");
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

std::string on_off(bool on) { return on ? "on" : "off"; }

/// Numbers in numerical order, texts after them in alphabetical order, empty cells first.
bool cell_less(const std::string& a, const std::string& b) {
  double x = 0, y = 0;
  const auto number = [](const std::string& s, double& v) {
    const auto r = std::from_chars(s.data(), s.data() + s.size(), v);
    return !s.empty() && r.ec == std::errc() && r.ptr == s.data() + s.size();
  };
  const bool a_number = number(a, x), b_number = number(b, y);
  if (a_number && b_number && x != y) return x < y;
  if (a_number != b_number && !a.empty() && !b.empty()) return a_number;
  return a < b;
}

double cost_of(const RunConfig& config) {
  if (!config.dt) return 200 * config.t_end * (1 - std::log10(*config.tolerance));
  const int stages = std::max(1, find_integrator(config.integrator)->declaration.evaluations_per_step);
  return config.t_end / *config.dt * (stages + 1);
}

/// The run with its identity. Throws std::invalid_argument on an impossible step.
PlannedRun planned(const RunConfig& config, const std::shared_ptr<const Scenario>& scenario) {
  std::string text = fmt::format("{}\n{}\n", results_version, scenario->canonical);
  RunConfig said = config;  // a key that this run leaves as it is, is none of its own; nor what was always so
  std::erase_if(said.varied, [](const Override& o) { return o.value.empty(); });
  said.order.reset();
  said.summation.reset();
  for (const std::string& cell : config_cells(said)) text += cell + "\n";
  if (config.samples) text += std::to_string(*config.samples);
  if (config.order.value_or(0) > 0) text += fmt::format("\norder {}", *config.order);
  if (is_compensated(config)) text += "\ncompensated";
  if (config.max_steps) text += fmt::format("\nmax_steps {}", *config.max_steps);
  return {.id = hash(config.reference ? text + "\nreference" : text),
          .motion = hash(text),
          .config = config,
          .scenario = scenario,
          .refusal = refusal(config, *scenario),
          .cost = cost_of(config)};
}

void sort_by_configuration(std::vector<PlannedRun>& runs) {
  std::vector<std::pair<std::vector<std::string>, std::size_t>> keys;
  for (std::size_t i = 0; i < runs.size(); ++i) keys.emplace_back(config_cells(runs[i].config), i);
  std::sort(keys.begin(), keys.end(), [&](const auto& a, const auto& b) {
    for (std::size_t k = 0; k < a.first.size(); ++k) {
      if (a.first[k] != b.first[k]) return cell_less(a.first[k], b.first[k]);
    }
    return runs[a.second].id < runs[b.second].id;
  });
  std::vector<PlannedRun> sorted;
  for (const auto& [cells, i] : keys) sorted.push_back(std::move(runs[i]));
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
    plan_.named = {.order = !axes_.orders.empty(), .summation = axes_.summations.front().has_value()};
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
      for (const std::string& name : axes_.integrators) {
        config.integrator = name;
        add_formulations(config, scenario);
      }
    }
  }

  void add_formulations(RunConfig config, const std::shared_ptr<const Scenario>& scenario) {
    for (const Orientation o : axes_.orientations) {
      for (const AngularState a : axes_.angular_states) {
        for (const bool g : axes_.gyroscopic) {
          for (const RotationFrom r : axes_.rotation_from) {
            // A matrix is used as stored: the axis means nothing to it.
            config.formulation = {o, a, g, o == Orientation::matrix ? RotationFrom::normalised : r};
            add_settings(config, scenario);
          }
        }
      }
    }
  }

  void add_settings(RunConfig config, const std::shared_ptr<const Scenario>& scenario) {
    const Declaration& declared = find_integrator(config.integrator)->declaration;
    const bool adaptive = declared.adaptive;
    std::vector<std::optional<int>> orders(axes_.orders.begin(), axes_.orders.end());
    if (orders.empty()) orders = {std::nullopt};
    else if (declared.highest_order == 0) orders = {0};
    const std::vector<double>& sizes = adaptive ? axes_.tolerances : axes_.steps;
    if (sizes.empty()) throw InputError(config.integrator + " needs " + (adaptive ? "--tolerance" : "--dt"));
    const std::vector<double> durations =
        axes_.durations.empty() ? std::vector<double>{scenario->t_end} : axes_.durations;
    for (const bool normalise : axes_.normalise) {
      for (const Precision precision : axes_.precisions) {
        for (const auto& summation : axes_.summations) {
          config.normalise = normalise;
          config.precision = precision;
          config.summation = summation;
          for (const auto& order : orders) {
            config.order = order;
            for (const double size : sizes) {
              for (const double t_end : durations) {
                for (const auto& samples : axes_.samples) {
                  (adaptive ? config.tolerance : config.dt) = size;
                  if (adaptive) config.max_steps = max_steps_;
                  config.t_end = experiment_.duration ? experiment_.duration(t_end, size) : t_end;
                  config.samples = samples;
                  add_run(config, scenario);
                }
              }
            }
          }
        }
      }
    }
  }

  void add_run(RunConfig config, const std::shared_ptr<const Scenario>& scenario) {
    if (scenario->colliders.empty()) return add_planned(config, scenario);
    for (const std::string& broad : axes_.broad_phases) {
      for (const std::string& said : axes_.narrow_phases) {
        const std::string narrow = said.empty() ? narrow_phase_for(*scenario) : said;
        for (const std::string& response : axes_.responses) {
          for (const std::string& timing : axes_.impact_timings) {
            // To a response that is a force the axis means nothing.
            config.contact = ContactConfig{broad, narrow, response, find_response(response)->make ? timing : ""};
            add_planned(config, scenario);
          }
        }
      }
    }
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
  Axes axes_;
  std::vector<std::vector<Override>> variants_;
  std::string dt_label_;
  std::optional<std::int64_t> max_steps_;
  bool reference_;
  Plan plan_;
};

/// Adds another product of axes of the same experiment.
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
  std::move(other.runs.begin(), other.runs.end(), std::back_inserter(plan.runs));
}

/// A run has an empty value for a key that its own product does not vary.
void fill_varied(RunConfig& config, const std::vector<std::string>& keys) {
  std::vector<Override> varied;
  for (const std::string& key : keys) {
    const auto own =
        std::find_if(config.varied.begin(), config.varied.end(), [&](const Override& o) { return o.key == key; });
    varied.push_back(own == config.varied.end() ? Override{key, ""} : *own);
  }
  config.varied = std::move(varied);
}

/// The same experiment with a further product of axes in the place of the first.
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

/// An axis that some runs leave aside, to which of them it means something, why it may mean nothing to any, and what
/// then to do but leave it out.
struct PartialAxis {
  const char* name;
  bool (*matters)(const RunConfig&);
  const char *reason, *remedy;
};

bool has_contact(const RunConfig& c) { return c.contact.has_value(); }

constexpr const char *no_contact = "no scenario here has contact = true",
                     *take_contact = "or take a scenario with contact";
constexpr PartialAxis partial_axes[] = {
    {"dt", [](const RunConfig& c) { return c.dt.has_value(); },
     "every method here chooses its own steps, by --tolerance", "or name a method of a fixed step"},
    {"tolerance", [](const RunConfig& c) { return c.tolerance.has_value(); },
     "every method here has a fixed step, --dt", "or name a method that chooses its own steps"},
    {"order", [](const RunConfig& c) { return c.order.value_or(0) > 0; }, "no method here offers several orders",
     "or name one that does, such as arkode_erk"},
    {"rotation-from", [](const RunConfig& c) { return c.formulation.orientation == Orientation::quaternion; },
     "a matrix is used as it is stored", "or take --orientation quaternion"},
    {"broad-phase", has_contact, no_contact, take_contact},
    {"narrow-phase", has_contact, no_contact, take_contact},
    {"response", has_contact, no_contact, take_contact},
    {"impact-timing", [](const RunConfig& c) { return c.contact && !c.contact->impact_timing.empty(); },
     "no run here answers impacts one by one", "or take a scenario with contact and a response other than compliant"}};

/// An axis that was asked for and changes no run is a misunderstanding.
void refuse_axes_without_effect(const Options& options, const std::vector<PlannedRun>& runs) {
  for (const PartialAxis& axis : partial_axes) {
    const auto matters = [&](const PlannedRun& run) { return axis.matters(run.config); };
    if (!options.said.contains(axis.name) || std::any_of(runs.begin(), runs.end(), matters)) continue;
    throw InputError(fmt::format("{}: it has no effect, because {}; leave it out, {}", options.label(axis.name),
                                 axis.reason, axis.remedy));
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
  std::set<std::string> motions;  // the same run by another way: counted once
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
  plan.identity = hash(all);
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

std::vector<std::string> config_columns(const std::vector<std::string>& varied_keys, const NamedOptions& named) {
  std::vector<std::string> columns = {"scenario",  "integrator",    "orientation",  "angular_state", "gyroscopic",
                                      "normalize", "rotation_from", "precision",    "dt_s",          "tolerance",
                                      "t_end_s",   "broad_phase",   "narrow_phase", "response",      "impact_timing"};
  if (named.order) columns.emplace_back("order");
  if (named.summation) columns.emplace_back("summation");
  columns.insert(columns.end(), varied_keys.begin(), varied_keys.end());
  return columns;
}

std::vector<std::string> config_cells(const RunConfig& config) {
  const Formulation& f = config.formulation;
  std::vector<std::string> cells = {config.scenario,
                                    config.integrator,
                                    std::string(name(f.orientation)),
                                    std::string(name(f.angular_state)),
                                    on_off(f.gyroscopic),
                                    config.normalise ? "step" : "never",
                                    f.orientation == Orientation::quaternion ? std::string(name(f.rotation_from)) : "",
                                    std::string(name(config.precision)),
                                    config.dt ? exact(*config.dt) : "",
                                    config.tolerance ? exact(*config.tolerance) : "",
                                    exact(config.t_end)};
  const ContactConfig contact = config.contact.value_or(ContactConfig{});
  cells.insert(cells.end(), {contact.broad_phase, contact.narrow_phase, contact.response, contact.impact_timing});
  if (config.order) cells.push_back(*config.order == 0 ? "" : std::to_string(*config.order));
  if (config.summation) cells.emplace_back(name(*config.summation));
  for (const Override& o : config.varied) cells.push_back(o.value);
  return cells;
}

}  // namespace polhode::study
