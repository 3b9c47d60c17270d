// SPDX-License-Identifier: BSD-3-Clause
// The scenarios of experiments/scenarios/, compiled in, so that a program finds them in any folder.
#pragma once

#include <span>
#include <string_view>

namespace polhode::study::inline scenario {

struct BuiltinScenario {
  std::string_view name;  // the file's name without .toml
  std::string_view text;  // the file's contents
};

// Sorted by name.
std::span<const BuiltinScenario> builtin_scenarios();

}  // namespace polhode::study::scenario
