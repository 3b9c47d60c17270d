// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/joint_reader.hpp"

#include <algorithm>
#include <cmath>

#include "core/joints/catalogue.hpp"
#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "experiments/study/scenario/parameter_reader.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline scenario {
namespace {

constexpr double closed_to = 1e-9;  // opening of a closed joint and its rate: m, rad, m/s, rad/s

const JointKind& read_joint_kind(const TomlCursor& joint) {
  const TomlCursor name = joint.at("kind", "the name of a kind of joint");
  if (const JointEntry* entry = find_joint(name.text("the name of a kind of joint"))) return entry->kind;
  std::vector<std::string_view> known;
  for (const JointEntry& entry : joint_catalogue()) known.push_back(entry.kind.name);
  name.unknown("joint", "There are", known);
}

std::vector<std::size_t> read_bodies(const TomlCursor& joint, const BodyIndex& index, std::size_t moving) {
  const std::string must_be = "a list of the names of one body, joined to the world, or of two";
  const TomlCursor list = joint.at("bodies", must_be);
  const std::size_t n = list.list(must_be);
  if (n > 2) list.fail("a joint has one body, joined to the world, or two, and this one names " + std::to_string(n));
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < n; ++i) {
    const TomlCursor name = list.item(i);
    const std::size_t body = read_body_name(name, index).index;
    if (!bodies.empty() && bodies.front() == body) {
      name.fail("both ends are on the body '" + name.value().text +
                "'; name two bodies, or one to join it to the world");
    }
    bodies.push_back(body);
  }
  if (std::all_of(bodies.begin(), bodies.end(), [&](std::size_t b) { return b >= moving; })) {
    list.fail(n == 1 ? "a static body cannot be joined to the world; name a body that moves"
                     : "both bodies are static; name at least one that moves");
  }
  return bodies;
}

/// A direction of a joint must not be zero.
void check_directions(const TomlCursor& table, const ForceParameters& values) {
  for (const char* key : {"axis_body", "axis_body_2", "normal"}) {
    if (!table.has(key) || !values.vector(key).isZero(0)) continue;
    if (values.kind == "rolling" && std::string_view(key) == "axis_body") continue;  // a sphere
    const TomlCursor direction = table.at(key, "");
    direction.fail("a direction of length 0; give an axis such as [0, 0, 1]");
  }
}

JointParameters read_joint(const TomlCursor& table, std::size_t number, const BodyIndex& index,
                           const Problem& problem) {
  if (table.value().type != TomlValue::Type::table) table.refuse("a table under [[joint]]");
  const JointKind& kind = read_joint_kind(table);
  JointParameters joint;
  joint.name = table.has("name") ? table.at("name", "").text("a text of one line") : "joint" + std::to_string(number);
  joint.of.kind = kind.name;
  joint.of.bodies = read_bodies(table, index, problem.moving());
  joint.of.values = read_parameters(table, kind.parameters, {"name", "kind", "bodies"}, "A " + kind.name + " has",
                                    joint.of.bodies.size());
  check_directions(table, joint.of);
  for (const JointParameters& other : problem.joints) {
    if (other.name != joint.name) continue;
    const TomlCursor name = table.at("name", table.value());
    name.fail("another joint is called '" + joint.name + "' already; names must differ");
  }
  return joint;
}

/// The largest violation of a joint as text: "open by 0.01 m"; empty if the joint is closed.
std::string open_by(const Constraints<double>::Violation& v) {
  const auto text = [](const char* word, double size, const char* unit) {
    return std::string(word) + number(size, 3) + " " + unit;
  };
  if (!(v.position <= closed_to)) return text("open by ", v.position, "m");
  if (!(v.angle <= closed_to)) return text("open by ", v.angle, "rad");
  if (!(v.velocity <= closed_to)) return text("opening at ", v.velocity, "m/s");
  if (!(v.rate <= closed_to)) return text("opening at ", v.rate, "rad/s");
  return "";
}

/// Moves the starts to the projected state, and notes by how much.
void assemble(const System<double>& system, Scenario& scenario) {
  VectorX<double> y = system.start().y;
  project_joint_positions(system, y);
  project_joint_velocities(system, y);
  Problem& problem = scenario.problem;
  for (std::size_t i = 0; i < problem.moving(); ++i) {
    BodyStart& start = problem.starts[i];
    const BodyMotion<double> before = system.motion_of(system.start().y, i), now = system.motion_of(y, i);
    const BodySnapshot<double> snapshot = system.snapshot(y, i);
    const double shift = (now.position - before.position).norm();
    const double turn = angle_between(start.orientation, snapshot.orientation);
    const double speed = (now.velocity - before.velocity).norm();
    const double spin = (now.angular_velocity - before.angular_velocity).norm();
    if (std::max({shift, turn, speed, spin}) <= closed_to) continue;
    scenario.notes.push_back("assemble moved the body '" + problem.bodies[i].name + "' by " + number(shift, 3) +
                             " m and " + number(turn, 3) + " rad, and changed its velocities by " + number(speed, 3) +
                             " m/s and " + number(spin, 3) + " rad/s");
    start.orientation = snapshot.orientation;
    if (!problem.bodies[i].pinned) {
      start.position = now.position;
      start.velocity = now.velocity;
    }
    start.angular_velocity = now.angular_velocity;
    start.angular_velocity_in_body = false;
  }
}

void note_rank(const ConstraintRank& rank, Scenario& scenario) {
  if (rank.rank == rank.rows) return;
  std::string joints;
  for (const std::string& name : rank.dependent) joints += (joints.empty() ? "" : ", ") + name;
  scenario.notes.push_back("the joints have rank " + std::to_string(rank.rank) + " of " + std::to_string(rank.rows) +
                           ": " + joints + (rank.dependent.size() == 1 ? " repeats" : " repeat") +
                           " what others demand; reactions are those of least norm");
}

}  // namespace

void read_joints(const TomlCursor& root, const BodyIndex& index, Scenario& scenario) {
  const TomlCursor assembling = root.at("assemble", otherwise(root_keys(), "assemble"));
  const bool assembled = assembling.boolean();
  if (!root.has("joint")) {
    if (assembled) assembling.fail("means nothing without a [[joint]]");
    return;
  }
  const TomlCursor list = root.at("joint", "");
  const std::size_t n = list.list("a list of tables, each under its own [[joint]]");
  Problem& problem = scenario.problem;
  for (std::size_t i = 0; i < n; ++i) {
    const TomlCursor table = list.item(i);
    problem.joints.push_back(read_joint(table, i, index, problem));
  }
  if (assembled) assemble(*make_system<double>(problem, {}), scenario);
  const auto system = make_system<double>(problem, {});
  const auto motions = motions_of(*system, system->start().y);
  for (std::size_t i = 0; i < n; ++i) {
    const std::string open = open_by(system->constraints()->violation(i, motions));
    if (open.empty()) continue;
    const TomlCursor table = list.item(i);
    const std::string joint = "the joint '" + problem.joints[i].name + "' is " + open + " at the start; ";
    table.fail(joint + (assembled ? "no start near the given one closes all joints, so that some contradict each other"
                                  : "move its bodies, or set assemble = true, which moves them to the nearest start "
                                    "that closes all joints"));
  }
  if (system->constraints()->dependent()) note_rank(system->constraints()->rank(motions), scenario);
}

}  // namespace polhode::study::scenario
