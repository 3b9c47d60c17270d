// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/json_listing.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "collision/broad_phase.hpp"
#include "collision/contact/impact_timing.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/response.hpp"
#include "collision/shapes/shape_catalogue.hpp"
#include "core/forces/catalogue.hpp"
#include "core/joints/catalogue.hpp"
#include "core/system/invariants.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline plan {
namespace {

using Json = nlohmann::ordered_json;

/// The list of the entries of a catalogue, each made by `entry`.
template <class Catalogue, class Entry>
Json list_of(const Catalogue& catalogue, const Entry& entry) {
  Json list = Json::array();
  for (const auto& item : catalogue) list.push_back(entry(item));
  return list;
}

template <class Catalogue>
Json names_and_summaries(const Catalogue& catalogue) {
  return list_of(catalogue, [](const auto& e) -> Json { return {{"name", e.name}, {"summary", e.summary}}; });
}

Json value_in_json(const TomlValue& value) {
  switch (value.type) {
    case TomlValue::Type::boolean: return value.boolean;
    case TomlValue::Type::number: return value.number;
    case TomlValue::Type::list: return list_of(value.items, value_in_json);
    default: return value.text;
  }
}

Json value_in_json(const SettingValue& value) {
  return std::visit([](const auto& x) -> Json { return x; }, value);
}

Json setting_in_json(const Setting& s) {
  return {{"key", s.key},         {"usual", value_in_json(s.usual)},
          {"meaning", s.meaning}, {"unit", s.unit},
          {"lowest", s.lowest},   {"highest", s.highest},
          {"choices", s.choices}, {"range", s.range()}};
}

/// Null: the method has no multipliers of its own, or their order varies.
Json multiplier_order(const Declaration& d) {
  const int order = d.multiplier_order > 0 ? d.multiplier_order : d.order;
  return d.solves_joints() && order > 0 ? Json(order) : Json(nullptr);
}

/// Name of the order for free bodies: a number, "exact", or null for a variable order.
Json free_order(const Declaration& d) {
  if (d.free_order == Declaration::exact_order) return "exact";
  const int order = d.free_order > 0 ? d.free_order : d.order;
  return order > 0 ? Json(order) : Json(nullptr);
}

/// Equations of the joints that a method solves itself; null: none.
Json joints_in_json(JointEquations joints) {
  switch (joints) {
    case JointEquations::acceleration: return "G v' = gamma";
    case JointEquations::velocity: return "G v = 0";
    case JointEquations::position: return "g(q) = 0";
    case JointEquations::position_and_velocity: return "g(q) = 0 and G v = 0";
    case JointEquations::impulses: return "by impulses";
    default: return nullptr;
  }
}

Json integrator_in_json(const IntegratorEntry& e) {
  const Declaration& d = e.declaration;
  Json scalars = Json::array({"double"});
  if (e.make_float) scalars.push_back("float");
  if (e.make_long_double) scalars.push_back("long_double");
  return {{"name", d.name},
          {"family", d.family},
          {"summary", d.summary},
          {"equation", d.equation},
          {"sources", d.sources},
          {"order", d.order > 0 ? Json(d.order) : Json(nullptr)},
          {"free_order", free_order(d)},
          {"multiplier_order", multiplier_order(d)},
          {"adaptive", d.adaptive},
          {"implicit", d.implicit},
          {"evaluations_per_step", d.evaluations_per_step > 0 ? Json(d.evaluations_per_step) : Json(nullptr)},
          {"multi_step", d.multi_step},
          {"additive", d.additive},
          {"lie_group", d.lie_group},
          {"normalizes", d.normalizes},
          {"conserves_quadratics", d.conserves_quadratics},
          {"symplectic", d.symplectic},
          {"symmetric", d.symmetric},
          {"conserves_energy", d.conserves_energy},
          {"conserves_momentum", d.conserves_momentum},
          {"conserves_casimir", d.conserves_casimir},
          {"joints", joints_in_json(d.joints)},
          {"precisions", scalars},
          {"settings", list_of(d.settings, setting_in_json)}};
}

Json scenario_in_json(const BuiltinScenario& b) {
  const Scenario s = ScenarioSource::open(std::string(b.name)).resolve();
  return {{"name", s.name},
          {"title", s.title},
          {"description", s.description},
          {"t_end_s", s.t_end},
          {"bodies", s.problem.bodies.size()},
          {"contact", !s.colliders.empty()},
          {"joints", s.problem.joints.size()},
          {"invariants", s.invariants},
          {"text", b.text}};
}

Json key_in_json(const ScenarioKey& key) {
  return {{"key", key.name},
          {"default", key.otherwise ? value_in_json(*key.otherwise) : Json(nullptr)},
          {"can_vary", key.decides != Decides::never},
          {"with_contact_only", key.decides == Decides::with_contact}};
}

Json parameter_in_json(const Parameter& p) {
  const bool required = p.need == Parameter::Need::required;
  return {{"key", p.key},
          {"unit", p.unit},
          {"meaning", p.meaning},
          {"required", required},
          {"default", required ? Json(nullptr) : value_in_json(to_toml(p.value))},
          {"range", p.range == Parameter::Range::positive       ? "positive"
                    : p.range == Parameter::Range::non_negative ? "non-negative"
                                                                : "any"},
          {"choices", p.choices},
          {"needs_bodies", p.needs_bodies}};
}

Json force_in_json(const ForceEntry& e) {
  return {{"name", e.kind.name},
          {"summary", e.kind.summary},
          {"min_bodies", e.kind.min_bodies},
          {"max_bodies", e.kind.max_bodies > 0 ? Json(e.kind.max_bodies) : Json(nullptr)},
          {"keys", list_of(e.kind.parameters, parameter_in_json)}};
}

Json joint_in_json(const JointEntry& e) {
  return {{"name", e.kind.name},
          {"summary", e.kind.summary},
          {"equations", e.kind.rows},
          {"keys", list_of(e.kind.parameters, parameter_in_json)}};
}

Json shape_in_json(const ShapeEntry& e) {
  return {{"name", e.name},
          {"summary", e.summary},
          {"moments", e.moments_formula},
          {"keys", list_of(e.parameters, parameter_in_json)}};
}

Json invariant_in_json(const InvariantKind& i) { return {{"name", i.name}, {"unit", i.unit}, {"summary", i.summary}}; }

Json metric_in_json(const Metric& m) {
  return {{"column", m.column},
          {"label", m.label},
          {"unit", m.unit},
          {"meaning", m.meaning},
          {"described_by", m.listed_with},
          {"runs", m.runs == Metric::Runs::with_contact     ? "with contact"
                   : m.runs == Metric::Runs::with_joints    ? "with joints"
                   : m.runs == Metric::Runs::with_reference ? "with a reference"
                                                            : "all"},
          {"words", m.words},
          {"tex", m.tex},
          {"in_scores", m.in_scores}};
}

Json option_in_json(const RunOption& o) {
  return {{"option", "--" + o.name},
          {"file_key", file_key(o)},
          {"values", values_in_studies(o)},
          {"help", o.help},
          {"unit", o.unit},
          {"column", o.column},
          {"on_demand", o.on_demand},
          {"known", o.known ? Json(o.known()) : Json(nullptr)}};
}

}  // namespace

std::string json_listing(std::span<const Metric> metrics) {
  std::vector<RunOption> axes;
  std::copy_if(run_options().begin(), run_options().end(), std::back_inserter(axes), is_axis);
  const Json all = {{"integrators", list_of(integrator_catalogue(), integrator_in_json)},
                    {"scenarios", list_of(builtin_scenarios(), scenario_in_json)},
                    {"scenario-keys", list_of(root_keys(), key_in_json)},
                    {"body-keys", list_of(body_keys(), key_in_json)},
                    {"forces", list_of(force_catalogue(), force_in_json)},
                    {"joints", list_of(joint_catalogue(), joint_in_json)},
                    {"shapes", list_of(shape_catalogue(), shape_in_json)},
                    {"invariants", list_of(invariant_catalogue(), invariant_in_json)},
                    {"metrics", list_of(metrics, metric_in_json)},
                    {"options", list_of(axes, option_in_json)},
                    {"broad-phases", names_and_summaries(broad_phase_catalogue())},
                    {"narrow-phases", names_and_summaries(narrow_phase_catalogue())},
                    {"responses", names_and_summaries(response_catalogue())},
                    {"impact-timings", names_and_summaries(impact_timing_catalogue())}};
  return all.dump(2) + "\n";
}

}  // namespace polhode::study::plan
