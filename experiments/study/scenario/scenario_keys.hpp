// SPDX-License-Identifier: BSD-3-Clause
// The keys of a scenario and their defaults, for the reader and for overrides. The keys of forces and shapes are in
// their catalogues.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/problem/force_kind.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::inline scenario {

/// The cases in which a key affects results. A key that does not cannot be varied.
enum class Decides { always, with_contact, never };

struct ScenarioKey {
  std::string_view name;
  std::optional<TomlValue> otherwise;  ///< default of the key; absent: it has none of its own
  Decides decides = Decides::always;
};

const std::vector<ScenarioKey>& root_keys();
const std::vector<ScenarioKey>& body_keys();

std::vector<std::string_view> names(const std::vector<ScenarioKey>& keys);
const ScenarioKey* find_key(const std::vector<ScenarioKey>& keys, std::string_view name);

/// The default of a key; the key must have one.
const TomlValue& otherwise(const std::vector<ScenarioKey>& keys, std::string_view name);

TomlValue to_toml(const ParameterValue& value);

/// True for the keys of a scenario that hold a list of tables.
constexpr bool is_list_of_tables(std::string_view key) { return key == "body" || key == "force" || key == "joint"; }

}  // namespace polhode::study::scenario
