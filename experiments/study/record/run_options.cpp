// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/run_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "collision/broad_phase.hpp"
#include "collision/contact/impact_timing.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/response.hpp"
#include "core/run/integrator.hpp"
#include "experiments/study/scenario/narrow_phase_choice.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline record {
namespace {

using Kind = RunOption::Kind;
using Role = RunOption::Role;

template <class T>
using Names = std::vector<std::pair<std::string, T>>;

template <class T>
Names<T> names_of(std::initializer_list<T> values) {
  Names<T> names;
  for (const T value : values) names.emplace_back(std::string(name(value)), value);
  return names;
}

/// An option with few values. `member` returns a reference to its value in a RunConfig.
template <class T, class Member>
RunOption choice(RunOption option, Member member, Names<T> all) {
  option.known = [all] {
    std::vector<std::string> known;
    for (const auto& [text, value] : all) known.push_back(text);
    return known;
  };
  option.value = [member, all](const RunConfig& config) -> OptionValue {
    for (const auto& [text, value] : all) {
      if (member(config) == value) return text;
    }
    return {};
  };
  option.set = [member, all](RunConfig& config, const OptionValue& said) {
    for (const auto& [text, value] : all) {
      if (text == std::get<std::string>(said)) member(config) = value;
    }
  };
  return option;
}

/// An option whose value in a RunConfig is a std::optional. `member` returns a reference to it.
template <class Member>
RunOption optional(RunOption option, Member member) {
  option.value = [member](const RunConfig& config) -> OptionValue {
    if (const auto& value = member(config)) return *value;
    return {};
  };
  option.set = [member](RunConfig& config, const OptionValue& said) {
    using Value = typename std::remove_reference_t<decltype(member(config))>::value_type;
    member(config) = std::get<Value>(said);
  };
  return option;
}

/// An option of contact detection or response; its values are the names in a catalogue.
template <class Entry>
RunOption contact(RunOption option, std::string ContactConfig::*member, const std::vector<Entry>& (*catalogue)()) {
  option.takes_all = true;
  option.in_tex_names = false;
  option.known = [catalogue] {
    std::vector<std::string> known;
    for (const Entry& entry : catalogue()) known.push_back(entry.name);
    return known;
  };
  option.value = [member](const RunConfig& config) -> OptionValue {
    if (!config.contact) return {};
    return (*config.contact).*member;
  };
  option.set = [member](RunConfig& config, const OptionValue& said) {
    if (!config.contact) config.contact.emplace();
    (*config.contact).*member = std::get<std::string>(said);
  };
  if (!option.applies) {
    option.applies = [](const RunConfig& config) { return config.contact.has_value(); };
    option.no_effect = "no scenario here has contact = true";
    option.remedy = "or take a scenario with contact";
  }
  return option;
}

std::function<OptionValue(const Scenario&)> always(const char* name) {
  return [name](const Scenario&) -> OptionValue { return std::string(name); };
}

bool is_adaptive(const RunConfig& config) {
  const IntegratorEntry* method = find_integrator(config.integrator);
  return method && method->declaration.adaptive;
}
bool has_setting(const RunConfig& config, const std::string& key) {
  const IntegratorEntry* method = find_integrator(config.integrator);
  return method && find_setting(method->declaration.settings, key);
}
bool answers_impacts(const RunConfig& config) {
  if (!config.contact) return false;
  const ResponseEntry* response = find_response(config.contact->response);
  return !config.contact->impact_timing.empty() || (response && response->make);
}

std::vector<RunOption> options_of_motion() {
  RunOption scenario{.name = "scenario",
                     .values = "NAME|FILE",
                     .help = "scenario, built in or a TOML file (see --list scenarios)",
                     .role = Role::scenario,
                     .column = "scenario",
                     .header = "scenario"};
  scenario.value = [](const RunConfig& c) -> OptionValue { return c.scenario; };
  scenario.set = [](RunConfig& c, const OptionValue& said) { c.scenario = std::get<std::string>(said); };
  RunOption integrator{.name = "integrator",
                       .values = "NAME",
                       .help = "method (see --list integrators)",
                       .role = Role::method,
                       .takes_all = true,
                       .column = "integrator",
                       .header = "method",
                       .decides = true};
  integrator.known = [] {
    std::vector<std::string> known;
    for (const IntegratorEntry& entry : integrator_catalogue()) known.push_back(entry.declaration.name);
    return known;
  };
  integrator.value = [](const RunConfig& c) -> OptionValue { return c.integrator; };
  integrator.set = [](RunConfig& c, const OptionValue& said) { c.integrator = std::get<std::string>(said); };
  return {scenario, integrator};
}

std::vector<RunOption> options_of_formulation() {
  return {choice(
              {.name = "orientation",
               .values = "quaternion|matrix",
               .help = "chart of the orientation (default: quaternion)",
               .column = "orientation",
               .header = "orientation",
               .decides = true},
              [](auto& c) -> auto& { return c.formulation.orientation; },
              names_of({Orientation::quaternion, Orientation::matrix})),
          choice(
              {.name = "angular-state",
               .values = "velocity_world|velocity_body|momentum_world",
               .help = "what stands for the rotation in the state (default: velocity_world)",
               .column = "angular_state",
               .header = "angular state"},
              [](auto& c) -> auto& { return c.formulation.angular_state; },
              names_of({AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world})),
          choice(
              {.name = "gyroscopic",
               .values = "on|off",
               .help = "the term w x Iw, which both source documents leave out (default: on)",
               .column = "gyroscopic",
               .header = "gyroscopic",
               .term = "gyroscopic term",
               .word = "gyroscopic"},
              [](auto& c) -> auto& { return c.formulation.gyroscopic; }, Names<bool>{{"on", true}, {"off", false}}),
          choice(
              {.name = "normalize",
               .values = "never|step",
               .help = "project the orientation after each step (default: never)",
               .column = "normalize",
               .header = "normalize",
               .word = "normalize"},
              [](auto& c) -> auto& { return c.normalize; }, Names<bool>{{"never", false}, {"step", true}}),
          // This option has no effect on a matrix, which is used as stored.
          choice(
              {.name = "rotation-from",
               .values = "normalized|stored",
               .help = "what a quaternion off the unit sphere stands for (default: normalized)",
               .column = "rotation_from",
               .header = "rotation from",
               .term = "rotation from (quaternions)",
               .word = "rotation",
               .applies = [](const RunConfig& c) { return c.formulation.orientation == Orientation::quaternion; },
               .no_effect = "a matrix is used as it is stored",
               .remedy = "or take --orientation quaternion"},
              [](auto& c) -> auto& { return c.formulation.rotation_from; },
              names_of({RotationFrom::normalized, RotationFrom::stored})),
          choice(
              {.name = "precision",
               .values = "float|double|long_double",
               .help = "arithmetic; other than double for our own methods and Odeint's (default: double)",
               .column = "precision",
               .header = "precision"},
              [](auto& c) -> auto& { return c.precision; },
              names_of({Precision::single_precision, Precision::double_precision, Precision::extended_precision}))};
}

std::vector<RunOption> options_of_summation() {
  return {choice(
      {.name = "summation",
       .values = "plain|compensated",
       .help = "how increments are added to the state; compensated: what rounding loses is "
               "kept and added to the next one (default: plain)",
       .column = "summation",
       .on_demand = true,
       .header = "summation",
       .term = "summation of the state",
       .usual = std::string("plain")},
      [](auto& c) -> auto& { return c.summation; }, names_of({Summation::plain, Summation::compensated}))};
}

std::string option_name(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return key;
}

/// The option of a setting. `method` is the first method that has the setting.
RunOption option_of(const Setting& setting, const std::string& method) {
  const bool whole = std::holds_alternative<std::int64_t>(setting.usual), named = !setting.choices.empty();
  const std::string noun = setting.words(), &unit = setting.unit;
  RunOption option{.name = option_name(setting.key),
                   .values = named   ? fmt::format("{}", fmt::join(setting.choices, "|"))
                             : whole ? "N"
                                     : "X",
                   .help = setting.meaning + ", as --list integrators says",
                   .kind = named   ? Kind::name
                           : whole ? Kind::whole
                                   : Kind::number,
                   .of_methods = true,
                   .of_unit = unit.empty() ? "" : " of " + unit,
                   .column = unit.empty() ? setting.key : setting.key + "_" + unit,
                   .on_demand = true,
                   .header = noun,
                   .unit = unit,
                   .term = (unit.empty() ? noun : noun + " (" + unit + ")") + ", " + setting.meaning,
                   .word = noun,
                   .in_tex_names = false,
                   .no_effect = "no method here offers several " + noun + "s",
                   .remedy = "or name one that does, such as " + method};
  if (named) option.known = [choices = setting.choices] { return choices; };
  if (whole) {
    const bool vowel = std::string_view("aeiou").find(noun.front()) != std::string_view::npos;
    option.fault = [fault = (vowel ? "is not an " : "is not a ") + noun](double n) {
      return n != std::floor(n) || n > 9e15 ? fault : "";
    };
  }
  option.value = [key = setting.key](const RunConfig& config) -> OptionValue {
    const auto found = config.settings.find(key);
    if (found == config.settings.end()) return {};
    return std::visit([](const auto& value) -> OptionValue { return value; }, found->second);
  };
  option.set = [key = setting.key](RunConfig& config, const OptionValue& said) {
    std::visit(
        [&]<class T>(const T& value) {
          if constexpr (!std::is_same_v<T, std::monostate>) config.settings[key] = value;
        },
        said);
  };
  option.applies = [key = setting.key](const RunConfig& config) {
    return config.settings.contains(key) || has_setting(config, key);
  };
  return option;
}

/// One option for each key among the settings that methods declare. Methods that share a key may differ in the choices.
std::vector<RunOption> options_of_settings() {
  std::vector<std::pair<Setting, std::string>> settings;  // settings, each with the first method that has it
  for (const IntegratorEntry& entry : integrator_catalogue()) {
    for (const Setting& setting : entry.declaration.settings) {
      const auto same = [&](const auto& known) { return known.first.key == setting.key; };
      const auto known = std::find_if(settings.begin(), settings.end(), same);
      if (known == settings.end()) {
        settings.emplace_back(setting, entry.declaration.name);
        continue;
      }
      std::vector<std::string>& all = known->first.choices;
      for (const std::string& choice : setting.choices) {
        if (std::find(all.begin(), all.end(), choice) == all.end()) all.push_back(choice);
      }
    }
  }
  std::vector<RunOption> options;
  for (const auto& [setting, method] : settings) options.push_back(option_of(setting, method));
  return options;
}

std::vector<RunOption> options_of_time() {
  RunOption dt = optional(
      {.name = "dt",
       .values = "S",
       .help = "step of fixed-step methods, in s",
       .kind = Kind::number,
       .role = Role::size,
       .of_unit = " of seconds",
       .column = "dt_s",
       .header = "dt",
       .unit = "s",
       .term = "dt (s), fixed-step methods",
       .applies = [](const RunConfig& c) { return c.dt || !is_adaptive(c); },
       .no_effect = "every method here chooses its own steps, by --tolerance",
       .remedy = "or name a method of a fixed step",
       .needed = true},
      [](auto& c) -> auto& { return c.dt; });
  RunOption tolerance = optional(
      {.name = "tolerance",
       .values = "X",
       .help = "relative and absolute tolerance of adaptive methods",
       .kind = Kind::number,
       .role = Role::size,
       .column = "tolerance",
       .header = "tolerance",
       .term = "tolerance, relative and absolute alike, adaptive methods",
       .applies = [](const RunConfig& c) { return c.tolerance || is_adaptive(c); },
       .no_effect = "every method here has a fixed step, --dt",
       .remedy = "or name a method that chooses its own steps",
       .needed = true},
      [](auto& c) -> auto& { return c.tolerance; });
  tolerance.fault = [](double x) { return x < 1 ? "" : "is too large; it must be below 1"; };
  RunOption t_end{.name = "t-end",
                  .values = "S",
                  .help = "duration in s (default: the scenario's)",
                  .kind = Kind::number,
                  .role = Role::duration,
                  .of_unit = " of seconds",
                  .column = "t_end_s",
                  .header = "t_end",
                  .unit = "s",
                  .term = "t_end (s)"};
  t_end.value = [](const RunConfig& c) -> OptionValue { return c.t_end; };
  t_end.set = [](RunConfig& c, const OptionValue& said) { c.t_end = std::get<double>(said); };
  t_end.preset = [](const Scenario& scenario) -> OptionValue { return scenario.t_end; };
  RunOption samples = optional(
      {.name = "samples",
       .values = "N",
       .help = "measure at k t_end/N only (default: after every step)",
       .kind = Kind::whole,
       .role = Role::duration,
       .header = "samples",
       .term = "observed at (samples)",
       .unsaid = "every step"},
      [](auto& c) -> auto& { return c.samples; });
  samples.fault = [](double n) { return n != std::floor(n) || n > 1e9 ? "is not a whole number below 1e9" : ""; };
  return {dt, tolerance, t_end, samples};
}

/// Options that are no axes, in the order in which they end the identity of a run.
std::vector<RunOption> options_of_studies() {
  const RunOption max_steps = optional(
      {.name = "max-steps",
       .values = "N",
       .help = "a run of an adaptive method that is not at its end after so many steps has failed (default: 100000000)",
       .kind = Kind::whole,
       .role = Role::call,
       .word = "max_steps",
       .applies = [](const RunConfig& c) { return c.max_steps || is_adaptive(c); }},
      [](auto& c) -> auto& { return c.max_steps; });
  RunOption reference{.name = "reference",
                      .values = "",
                      .help =
                          "where no exact solution is known, measure errors against a motion in extended precision "
                          "that proves its digits by halving its step",
                      .kind = Kind::flag,
                      .role = Role::study,
                      .word = "reference"};
  reference.value = [](const RunConfig& c) -> OptionValue {
    if (c.reference) return std::int64_t{1};
    return {};
  };
  reference.set = [](RunConfig& c, const OptionValue&) { c.reference = true; };
  return {max_steps, reference};
}

/// An option of joints: a run without joints has no value of it.
RunOption of_joints(RunOption option) {
  option.value = [value = option.value](const RunConfig& config) -> OptionValue {
    if (!config.joints) return {};
    return value(config);
  };
  option.set = [set = option.set](RunConfig& config, const OptionValue& said) {
    if (!config.joints) config.joints.emplace();
    set(config, said);
  };
  return option;
}

std::vector<RunOption> options_of_joints() {
  const auto has_joints = [](const RunConfig& c) { return c.joints.has_value(); };
  const auto treatment = [](bool (JointTreatment::*is)() const) {
    return [is](const RunConfig& c) { return c.joints && (JointTreatment{c.joints->stabilization}.*is)(); };
  };
  RunOption stabilization = choice(
      {.name = "stabilization",
       .values = "none|baumgarte|position|velocity|both|penalty|augmented_lagrangian",
       .help = "correction of joints that drift open: Baumgarte's method, projection of positions, velocities or both "
               "after each step, or Baumgarte's equation by penalty or augmented Lagrangian (default: none)",
       .column = "stabilization",
       .on_demand = true,
       .header = "stabilization",
       .term = "stabilization of joints",
       .word = "stabilization",
       .usual = std::string("none"),
       .applies = has_joints,
       .decides = true,
       .no_effect = "no scenario here has joints",
       .remedy = "or take a scenario with joints"},
      [](auto& c) -> auto& { return c.joints->stabilization; },
      names_of({Stabilization::none, Stabilization::baumgarte, Stabilization::position, Stabilization::velocity,
                Stabilization::both, Stabilization::penalty, Stabilization::augmented_lagrangian}));
  RunOption metric = choice(
      {.name = "projection-metric",
       .values = "mass|unit",
       .help = "metric in which projections of joints are orthogonal: that of the masses, or 1 for each m and rad "
               "(default: mass)",
       .column = "projection_metric",
       .on_demand = true,
       .header = "projection metric",
       .term = "metric of projections",
       .word = "metric",
       .usual = std::string("mass"),
       .applies = treatment(&JointTreatment::projects),
       .no_effect = "no run here projects its joints",
       .remedy = "or take --stabilization position, velocity or both"},
      [](auto& c) -> auto& { return c.joints->metric; }, names_of({ProjectionMetric::mass, ProjectionMetric::unit}));
  struct Texts {
    std::string name, help, column, header, unit, no_effect, remedy;
  };
  const auto parameter = [](const Texts& said, auto applies, auto member) {
    return optional({.name = said.name,
                     .values = "X",
                     .help = said.help,
                     .kind = Kind::number,
                     .of_unit = said.unit.empty() ? "" : " of " + said.unit,
                     .column = said.column,
                     .on_demand = true,
                     .header = said.header,
                     .unit = said.unit,
                     .applies = applies,
                     .no_effect = said.no_effect,
                     .remedy = said.remedy},
                    member);
  };
  const auto baumgarte = treatment(&JointTreatment::has_baumgarte_terms);
  const std::string equation = " of g'' + 2 alpha g' + beta^2 g = 0, in 1/s (default: 10)",
                    no_baumgarte = "no run here is stabilized by Baumgarte's equation",
                    take_baumgarte = "or take --stabilization baumgarte";
  std::vector<RunOption> options = {
      stabilization,
      metric,
      parameter(
          {"baumgarte-alpha", "alpha" + equation, "baumgarte_alpha_per_s", "Baumgarte alpha", "1/s", no_baumgarte,
           take_baumgarte},
          baumgarte, [](auto& c) -> auto& { return c.joints->alpha; }),
      parameter(
          {"baumgarte-beta", "beta" + equation, "baumgarte_beta_per_s", "Baumgarte beta", "1/s", no_baumgarte,
           take_baumgarte},
          baumgarte, [](auto& c) -> auto& { return c.joints->beta; }),
      parameter(
          {"baumgarte-per-step", "alpha = beta = X/h in their place, for methods of a fixed step h",
           "baumgarte_per_step", "Baumgarte alpha h", "", no_baumgarte, take_baumgarte},
          baumgarte, [](auto& c) -> auto& { return c.joints->alpha_per_step; }),
      parameter(
          {"penalty", "of penalty and augmented_lagrangian, in multiples of the mean mass (default: 1e7)", "penalty",
           "penalty", "", "no run here has a penalty", "or take --stabilization penalty"},
          treatment(&JointTreatment::is_soft), [](auto& c) -> auto& { return c.joints->penalty; })};
  for (RunOption& option : options) option = of_joints(std::move(option));
  return options;
}

std::vector<RunOption> options_of_contact() {
  return {contact<BroadPhaseEntry>({.name = "broad-phase",
                                    .values = "NAME",
                                    .help = "broad phase of scenarios with contact (default: sweep_and_prune)",
                                    .column = "broad_phase",
                                    .header = "broad phase",
                                    .preset = always("sweep_and_prune")},
                                   &ContactConfig::broad_phase, broad_phase_catalogue),
          contact<NarrowPhaseEntry>({.name = "narrow-phase",
                                     .values = "NAME",
                                     .help = "narrow phase of them (default: sat, or gjk where shapes have no "
                                             "separating axes)",
                                     .column = "narrow_phase",
                                     .header = "narrow phase",
                                     .preset = [](const Scenario& s) -> OptionValue { return narrow_phase_for(s); }},
                                    &ContactConfig::narrow_phase, narrow_phase_catalogue),
          contact<ResponseEntry>({.name = "response",
                                  .values = "NAME",
                                  .help = "contact response (default: sequential_impulses)",
                                  .column = "response",
                                  .header = "response",
                                  .term = "response to contact",
                                  .decides = true,
                                  .preset = always("sequential_impulses")},
                                 &ContactConfig::response, response_catalogue),
          // This option has no effect on a compliant response, which is a force.
          contact<ImpactTimingEntry>({.name = "impact-timing",
                                      .values = "NAME",
                                      .help = "when impacts are answered (default: time_stepping)",
                                      .column = "impact_timing",
                                      .header = "timing of impacts",
                                      .applies = answers_impacts,
                                      .no_effect = "no run here answers impacts one by one",
                                      .remedy = "or take a scenario with contact and a response other than compliant",
                                      .preset = always("time_stepping")},
                                     &ContactConfig::impact_timing, impact_timing_catalogue)};
}

struct OptionTable {
  std::deque<RunOption> options;  // an added option moves no other: plans hold pointers to them
  std::vector<const RunOption*> by_column;
  std::vector<std::pair<std::string, const RunOption*>> by_stored_name;

  OptionTable() {
    for (const auto& part :
         {options_of_motion(), options_of_formulation(), options_of_summation(), options_of_settings(),
          options_of_time(), options_of_joints(), options_of_contact(), options_of_studies()})
      options.insert(options.end(), part.begin(), part.end());
    sort();
  }

  void sort() {
    by_column.clear();
    for (const RunOption& option : options) by_column.push_back(&option);
    std::stable_sort(by_column.begin(), by_column.end(), [](const RunOption* a, const RunOption* b) {
      if (is_axis(*a) != is_axis(*b)) return is_axis(*a);
      return a->on_demand != b->on_demand ? b->on_demand : a->on_demand && a->column < b->column;
    });
    by_stored_name.clear();
    for (const RunOption& option : options)
      by_stored_name.emplace_back(option.column.empty() ? file_key(option) : option.column, &option);
    std::sort(by_stored_name.begin(), by_stored_name.end());
  }
};

OptionTable& table() {
  static OptionTable all;
  return all;
}

/// The text as a number if it is one, so that 9 is sorted before 10.
OptionValue value_in(const std::string& text) {
  if (text.empty()) return {};
  double x = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), x);
  if (read.ec == std::errc() && read.ptr == text.data() + text.size() && !std::isnan(x)) return x;
  return text;
}

/// The value that runs.csv and the identity contain; empty if the option does not apply.
OptionValue applied(const RunOption& option, const RunConfig& config) {
  OptionValue value = option.value(config);
  if (value == OptionValue{} || option.applies_to(config)) return value;
  return {};
}

bool has_column(const RunOption& option, const NamedOptions& named, Roles without) {
  return !option.column.empty() && (!option.on_demand || named.contains(option.name)) &&
         std::find(without.begin(), without.end(), option.role) == without.end();
}

}  // namespace

const std::deque<RunOption>& run_options() { return table().options; }

bool is_axis(const RunOption& option) { return option.role != Role::study && option.role != Role::call; }

const std::vector<const RunOption*>& options_by_column() { return table().by_column; }

const std::vector<std::pair<std::string, const RunOption*>>& options_by_stored_name() { return table().by_stored_name; }

std::vector<const RunOption*> options_of_role(RunOption::Role role) {
  auto all = options_by_column();
  std::erase_if(all, [&](const RunOption* option) { return option->role != role; });
  return all;
}

NamedOptions options_on_demand() {
  NamedOptions names;
  for (const RunOption& option : run_options()) {
    if (option.on_demand) names.insert(option.name);
  }
  return names;
}

const RunOption& run_option(const std::string& name) {
  for (const RunOption& option : run_options()) {
    if (option.name == name) return option;
  }
  throw std::logic_error("there is no run option " + name);
}

RunOption without_member(RunOption option) {
  option.value = [name = option.name](const RunConfig& config) -> OptionValue {
    const auto found = config.further.find(name);
    return found == config.further.end() ? OptionValue{} : found->second;
  };
  option.set = [name = option.name](RunConfig& config, const OptionValue& said) { config.further[name] = said; };
  return option;
}

AddedRunOption::AddedRunOption(RunOption option) {
  table().options.push_back(std::move(option));
  table().sort();
}
AddedRunOption::~AddedRunOption() {
  table().options.pop_back();
  table().sort();
}

std::string file_key(const RunOption& option) {
  std::string key = option.name;
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

std::string values_in_studies(const RunOption& option) { return option.values + (option.takes_all ? "|all" : ""); }

std::string summary_of(const Declaration& method) {
  std::string text = method.summary;
  for (const Setting& setting : method.settings) text += ", or --" + option_name(setting.key) + " " + setting.range();
  return text;
}

std::string text_of(OptionValue value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value)) return exact(*number);
  if (auto* text = std::get_if<std::string>(&value)) return std::move(*text);
  return {};
}

std::string label_of(const RunOption& option, const RunConfig& config) {
  const std::string text = text_of(option.value(config));
  if (text.empty() || option.word.empty()) return text;
  return option.kind == Kind::flag ? option.word : option.word + " " + text;
}

bool is_usual(const RunOption& option, const RunConfig& config, const RunConfig& usual) {
  const OptionValue value = option.value(config);
  return value == OptionValue{} || value == option.usual || value == option.value(usual);
}

bool is_usual(const RunOption& option, const RunConfig& config) {
  static const RunConfig usual;
  return is_usual(option, config, usual);
}

std::vector<std::string> config_columns(const std::vector<std::string>& varied_keys, const NamedOptions& named,
                                        Roles without) {
  std::vector<std::string> columns;
  for (const RunOption* option : options_by_column()) {
    if (has_column(*option, named, without)) columns.push_back(option->column);
  }
  columns.insert(columns.end(), varied_keys.begin(), varied_keys.end());
  return columns;
}

std::string config_cell(const RunOption& option, const RunConfig& config) {
  OptionValue value = applied(option, config);
  return option.kind == Kind::flag && value != OptionValue{} ? "on" : text_of(std::move(value));
}

const RunOption* option_of_column(const std::string& column) {
  for (const RunOption& option : run_options()) {
    if (option.column == column) return &option;
  }
  return nullptr;
}

std::vector<std::string> config_cells(const RunConfig& config, const NamedOptions& named, Roles without) {
  std::vector<std::string> cells;
  cells.reserve(options_by_column().size() + config.varied.size());
  for (const RunOption* option : options_by_column()) {
    if (has_column(*option, named, without)) cells.push_back(config_cell(*option, config));
  }
  for (const Override& o : config.varied) cells.push_back(o.value);
  return cells;
}

bool have_same_options(const RunConfig& a, const RunConfig& b) {
  // A member that is added to a structure must be named here.
  const auto options = [](const RunConfig& config) {
    const auto& [scenario, varied, integrator, formulation, normalize, precision, summation, contact, joints, dt,
                 tolerance, max_steps, t_end, samples, reference, settings, further] = config;
    const auto& [orientation, angular_state, gyroscopic, rotation_from, treatment] = formulation;
    const auto& [stabilization, alpha, beta, penalty, metric] = treatment;
    return std::tie(scenario, integrator, orientation, angular_state, gyroscopic, rotation_from, stabilization, alpha,
                    beta, penalty, metric, normalize, precision, summation, contact, joints, dt, tolerance, max_steps,
                    t_end, samples, reference, settings, further);
  };
  return options(a) == options(b);
}

std::vector<std::string> ConfigCells::of(const RunConfig& config) {
  if (!last_ || !have_same_options(*last_, config)) {
    last_ = config;
    last_->varied.clear();
    of_options_ = config_cells(*last_, *named_);
  }
  std::vector<std::string> cells;
  cells.reserve(of_options_.size() + config.varied.size());
  cells = of_options_;
  for (const Override& o : config.varied) cells.push_back(o.value);
  return cells;
}

IdentityText identity_text(const RunConfig& config) {
  IdentityText text;
  text.before.reserve(256);
  for (const RunOption* option : options_by_column()) {
    if (has_column(*option, {}, {})) text.before.append(config_cell(*option, config)).append("\n");
  }
  for (const RunOption& option : run_options()) {
    if (option.column.empty() && is_axis(option)) text.after += text_of(applied(option, config));
  }
  for (const RunOption* option : options_by_column()) {
    const bool may_be_absent = option->on_demand || !is_axis(*option);
    if (may_be_absent && !is_usual(*option, config)) text.after += "\n" + label_of(*option, config);
  }
  return text;
}

std::string identity_of(const RunConfig& config) {
  const IdentityText text = identity_text(config);
  std::string varied;
  for (const Override& o : config.varied) varied += o.value + "\n";
  return text.before + varied + text.after;
}

std::vector<OptionValue> sort_key_of_options(const RunConfig& config) {
  std::vector<OptionValue> key;
  key.reserve(run_options().size() + 1);  // the scenario has two values
  for (const RunOption* option : options_by_column()) {
    if (option->column.empty()) continue;
    OptionValue value = applied(*option, config);
    if (option->role == Role::scenario) {
      key.push_back(value_in(text_of(value)));
    }
    key.push_back(std::move(value));
  }
  return key;
}

std::vector<OptionValue> sort_key_of_varied(const std::vector<Override>& varied) {
  std::vector<OptionValue> key;
  for (const Override& o : varied) key.push_back(value_in(o.value));
  return key;
}

std::vector<OptionValue> sort_key(const RunConfig& config) {
  std::vector<OptionValue> key = sort_key_of_options(config);
  for (OptionValue& value : sort_key_of_varied(config.varied)) key.push_back(std::move(value));
  return key;
}

std::vector<std::string> sort_columns(const std::vector<std::string>& varied_keys) {
  std::vector<std::string> columns;
  for (const RunOption* option : options_by_column()) {
    if (option->column.empty()) continue;
    if (option->role == Role::scenario) columns.push_back(option->column);
    columns.push_back(option->column);
  }
  columns.insert(columns.end(), varied_keys.begin(), varied_keys.end());
  return columns;
}

}  // namespace polhode::study::record
