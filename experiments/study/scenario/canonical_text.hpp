// SPDX-License-Identifier: BSD-3-Clause
// The canonical text of a scenario: everything that decides how a run goes, one line for each body and force.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "collision/contact/collider.hpp"
#include "core/problem/problem.hpp"

namespace polhode::study::inline scenario {

/// What Scenario::canonical holds. Bodies and forces in their order, the keys of a force and the invariants sorted.
std::string canonical_text(const Problem& problem, const std::vector<std::string>& invariants);

/// The line of a body that can touch, with the sizes of its shape.
std::string canonical_collider(const Collider& collider, const std::map<std::string, ParameterValue>& sizes);

}  // namespace polhode::study
