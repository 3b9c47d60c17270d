// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/article/scenario_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "collision/shape.hpp"
#include "core/forces/catalogue.hpp"
#include "core/joints/catalogue.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline article {
namespace {

constexpr std::size_t most_bodies = 12;

std::string vector_text(const Vector3<double>& v) {
  return fmt::format("({}, {}, {})", rounded(v[0]), rounded(v[1]), rounded(v[2]));
}

/// The principal moments of a diagonal matrix; otherwise its upper triangle by rows.
std::string inertia_text(const Matrix3<double>& m) {
  if (m.isDiagonal()) return vector_text(m.diagonal());
  return fmt::format("[{}, {}, {}; {}, {}; {}]", rounded(m(0, 0)), rounded(m(0, 1)), rounded(m(0, 2)), rounded(m(1, 1)),
                     rounded(m(1, 2)), rounded(m(2, 2)));
}

std::string orientation_text(const Quaternion<double>& q) {
  if (q == identity_quaternion<double>()) return "identity";
  return fmt::format("({}, {}, {}, {})", rounded(q[0]), rounded(q[1]), rounded(q[2]), rounded(q[3]));
}

std::string value_text(const ParameterValue& value) {
  if (const auto* x = std::get_if<double>(&value)) return rounded(*x);
  if (const auto* v = std::get_if<Vector3<double>>(&value)) return vector_text(*v);
  return std::get<std::string>(value);
}

}  // namespace

Table table_of_bodies(const Scenario& scenario) {
  using Kind = Column::Kind;
  const Problem& problem = scenario.problem;
  const std::size_t shown = std::min(problem.bodies.size(), most_bodies);
  Table table{.caption = fmt::format(
                  "Bodies of {}; the inertia in body axes, the orientation as a quaternion w, x, y, z", scenario.name),
              .columns = {{.header = "body", .kind = Kind::name, .key = true},
                          {"kind", "", Kind::text},
                          {"mass", "kg"},
                          {"inertia", "kg m²", Kind::text},
                          {"mass centre", "m", Kind::text},
                          {"position", "m", Kind::text},
                          {"orientation", "", Kind::text},
                          {"velocity", "m/s", Kind::text},
                          {"angular velocity", "rad/s", Kind::text},
                          {"in", "", Kind::text}},
              .rows = {}};
  for (std::size_t i = 0; i < shown; ++i) {
    const Body& body = problem.bodies[i];
    const std::string shape =
        i < scenario.shapes.size() && scenario.shapes[i] ? std::string(scenario.shapes[i]->kind()) : "";
    std::string kind = body.fixed ? "static" : body.pinned ? "pinned" : "free";
    if (!shape.empty()) kind += " " + shape;
    std::vector<std::string> row = {body.name, kind};
    if (body.fixed) row.insert(row.end(), {"", ""});
    else row.insert(row.end(), {rounded(body.mass), inertia_text(body.inertia)});
    row.push_back(body.pinned ? vector_text(body.center_of_mass) : "");
    if (i < problem.starts.size()) {
      const BodyStart& start = problem.starts[i];
      row.insert(row.end(), {vector_text(start.position), orientation_text(start.orientation)});
      if (body.fixed) row.insert(row.end(), {"", "", ""});
      else
        row.insert(row.end(), {vector_text(start.velocity), vector_text(start.angular_velocity),
                               start.angular_velocity_in_body ? "body axes" : "world axes"});
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
  }
  if (shown < problem.bodies.size())
    table.caption += fmt::format("; the first {} of {} bodies", shown, problem.bodies.size());
  return without_empty_columns(std::move(table));
}

/// A table of forces or of joints: what, on which bodies, with which parameters.
Table table_of(const Scenario& scenario, const std::string& what, const std::string& caption) {
  using Kind = Column::Kind;
  Table table{.caption = fmt::format("{} of {}", caption, scenario.name),
              .columns = {{.header = what, .kind = Kind::name, .key = true},
                          {.header = "on", .kind = Kind::text, .key = true},
                          {.header = "parameter", .kind = Kind::name, .key = true},
                          {"value", "", Kind::text},
                          {"unit", "", Kind::text},
                          {"meaning", "", Kind::text}},
              .rows = {}};
  const auto add = [&](const ForceParameters& force, const std::vector<Parameter>& parameters) {
    std::vector<std::string> bodies;
    for (const std::size_t b : force.bodies) bodies.push_back(scenario.problem.bodies[b].name);
    std::string kind = force.kind, on = words(first_items(bodies, 4));
    for (const Parameter& parameter : parameters) {
      const auto found = force.values.find(parameter.key);
      if (found == force.values.end()) continue;
      table.rows.push_back({kind, on, parameter.key, value_text(found->second), parameter.unit, parameter.meaning});
      kind.clear(), on.clear();  // once for each force
    }
    if (parameters.empty()) table.rows.push_back({kind, on, "", "", "", ""});
  };
  if (what == "force") {
    for (const ForceParameters& force : scenario.problem.forces) {
      if (const ForceEntry* entry = find_force(force.kind)) add(force, entry->kind.parameters);
    }
  } else {
    for (const JointParameters& joint : scenario.problem.joints) {
      if (const JointEntry* entry = find_joint(joint.of.kind)) add(joint.of, entry->kind.parameters);
    }
  }
  return table;
}

Table table_of_forces(const Scenario& scenario) { return table_of(scenario, "force", "Forces"); }
Table table_of_joints(const Scenario& scenario) { return table_of(scenario, "joint", "Joints"); }

}  // namespace polhode::study::report::article
