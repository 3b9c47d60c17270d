// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/listing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "collision/broad_phase.hpp"
#include "collision/contact/impact_timing.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/shape_inertia.hpp"
#include "core/forces/catalogue.hpp"
#include "core/system/invariants.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study {
namespace {

constexpr std::size_t name_width = 30;  // of the longest name

std::string line(const std::string& name, const std::string& text) {
  return fmt::format("  {:<{}} {}\n", name, name_width, text);
}

std::string integrators() {
  std::string text;
  for (const IntegratorEntry& e : integrator_catalogue()) {
    const Declaration& d = e.declaration;
    const std::string order = d.order > 0 ? fmt::format("order {}", d.order) : "variable order";
    text += line(d.name, fmt::format("{} ({}, {}, {}{})", d.summary, d.family, order,
                                     d.implicit ? "implicit" : "explicit", d.adaptive ? ", takes --tolerance" : ""));
  }
  return text;
}

std::string scenarios() {
  std::string text;
  for (const BuiltinScenario& b : builtin_scenarios()) {
    const Scenario s = ScenarioSource::open(std::string(b.name)).resolve();
    text += line(s.name, s.title + (s.description.empty() ? "" : ": " + s.description));
  }
  return text;
}

std::string keys(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& p : parameters) {
    text += (text.empty() ? "" : ", ") + p.key + (p.unit.empty() ? "" : " [" + p.unit + "]");
  }
  return text;
}

std::string forces() {
  std::string text;
  for (const ForceEntry& e : force_catalogue())
    text += line(e.kind.name, e.kind.summary + "; keys: " + keys(e.kind.parameters));
  return text;
}

std::string shapes() {
  std::string text;
  for (const ShapeEntry& s : collision_shape_catalogue()) {
    const ShapeKind* core = find_shape(s.name);
    text += line(s.name, (core ? core->summary : s.summary) + "; keys: " + keys(s.parameters));
  }
  return text;
}

std::string invariants() {
  std::string text;
  for (const InvariantKind& i : invariant_catalogue()) text += line(i.name, i.summary + " [" + i.unit + "]");
  return text;
}

std::string broad_phases() {
  std::string text;
  for (const BroadPhaseEntry& e : broad_phase_catalogue()) text += line(e.name, e.summary);
  return text;
}

std::string narrow_phases() {
  std::string text;
  for (const NarrowPhaseEntry& e : narrow_phase_catalogue()) text += line(e.name, e.summary);
  return text;
}

std::string responses() {
  std::string text;
  for (const ResponseEntry& e : response_catalogue()) text += line(e.name, e.summary);
  return text;
}

std::string impact_timings() {
  std::string text;
  for (const ImpactTimingEntry& e : impact_timing_catalogue()) text += line(e.name, e.summary);
  return text;
}

std::string metrics() {
  return line("energy_drift_*",
              "ledger: kinetic + potential - work of non-conservative forces + energy lost in contact - energy "
              "injected by projection") +
         line("linear_momentum_*", "|P - P0| over |P0|, where the forces conserve it") +
         line("angular_momentum_*",
              "|L - L0| over |L0|: one body about its mass centre or pivot, several about the origin") +
         line("<invariant>_*", "each further invariant that a scenario declares, over its scale") +
         line("orientation_defect_max", "| |q| - 1 |, or the Frobenius norm of R^T R - 1") +
         line("position_error_max_m",
              "distance from the exact mass centre, or with --reference from a proven reference") +
         line("attitude_error_max_rad", "angle between the attitude and the exact one") +
         line("angular_velocity_error_*", "|w - w exact| over |w0|") +
         line("polhode_phase_error_*",
              "of one free body: how far its momentum is ahead along the exact polhode, s and rad") +
         line("polhode_off_error_*", "and its distance from that polhode, over |L|") +
         line("energy_drift_rate_*", "least-squares slope of the drift, and half its 95 % confidence interval") +
         line("first_impact_s", "with contact: when the first impact was, and") +
         line("impact_loss_J ...",
              "what the ledger has lost to impacts and friction, and what undoing penetration put in") +
         line("energy_rise_max_J", "largest rise of kinetic + potential - work above an earlier value") +
         line("energy_change_max_J", "its largest distance from that at the start") +
         line("penetration_max_m, _end_m", "how deep two bodies were in each other at most, and at the end") +
         line("displacement_after_2s_max_m", "of a mass centre from where it was after 2 s") +
         line("left_place_s", "when one was a tenth of its body's radius away from where it started") +
         line("drift_exponent*", "p of |drift| ~ t^p, oscillations set aside, and its 95 % confidence interval") +
         line("drift_class",
              "by that exponent: bounded, random walk or sublinear, linear, quadratic, faster; round-off,") +
         line("", "saturated, jumps (at impacts alone), undecided, with") +
         line("drift_decided_after_s", "the duration that would decide it, by estimate");
}

struct Section {
  const char* name;
  std::string (*text)();
};
constexpr Section sections[] = {{"integrators", integrators},
                                {"scenarios", scenarios},
                                {"forces", forces},
                                {"shapes", shapes},
                                {"invariants", invariants},
                                {"metrics", metrics},
                                {"broad-phases", broad_phases},
                                {"narrow-phases", narrow_phases},
                                {"responses", responses},
                                {"impact-timings", impact_timings}};

}  // namespace

std::string listing(const std::string& what) {
  std::string text;
  std::vector<std::string_view> known;
  for (const Section& s : sections) {
    known.emplace_back(s.name);
    if (what.empty() || what == s.name) text += (what.empty() ? std::string(s.name) + "\n" : "") + s.text();
  }
  if (text.empty()) throw InputError("--list: no catalogue '" + what + "'" + suggestion(what, "There are", known));
  return text;
}

}  // namespace polhode::study
