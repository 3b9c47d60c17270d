// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/scenario_reader.hpp"

#include <algorithm>
#include <map>

#include "core/forces/catalogue.hpp"
#include "core/system/invariants.hpp"
#include "experiments/study/scenario/body_index.hpp"
#include "experiments/study/scenario/body_reader.hpp"
#include "experiments/study/scenario/body_repeat.hpp"
#include "experiments/study/scenario/joint_reader.hpp"
#include "experiments/study/scenario/parameter_reader.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/toml_cursor.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline scenario {

namespace {

TomlCursor key(const TomlCursor& root, std::string_view name) { return root.at(name, otherwise(root_keys(), name)); }

// Bodies.

std::vector<ReadBody> read_all_bodies(const TomlCursor& list, bool contact) {
  const std::size_t tables = list.list("a list of tables, each under its own [[body]]");
  std::vector<ReadBody> bodies;
  std::map<std::string, std::size_t> named;  // number of the table of each name
  for (std::size_t i = 0; i < tables; ++i) {
    const TomlCursor table = list.item(i);
    for (ReadBody& body : repeated(table, i, read_body(table, i, contact))) {
      const auto [known, is_new] = named.emplace(body.body.name, i);
      const TomlCursor name = table.at("name", table.value());
      if (!is_new) {
        name.fail("body " + std::to_string(known->second) + " is called '" + known->first +
                  "' already; names must differ");
      }
      bodies.push_back(std::move(body));
    }
  }
  return bodies;
}

/// Reads the bodies. With contact, shapes that can touch go into the scenario too, and their lines of canonical text.
BodyIndex read_bodies(const TomlCursor& root, Scenario& scenario) {
  Problem& problem = scenario.problem;
  const TomlCursor contact = key(root, "contact");
  const TomlCursor list = root.at("body", "a list of tables, each under its own [[body]]");
  std::vector<ReadBody> bodies = read_all_bodies(list, contact.boolean());
  std::stable_partition(bodies.begin(), bodies.end(), [](const ReadBody& b) { return !b.body.fixed; });
  if (bodies.front().body.fixed) list.fail("every body is static; at least one must move");
  BodyIndex index;
  for (ReadBody& b : bodies) {
    index.emplace(b.body.name, NamedBody{problem.bodies.size(), b.has_mass});
    problem.bodies.push_back(std::move(b.body));
    problem.starts.push_back(b.start);
    scenario.shapes.push_back(std::move(b.shape));
    if (!contact.value().boolean) continue;
    scenario.contact_text += "contact " + (b.collider.shape ? b.canonical_collider : std::string("none\n"));
    scenario.colliders.push_back(std::move(b.collider));
  }
  const auto touches = [](const Collider& c) { return c.shape != nullptr; };
  if (contact.value().boolean && std::count_if(scenario.colliders.begin(), scenario.colliders.end(), touches) < 2) {
    contact.fail("needs two bodies with a shape");
  }
  const TomlCursor end = key(root, "end_at_contact");
  scenario.end_at_contact = end.boolean();
  if (!scenario.end_at_contact) return index;
  if (!contact.value().boolean) end.fail("needs contact = true");
  scenario.contact_text += "end_at_contact\n";
  return index;
}

/// Its lines in `canonical`, where it is not as it always was.
Compliance read_compliance(const TomlCursor& root, std::string& canonical) {
  Compliance compliance;
  for (const char* name : {"contact_stiffness", "contact_slip_speed"}) {
    if (!root.has(name)) continue;
    const TomlCursor given = root.at(name, "");
    if (!key(root, "contact").boolean()) given.fail("means nothing without contact = true");
  }
  if (root.has("contact_stiffness")) {
    compliance.stiffness = root.at("contact_stiffness", "").number("N/m", Parameter::Range::positive);
    canonical += "stiffness " + exact(compliance.stiffness) + "\n";
  }
  const double otherwise = compliance.slip_speed;
  compliance.slip_speed = key(root, "contact_slip_speed").number("m/s", Parameter::Range::positive);
  if (compliance.slip_speed != otherwise) canonical += "slip_speed " + exact(compliance.slip_speed) + "\n";
  return compliance;
}

// Forces.

void read_gravity(const TomlCursor& root, Problem& problem) {
  const Vector3<double> g = key(root, "gravity").vector("m/s^2");
  if (g.isZero(0)) return;
  ForceParameters force{"uniform_gravity", {}, {{"acceleration", g}}};
  for (std::size_t i = 0; i < problem.moving(); ++i) force.bodies.push_back(i);
  problem.forces.push_back(std::move(force));
}

const ForceKind& read_force_kind(const TomlCursor& force) {
  const TomlCursor name = force.at("kind", "the name of a force");
  if (const ForceEntry* entry = find_force(name.text("the name of a force"))) return entry->kind;
  std::vector<std::string_view> known;
  for (const ForceEntry& entry : force_catalogue()) known.push_back(entry.kind.name);
  name.unknown("force", "There are", known);
}

std::string count_in_words(const ForceKind& kind) {
  const std::string least = std::to_string(kind.min_bodies);
  if (kind.max_bodies == 0) return least + " or more bodies";
  if (kind.max_bodies == kind.min_bodies) return least + (kind.min_bodies == 1 ? " body" : " bodies");
  return least + " to " + std::to_string(kind.max_bodies) + " bodies";
}

std::vector<std::size_t> read_force_bodies(const TomlCursor& force, const ForceKind& kind, const BodyIndex& index) {
  const std::string must_be = "a list of the names of " + count_in_words(kind);
  const TomlCursor list = force.at("bodies", must_be);
  const std::size_t n = list.list(must_be);
  if (n < static_cast<std::size_t>(kind.min_bodies) ||
      (kind.max_bodies != 0 && n > static_cast<std::size_t>(kind.max_bodies))) {
    list.fail("a " + kind.name + " acts on " + count_in_words(kind) + ", and this one names " + std::to_string(n));
  }
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < n; ++i) {
    const TomlCursor name = list.item(i);
    const auto [body, has_mass] = read_body_name(name, index);
    if (std::find(bodies.begin(), bodies.end(), body) != bodies.end()) {
      name.fail("the body '" + name.value().text + "' is named twice; a force takes each body once");
    }
    if (!has_mass && kind.name == "point_gravity") {
      name.fail("the static body '" + name.value().text + "' is given no mass, which this force needs");
    }
    bodies.push_back(body);
  }
  return bodies;
}

/// A force between two bodies needs one that moves; a force on each of its bodies needs each of them to.
void check_that_they_move(const TomlCursor& force, const ForceKind& kind, const Problem& problem,
                          const std::vector<std::size_t>& bodies) {
  const TomlCursor list = force.at("bodies", "");
  const std::size_t moving = problem.moving();
  const auto is_static = [&](std::size_t body) { return body >= moving; };
  if (std::all_of(bodies.begin(), bodies.end(), is_static)) {
    list.fail("only static bodies, which no force moves; name one that moves");
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const TomlCursor name = list.item(i);
    if (kind.max_bodies == 0 && is_static(bodies[i])) {
      name.fail("the body '" + name.value().text + "' is static, and no force moves it; leave it out");
    }
  }
}

void read_force(const TomlCursor& force, const BodyIndex& index, Problem& problem) {
  if (force.value().type != TomlValue::Type::table) force.refuse("a table under [[force]]");
  const ForceKind& kind = read_force_kind(force);
  ForceParameters parameters{kind.name, {}, {}};
  const std::size_t named = force.has("bodies") ? force.at("bodies", "").value().items.size() : 0;
  parameters.values = read_parameters(force, kind.parameters, {"kind", "bodies"}, "A " + kind.name + " has", named);
  parameters.bodies = read_force_bodies(force, kind, index);
  check_that_they_move(force, kind, problem, parameters.bodies);
  problem.forces.push_back(std::move(parameters));
}

void read_forces(const TomlCursor& root, const BodyIndex& index, Problem& problem) {
  if (!root.has("force")) return;
  const TomlCursor list = root.at("force", "");
  const std::size_t n = list.list("a list of tables, each under its own [[force]]");
  for (std::size_t i = 0; i < n; ++i) {
    const TomlCursor force = list.item(i);
    read_force(force, index, problem);
  }
}

// Invariants.

std::vector<std::string> read_invariants(const TomlCursor& root, const Problem& problem) {
  const TomlCursor list = key(root, "invariants");
  std::vector<std::string> declared;
  if (list.value().type == TomlValue::Type::list && list.value().items.empty()) return declared;
  const std::size_t n = list.list("a list of names of invariants");
  for (std::size_t i = 0; i < n; ++i) {
    const TomlCursor name = list.item(i);
    const std::string& text = name.text("the name of an invariant");
    const InvariantKind* kind = find_invariant(text);
    if (!kind) {
      std::vector<std::string_view> known;
      for (const InvariantKind& each : invariant_catalogue()) known.push_back(each.name);
      name.unknown("invariant", "There are", known);
    }
    if (std::find(declared.begin(), declared.end(), text) != declared.end()) name.fail(text + " is named twice");
    if (const std::string reason = kind->refusal(problem); !reason.empty()) {
      name.fail(text + " is no invariant of this scenario: " + reason);
    }
    declared.push_back(text);
  }
  return declared;
}

}  // namespace

void complete(Scenario& scenario, const TomlCursor& root) {
  scenario.invariants = read_invariants(root, scenario.problem);
  if (root.has("energy_scale"))
    scenario.energy_scale = root.at("energy_scale", "").number("J", Parameter::Range::positive);
}

Scenario read_scenario(const TomlValue& tree, const std::string& name) {
  const TomlCursor root(tree);
  static const std::vector<std::string_view> known = names(root_keys());
  root.table("A scenario has", known);
  Scenario scenario;
  scenario.name = name;
  scenario.title = root.has("title") ? root.at("title", "").text("a text of one line") : name;
  scenario.description = key(root, "description").text("a text of one line");
  scenario.t_end = root.at("t_end", "a positive number of s").number("s", Parameter::Range::positive);
  const BodyIndex index = read_bodies(root, scenario);
  scenario.compliance = read_compliance(root, scenario.contact_text);
  read_gravity(root, scenario.problem);
  read_forces(root, index, scenario.problem);
  read_joints(root, index, scenario);
  complete(scenario, root);
  return scenario;
}

}  // namespace polhode::study::scenario
