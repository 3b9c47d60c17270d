// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/scenario_keys.hpp"

#include <algorithm>

#include "collision/response.hpp"

namespace polhode::study::inline scenario {

namespace {

TomlValue zero() { return TomlValue::of({0, 0, 0}); }
TomlValue empty_list() { return TomlValue::of(std::vector<double>{}); }

}  // namespace

const std::vector<ScenarioKey>& root_keys() {
  static const std::vector<ScenarioKey> keys = {
      {"title", std::nullopt, Decides::never},  // the scenario's name
      {"description", TomlValue::of(""), Decides::never},
      {"gravity", zero()},
      {"t_end", std::nullopt},
      {"invariants", empty_list()},
      {"energy_scale", std::nullopt},                     // the scale of the motion itself
      {"contact", TomlValue::of(false), Decides::never},  // false, as scenarios without the key have always been
      {"end_at_contact", TomlValue::of(false), Decides::with_contact},
      {"contact_stiffness", std::nullopt, Decides::with_contact},  // the stiffness follows from the masses
      {"contact_slip_speed", TomlValue::of(Compliance{}.slip_speed), Decides::with_contact},
      {"body", std::nullopt},
      {"force", empty_list()},
      {"joint", empty_list()},
      {"assemble", TomlValue::of(false)},
  };
  return keys;
}

const std::vector<ScenarioKey>& body_keys() {
  static const std::vector<ScenarioKey> keys = {
      {"name", std::nullopt, Decides::never},  // body0, body1, …
      {"mass", std::nullopt},
      {"shape", std::nullopt},
      {"inertia", std::nullopt},
      {"unphysical_inertia", TomlValue::of(false)},
      {"point_masses", std::nullopt},
      {"position", zero()},
      {"orientation", TomlValue::of({1, 0, 0, 0})},
      {"velocity", zero()},
      {"angular_velocity", zero()},
      {"angular_velocity_frame", TomlValue::of("world")},
      {"pinned", TomlValue::of(false)},
      {"center_of_mass", zero()},
      {"static", TomlValue::of(false)},
      {"restitution", TomlValue::of(0.0), Decides::with_contact},
      {"friction", TomlValue::of(0.0), Decides::with_contact},
      {"repeat", std::nullopt},
      {"spacing", zero()},
      {"jitter", TomlValue::of(0.0)},
      {"jitter_angle", TomlValue::of(0.0)},
  };
  return keys;
}

std::vector<std::string_view> names(const std::vector<ScenarioKey>& keys) {
  std::vector<std::string_view> all;
  for (const ScenarioKey& key : keys) all.push_back(key.name);
  return all;
}

const ScenarioKey* find_key(const std::vector<ScenarioKey>& keys, std::string_view name) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const ScenarioKey& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

const TomlValue& otherwise(const std::vector<ScenarioKey>& keys, std::string_view name) {
  return find_key(keys, name)->otherwise.value();
}

TomlValue to_toml(const ParameterValue& value) {
  if (const double* number = std::get_if<double>(&value)) return TomlValue::of(*number);
  if (const std::string* text = std::get_if<std::string>(&value)) return TomlValue::of(*text);
  const auto& v = std::get<Vector3<double>>(value);
  return TomlValue::of({v[0], v[1], v[2]});
}

}  // namespace polhode::study::scenario
