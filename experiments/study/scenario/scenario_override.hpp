// SPDX-License-Identifier: BSD-3-Clause
// Sets one key of a scenario's tree: "body.0.inertia.1", "body.box.mass", "force.0.stiffness", "gravity.2".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::inline scenario {

/// Sets the key, which may be absent if it has a default. `index` (of the override) becomes the place of the new value.
/// The reader of the result checks the value. Returns the path with bodies by number. Throws a Fault that belongs to
/// the override.
std::string apply_override(TomlValue& root, const Override& override, int index);

/// Puts back what apply_override() changed in a tree that was like `root` before. `path` as apply_override() returned
/// it.
void undo_override(TomlValue& tree, const TomlValue& root, std::string_view path);

/// The value of a key in the tree of a scenario, or its default; absent if it has neither. `path` as apply_override()
/// returns it.
std::optional<TomlValue> value_at(const TomlValue& root, const std::string& path);

}  // namespace polhode::study::scenario
