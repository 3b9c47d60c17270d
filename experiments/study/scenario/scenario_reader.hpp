// SPDX-License-Identifier: BSD-3-Clause
// Reads the tree of a scenario into a Problem, with every check.
#pragma once

#include <string>
#include <string_view>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/toml_cursor.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::inline scenario {

/// Reads the tree. `name` is the name of the scenario, and its title if it has none. Throws a Fault.
Scenario read_scenario(const TomlValue& root, const std::string& name);

/// The last step of reading, when bodies, forces and joints are read: sets the invariants and the scale of the energy.
/// Throws a Fault.
void complete(Scenario& scenario, const TomlCursor& root);

}  // namespace polhode::study::scenario
