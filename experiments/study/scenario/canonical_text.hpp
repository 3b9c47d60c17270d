// SPDX-License-Identifier: BSD-3-Clause
// The canonical text of a scenario: everything that affects its results, one line for each body and force.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "collision/contact/collider.hpp"
#include "core/problem/problem.hpp"

namespace polhode::study::inline scenario {

/// Adds the text of Scenario::canonical(), but for contact and the scale of the energy, to `out`. Bodies and forces are
/// in their order; the keys of a force and the invariants are sorted.
void add_canonical_text(const Problem& problem, const std::vector<std::string>& invariants, std::string& out);

/// The line of a body that can collide, with the sizes of its shape.
std::string canonical_collider(const Collider& collider, const std::map<std::string, ParameterValue>& sizes);

}  // namespace polhode::study::scenario
