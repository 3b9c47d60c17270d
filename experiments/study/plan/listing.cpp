// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "collision/broad_phase.hpp"
#include "collision/contact/impact_timing.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/shapes/shape_catalogue.hpp"
#include "core/forces/catalogue.hpp"
#include "core/joints/catalogue.hpp"
#include "core/system/invariants.hpp"
#include "experiments/study/plan/figure_options.hpp"
#include "experiments/study/plan/json_listing.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline plan {
namespace {

constexpr std::size_t name_width = 30;  // width of the column of names: length of the longest name

std::string line(const std::string& name, const std::string& text) {
  return fmt::format("  {:<{}} {}\n", name, name_width, text);
}

std::string integrators() {
  std::string text;
  for (const IntegratorEntry& e : integrator_catalogue()) {
    const Declaration& d = e.declaration;
    const std::string order = d.order > 0 ? fmt::format("order {}", d.order) : "variable order";
    text += line(d.name, fmt::format("{} ({}, {}, {}{})", summary_of(d), d.family, order,
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

std::string joints() {
  std::string text;
  for (const JointEntry& e : joint_catalogue())
    text += line(e.kind.name, e.kind.summary + "; keys: " + keys(e.kind.parameters));
  return text;
}

std::string shapes() {
  std::string text;
  for (const ShapeEntry& s : shape_catalogue()) {
    text += line(s.name, (s.moments ? s.moments_formula : s.summary) + "; keys: " + keys(s.parameters));
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

std::string figures() {
  std::string text;
  for (const FigureName& figure : figure_names()) text += line(std::string(figure.name), std::string(figure.shows));
  return text;
}

std::string metrics_text(std::span<const Metric> table) {
  std::vector<const Metric*> listed;
  for (const Metric& metric : table) {
    if (metric.listed_with.empty()) listed.push_back(&metric);
  }
  std::stable_sort(listed.begin(), listed.end(),
                   [](const Metric* a, const Metric* b) { return a->list_rank < b->list_rank; });
  std::string text;
  for (const Metric* metric : listed) {
    std::string name = metric->listed_as.empty() ? metric->column : metric->listed_as;
    for (std::size_t at = 0; at != std::string::npos;) {
      const std::size_t end = metric->meaning.find('\n', at);
      text += line(name, metric->meaning.substr(at, end - at));
      name.clear();
      at = end == std::string::npos ? end : end + 1;
    }
  }
  return text;
}

}  // namespace

std::string listing(const std::string& what, std::span<const Metric> metrics) {
  const std::pair<const char*, std::function<std::string()>> sections[] = {
      {"integrators", integrators},
      {"scenarios", scenarios},
      {"forces", forces},
      {"joints", joints},
      {"shapes", shapes},
      {"invariants", invariants},
      {"metrics", [&] { return metrics_text(metrics); }},
      {"figures", figures},
      {"broad-phases", broad_phases},
      {"narrow-phases", narrow_phases},
      {"responses", responses},
      {"impact-timings", impact_timings}};
  if (what == "json") return json_listing(metrics);
  std::string text;
  std::vector<std::string_view> known = {"json"};
  for (const auto& [name, section] : sections) {
    known.emplace_back(name);
    if (what.empty() || what == name) text += (what.empty() ? std::string(name) + "\n" : "") + section();
  }
  if (text.empty()) throw InputError("--list: no catalogue '" + what + "'" + suggestion(what, "There are", known));
  return text;
}

}  // namespace polhode::study::plan
