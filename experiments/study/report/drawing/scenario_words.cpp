// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/drawing/scenario_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "collision/shapes/half_space.hpp"
#include "core/forces/catalogue.hpp"
#include "core/joints/catalogue.hpp"
#include "core/problem/inertia.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline drawing {
namespace {

constexpr std::size_t most_lines = 12;

std::string vector_words(const Vector3<double>& x) {
  const auto one = [](double value) { return rounded(value == 0 ? 0.0 : value); };  // no "-0"
  return fmt::format("({}, {}, {})", one(x[0]), one(x[1]), one(x[2]));
}

std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string shape_words(const Shape& shape) {
  if (const auto* floor = dynamic_cast<const HalfSpace*>(&shape))
    return fmt::format("a plane with normal {}", vector_words(floor->normal()));
  const Vector3<double> size = shape.bounds({}).sizes();
  if (shape.tag() == ShapeTag::sphere) return fmt::format("a sphere of {} m radius", rounded(size[0] / 2));
  return fmt::format("a {} of {} × {} × {} m", spaced(std::string(shape.kind())), rounded(size[0]), rounded(size[1]),
                     rounded(size[2]));
}

/// A unit with its powers raised: "m³/(kg s²)".
std::string raised(std::string unit) {
  for (const auto& [plain, power] : {std::pair("^2", "²"), std::pair("^3", "³")}) {
    for (std::size_t at; (at = unit.find(plain)) != std::string::npos;) unit.replace(at, 2, power);
  }
  return unit;
}

std::string surface_words(const Scenario& scenario, std::size_t i) {
  if (scenario.colliders.empty()) return {};
  const Collider& c = scenario.colliders[i];
  std::vector<std::string> parts;
  if (c.restitution != 0) parts.push_back(fmt::format("restitution {}", rounded(c.restitution)));
  if (c.friction != 0) parts.push_back(fmt::format("friction {}", rounded(c.friction)));
  return parts.empty() ? std::string() : "; " + words(parts);
}

/// The words about a body, apart from its name and its place.
std::string body_words(const Scenario& scenario, std::size_t i) {
  const Body& body = scenario.problem.bodies[i];
  const BodyStart& start = scenario.problem.starts[i];
  const ShapePointer& shape = scenario.shapes[i];
  if (body.fixed)
    return fmt::format("static, {}{}", shape ? shape_words(*shape) : "without a shape", surface_words(scenario, i));
  const Vector3<double> moments = principal_axes(body.inertia).moments;
  std::string text =
      fmt::format("{} kg, {}; principal moments of inertia {}, {} and {} kg m² about the {}", rounded(body.mass),
                  shape ? shape_words(*shape) : "without a shape, drawn as the solid box of equal mass and inertia",
                  rounded(moments[0]), rounded(moments[1]), rounded(moments[2]), body.pinned ? "pivot" : "mass centre");
  if (body.pinned)
    text += fmt::format("; it turns about the pivot at {} m, its mass centre is at {} m in body axes",
                        vector_words(start.position), vector_words(body.center_of_mass));
  std::vector<std::string> moves;
  if (!start.angular_velocity.isZero(0))
    moves.push_back(fmt::format("ω = {} rad/s{}", vector_words(start.angular_velocity),
                                start.angular_velocity_in_body ? " in body axes" : ""));
  if (!start.velocity.isZero(0)) moves.push_back(fmt::format("v = {} m/s", vector_words(start.velocity)));
  text += moves.empty() ? "; it starts at rest" : fmt::format("; it starts with {}", words(moves));
  return text + surface_words(scenario, i);
}

std::string value_words(const ParameterValue& value) {
  if (const auto* x = std::get_if<double>(&value)) return rounded(*x);
  if (const auto* v = std::get_if<Vector3<double>>(&value)) return vector_words(*v);
  return std::get<std::string>(value);
}

/// "Spring between a and b: stiffness 40 N/m" for a force, likewise for a joint.
std::string words_of(const Problem& problem, const ForceParameters& force, const std::vector<Parameter>& parameters) {
  std::vector<std::string> names, values;
  for (const std::size_t b : force.bodies) names.push_back(problem.bodies[b].name);
  bool between = false, to_world = false;
  for (const Parameter& p : parameters) {
    between = between || p.needs_bodies == 2;
    to_world = to_world || p.needs_bodies == 1;
    const auto found = force.values.find(p.key);
    if (found == force.values.end() || (p.need == Parameter::Need::optional && found->second == p.value)) continue;
    values.push_back(
        fmt::format("{} {}{}{}", spaced(p.key), value_words(found->second), p.unit.empty() ? "" : " ", raised(p.unit)));
  }
  std::string kind = spaced(force.kind);
  kind.front() = static_cast<char>(kind.front() - 'a' + 'A');
  if (to_world && names.size() == 1) names.emplace_back("the world");
  const bool pair = (between || force.kind == "point_gravity") && names.size() == 2;
  return fmt::format("{} {} {}{}{}", kind, pair ? "between" : "on", words(first_items(names, 4)),
                     values.empty() ? "" : ": ", fmt::join(values, ", "));
}

std::string force_words(const Problem& problem, const ForceParameters& force) {
  if (force.kind == "uniform_gravity" && force.bodies.size() == problem.moving())
    return fmt::format("Gravity {} m/s² on {}", vector_words(force.vector("acceleration")),
                       problem.moving() == 1 ? "the body" : "all moving bodies");
  const ForceEntry* entry = find_force(force.kind);
  return words_of(problem, force, entry ? entry->kind.parameters : std::vector<Parameter>());
}

std::string joint_words(const Problem& problem, const JointParameters& joint) {
  const JointEntry* entry = find_joint(joint.of.kind);
  return fmt::format("{} ({})", words_of(problem, joint.of, entry ? entry->kind.parameters : std::vector<Parameter>()),
                     joint.name);
}

}  // namespace

std::vector<std::string> scenario_words(const Scenario& scenario) {
  const Problem& problem = scenario.problem;
  std::vector<std::pair<std::string, std::vector<std::string>>> alike;  // text, names
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const std::string text = body_words(scenario, i);
    const auto same = std::find_if(alike.begin(), alike.end(), [&](const auto& a) { return a.first == text; });
    if (same == alike.end()) alike.push_back({text, {problem.bodies[i].name}});
    else same->second.push_back(problem.bodies[i].name);
  }
  std::vector<std::string> lines;
  for (const auto& [text, names] : alike) {
    const std::string who = names.size() < 4
                                ? words(names)
                                : fmt::format("{} to {} ({} bodies)", names.front(), names.back(), names.size());
    lines.push_back(fmt::format("{}: {}{}.", who, names.size() > 1 ? "each " : "", text));
  }
  for (const ForceParameters& force : problem.forces) lines.push_back(force_words(problem, force) + ".");
  if (problem.forces.empty()) lines.emplace_back("No forces act.");
  for (const JointParameters& joint : problem.joints) lines.push_back(joint_words(problem, joint) + ".");
  for (const std::string& note : scenario.notes) {
    lines.push_back(note + ".");
    lines.back().front() = static_cast<char>(std::toupper(lines.back().front()));
  }
  if (lines.size() > most_lines) {
    const std::size_t rest = lines.size() - (most_lines - 1);
    lines.resize(most_lines - 1);
    lines.push_back(fmt::format("{} more bodies, forces and joints are in the scenario’s file.", rest));
  }
  return lines;
}

}  // namespace polhode::study::report::drawing
