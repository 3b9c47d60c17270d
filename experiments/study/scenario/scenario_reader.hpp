// SPDX-License-Identifier: BSD-3-Clause
// Reads the tree of a scenario into a Problem, with every check.
#pragma once

#include <string>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::inline scenario {

/// Reads the tree. `name` is the name of the scenario, and its title if it has none. Throws a Fault.
Scenario read_scenario(const TomlValue& root, const std::string& name);

}  // namespace polhode::study::scenario
