// SPDX-License-Identifier: BSD-3-Clause
// A variant of a scenario made from the scenario itself. Large studies vary numbers of single bodies, and to read these
// again takes a fraction of the time of reading all.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::inline scenario {

/// What read_scenario() makes of `tree`, in which these keys differ from the tree of `plain`. Paths as apply_override()
/// returns them. Absent if it must be read in full: to say what is wrong, or since a key may affect more than its body.
std::optional<Scenario> variant_of(const Scenario& plain, const TomlValue& tree, std::span<const std::string> paths);

}  // namespace polhode::study::scenario
