// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/canonical_text.hpp"

#include <algorithm>

#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline scenario {

namespace {

class Line {
 public:
  Line(std::string& out, std::string_view first) : out_(out) { out_.append(first); }
  ~Line() { out_ += '\n'; }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  void add(std::string_view key, double x) { add_exact(start(key), x); }
  void add(std::string_view key, std::string_view text) { start(key).append(text); }
  void add(std::string_view key, bool flag) { start(key).append(flag ? "true" : "false"); }
  template <class Derived>
  void add(std::string_view key, const Eigen::MatrixBase<Derived>& numbers) {
    start(key);
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      if (i > 0) out_ += ',';
      add_exact(out_, numbers(i / numbers.cols(), i % numbers.cols()));
    }
  }

 private:
  std::string& start(std::string_view key) {
    out_ += ' ';
    out_.append(key);
    out_ += '=';
    return out_;
  }

  std::string& out_;
};

void write_body(const Body& body, const BodyStart& start, std::string& out) {
  Line line(out, "body");
  line.add("mass", body.mass);
  line.add("static", body.fixed);
  line.add("position", start.position);
  line.add("orientation", start.orientation);
  if (body.fixed) return;
  line.add("inertia", body.inertia);
  line.add("pinned", body.pinned);
  line.add("center_of_mass", body.center_of_mass);
  line.add("velocity", start.velocity);
  line.add("angular_velocity", start.angular_velocity);
  line.add("frame", std::string_view(start.angular_velocity_in_body ? "body" : "world"));
}

void write_force(const ForceParameters& force, std::string& out, const std::string& before = "") {
  Line line(out, before + force.kind);
  std::string bodies;
  for (const std::size_t i : force.bodies) bodies.append(bodies.empty() ? "" : ",").append(std::to_string(i));
  line.add("bodies", std::string_view(bodies));
  for (const auto& parameter : force.values) {  // sorted by key
    std::visit([&](const auto& value) { line.add(parameter.first, value); }, parameter.second);
  }
}

}  // namespace

std::string canonical_collider(const Collider& collider, const std::map<std::string, ParameterValue>& sizes) {
  std::string out;
  {
    Line line(out, collider.shape->kind());
    for (const auto& size : sizes) std::visit([&](const auto& value) { line.add(size.first, value); }, size.second);
    line.add("restitution", collider.restitution);
    line.add("friction", collider.friction);
  }
  return out;
}

void add_canonical_text(const Problem& problem, const std::vector<std::string>& invariants, std::string& out) {
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) write_body(problem.bodies[i], problem.starts[i], out);
  for (const ForceParameters& force : problem.forces) write_force(force, out);
  for (const JointParameters& joint : problem.joints) write_force(joint.of, out, "joint ");
  std::vector<std::string_view> sorted(invariants.begin(), invariants.end());
  std::sort(sorted.begin(), sorted.end());
  for (const std::string_view name : sorted) out.append("invariant ").append(name).append("\n");
}

}  // namespace polhode::study::scenario
