// SPDX-License-Identifier: BSD-3-Clause
#include "core/joints/catalogue.hpp"

#include <stdexcept>
#include <type_traits>

#include "core/joints/ball.hpp"
#include "core/joints/distance.hpp"
#include "core/joints/fixed.hpp"
#include "core/joints/hinge.hpp"
#include "core/joints/pin.hpp"
#include "core/joints/planar.hpp"
#include "core/joints/rolling.hpp"
#include "core/joints/slider.hpp"
#include "core/joints/universal.hpp"
#include "core/problem/catalogue.hpp"

namespace polhode::inline core::inline joints {

const std::vector<JointEntry>& joint_catalogue() {
  // One line for each joint.
  // clang-format off
  static const std::vector<JointEntry> entries = {
      joint_entry<Ball>(),
      joint_entry<Hinge>(),
      joint_entry<Slider>(),
      joint_entry<Universal>(),
      joint_entry<Fixed>(),
      joint_entry<Distance>(),
      joint_entry<Planar>(),
      joint_entry<Pin>(),
      joint_entry<Rolling>(),
  };
  // clang-format on
  return entries;
}

const JointEntry* find_joint(std::string_view name) {
  return find_entry(joint_catalogue(), name, [](const auto& entry) -> std::string_view { return entry.kind.name; });
}

template <class S>
JointPointer<S> make_joint(const JointParameters& p, std::span<const BodyStart> starts) {
  const JointEntry* entry = find_joint(p.of.kind);
  if (!entry) throw std::invalid_argument("no joint of the kind '" + p.of.kind + "'");
  if constexpr (std::is_same_v<S, float>) return entry->make_float(p, starts);
  else if constexpr (std::is_same_v<S, double>) return entry->make_double(p, starts);
  else return entry->make_long_double(p, starts);
}

template JointPointer<float> make_joint(const JointParameters&, std::span<const BodyStart>);
template JointPointer<double> make_joint(const JointParameters&, std::span<const BodyStart>);
template JointPointer<long double> make_joint(const JointParameters&, std::span<const BodyStart>);

}  // namespace polhode::core::joints
