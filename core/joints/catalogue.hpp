// SPDX-License-Identifier: BSD-3-Clause
// The catalogue of joints: the kinds that a scenario may name under [[joint]].
#pragma once

#include <string_view>
#include <vector>

#include "core/problem/joint_kind.hpp"

namespace polhode::inline core::inline joints {

const std::vector<JointEntry>& joint_catalogue();

/// The entry of that name, or null.
const JointEntry* find_joint(std::string_view name);

/// Builds a joint on the scalar S from its parameters. Kinds are checked by the reader of scenarios.
template <class S>
JointPointer<S> make_joint(const JointParameters& parameters, std::span<const BodyStart> starts);

}  // namespace polhode::core::joints
