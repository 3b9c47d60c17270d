// SPDX-License-Identifier: BSD-3-Clause
#include "core/forces/catalogue.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/forces/constant_force.hpp"
#include "core/forces/constant_torque.hpp"
#include "core/forces/damper.hpp"
#include "core/forces/drag.hpp"
#include "core/forces/lane_force.hpp"
#include "core/forces/point_gravity.hpp"
#include "core/forces/spring.hpp"
#include "core/forces/uniform_gravity.hpp"
#include "core/problem/catalogue.hpp"

namespace polhode::inline core::inline forces {

const std::vector<ForceEntry>& force_catalogue() {
  // One line for each force.
  // clang-format off
  static const std::vector<ForceEntry> entries = {
      force_entry<UniformGravity, in_lanes>(),
      force_entry<PointGravity>(),
      force_entry<Spring, in_lanes>(),
      force_entry<Damper, in_lanes>(),
      force_entry<Drag, in_lanes>(),
      force_entry<ConstantForce, in_lanes>(),
      force_entry<ConstantTorque, in_lanes>(),
  };
  // clang-format on
  return entries;
}

const ForceEntry* find_force(std::string_view name) {
  return find_entry(force_catalogue(), name, [](const auto& entry) -> std::string_view { return entry.kind.name; });
}

namespace {
const ForceEntry& entry_of(const ForceParameters& parameters) {
  const ForceEntry* entry = find_force(parameters.kind);
  if (!entry) throw std::invalid_argument("no force of the kind '" + parameters.kind + "'");
  return *entry;
}
}  // namespace

template <>
ForcePointer<float> make_force<float>(const ForceParameters& p, std::span<const Body> bodies) {
  return entry_of(p).make_float(p, bodies);
}
template <>
ForcePointer<double> make_force<double>(const ForceParameters& p, std::span<const Body> bodies) {
  return entry_of(p).make_double(p, bodies);
}
template <>
ForcePointer<long double> make_force<long double>(const ForceParameters& p, std::span<const Body> bodies) {
  return entry_of(p).make_long_double(p, bodies);
}

ForcePointer<Lanes> make_force_in_lanes(std::span<const Problem> problems, std::size_t k) {
  const Problem& first = problems.front();
  const auto same = [&](const Problem& p) {
    const Body &a = first.bodies.front(), &b = p.bodies.front();
    return p.forces[k].values == first.forces[k].values && a.mass == b.mass && a.inertia == b.inertia;
  };
  const ForceEntry& entry = entry_of(first.forces[k]);
  if (entry.make_lanes && std::all_of(problems.begin(), problems.end(), same)) {
    return entry.make_lanes(first.forces[k], first.bodies);
  }
  return std::make_unique<LaneForce>(problems, k);
}

}  // namespace polhode::core::forces
