// SPDX-License-Identifier: BSD-3-Clause
// Configurations of a session: the default one, and reasons for which one cannot be run.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include "collision/broad_phase.hpp"
#include "collision/contact/impact_timing.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/response.hpp"
#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/viewer/session/session.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::viewer::inline session {
namespace {

template <class Entry>
std::string unknown(const char* what, const std::string& name, const std::vector<Entry>& catalogue) {
  std::vector<std::string_view> known;
  for (const Entry& entry : catalogue) {
    if (entry.name == name) return {};
    known.push_back(entry.name);
  }
  return fmt::format("no {} is called '{}'{}", what, name, study::suggestion(name, "There are", known));
}

std::string contact_fault(const study::RunConfig& run, const study::Scenario& scenario) {
  if (!run.contact) {
    return scenario.colliders.empty() ? "" : "the scenario has contact; say how it is found and answered";
  }
  if (scenario.colliders.empty()) return "the scenario has no contact; leave out how it is found and answered";
  const study::ContactConfig& c = *run.contact;
  std::string fault = unknown("broad phase", c.broad_phase, broad_phase_catalogue());
  if (fault.empty()) fault = unknown("narrow phase", c.narrow_phase, narrow_phase_catalogue());
  if (fault.empty()) fault = unknown("response", c.response, response_catalogue());
  if (!fault.empty()) return fault;
  if (find_response(c.response)->make) return unknown("impact timing", c.impact_timing, impact_timing_catalogue());
  return c.impact_timing.empty() ? "" : c.response + " is a force; leave the impact timing out";
}

std::string integrator_fault(const study::RunConfig& run) {
  const IntegratorEntry* entry = find_integrator(run.integrator);
  if (!entry) {
    std::vector<std::string_view> known;
    for (const IntegratorEntry& e : integrator_catalogue()) known.push_back(e.declaration.name);
    return "no integrator is called '" + run.integrator + "'" +
           study::suggestion_of_many(run.integrator, known, "--list integrators");
  }
  const bool adaptive = entry->declaration.adaptive;
  const std::optional<double>&said = adaptive ? run.tolerance : run.dt, &other = adaptive ? run.dt : run.tolerance;
  if (!said || other)
    return run.integrator + (adaptive ? " takes a tolerance, and no dt" : " takes dt, and no tolerance");
  if (!(*said > 0 && std::isfinite(*said)) || (adaptive && !(*said < 1))) {
    return adaptive ? "the tolerance must be positive and below 1" : "dt must be a positive number of seconds";
  }
  return {};
}

/// A run of the scenario without any option.
study::RunConfig start_of(const study::Scenario& scenario) {
  study::RunConfig run;
  run.scenario = scenario.name;
  if (!scenario.colliders.empty()) run.contact.emplace();
  if (!scenario.problem.joints.empty()) run.joints.emplace();
  return run;
}

}  // namespace

Configuration usual_configuration(const study::Scenario& scenario) {
  Configuration usual{.run = start_of(scenario)};
  choose_integrator(usual, "rk4");
  for (const study::RunOption& option : study::run_options()) {
    if (option.preset && option.applies_to(usual.run)) option.set(usual.run, option.preset(scenario));
  }
  return usual;
}

void choose_integrator(Configuration& configuration, const std::string& name, double dt, double tolerance) {
  const IntegratorEntry* entry = find_integrator(name);
  const bool adaptive = entry && entry->declaration.adaptive;
  configuration.run.integrator = name;
  configuration.run.settings.clear();
  configuration.run.dt = adaptive ? std::nullopt : std::optional(dt);
  configuration.run.tolerance = adaptive ? std::optional(tolerance) : std::nullopt;
}

void choose_option(Configuration& configuration, const study::RunOption& option, const std::string& text,
                   const study::Scenario& scenario) {
  study::OptionValue chosen;
  if (!text.empty()) {
    const std::string label = "--" + option.name;
    const std::vector<study::OptionValue> values = study::option_values(option, text, label);
    if (values.size() != 1) throw study::InputError(label + ": a run has one value, not '" + text + "'");
    chosen = values.front();
  }
  // Whether an option applies follows from those before it, so the run is put together anew, as in a study.
  const study::RunConfig& before = configuration.run;
  study::RunConfig run = start_of(scenario);
  run.varied = before.varied;
  for (const study::RunOption& each : study::run_options()) {
    if (!each.applies_to(run)) continue;
    study::OptionValue value = &each == &option ? chosen : each.value(before);
    const auto absent = [&] { return study::text_of(value).empty(); };  // an impact timing is then an empty name
    if (absent() && each.preset) value = each.preset(scenario);
    if (!absent()) each.set(run, value);
  }
  configuration.run = std::move(run);
}

std::string value_text(const study::RunOption& option, const study::RunConfig& run) {
  if (const std::string text = study::text_of(option.value(run)); !text.empty()) return text;
  if (!option.of_methods) return study::text_of(option.usual);
  const IntegratorEntry* entry = find_integrator(run.integrator);
  const Setting* setting = entry ? find_setting(entry->declaration.settings, study::file_key(option)) : nullptr;
  if (!setting) return {};
  return study::text_of(std::visit([](const auto& usual) -> study::OptionValue { return usual; }, setting->usual));
}

std::string refusal(const Configuration& configuration, const study::Scenario& scenario) {
  const study::RunConfig& run = configuration.run;
  if (std::string fault = integrator_fault(run); !fault.empty()) return fault;
  if (std::string fault = contact_fault(run, scenario); !fault.empty()) return fault;
  if (!(run.t_end > 0) || !std::isfinite(run.t_end)) return "t_end must be a positive number of seconds";
  if (run.precision != study::Precision::double_precision)
    return "a session works in double only; leave the precision out";
  if (run.samples || run.reference)
    return "a session shows every step and takes no reference; leave samples and reference out";
  if (configuration.drive == Drive::frame_clock && !run.dt) {
    return run.integrator + " chooses its own steps, and the frame clock gives them; take the accumulator";
  }
  try {
    return study::refusal(run, scenario);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

}  // namespace polhode::viewer::session
