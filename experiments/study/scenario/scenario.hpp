// SPDX-License-Identifier: BSD-3-Clause
// Scenarios: TOML files, or the built-in ones, read into a Problem. Keys, units and defaults are in
// experiments/scenarios/README.md.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collision/contact/collider.hpp"
#include "collision/response.hpp"
#include "core/problem/problem.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::inline scenario {

/// One key of a scenario set from outside: by --vary body.0.inertia.1=… or by an axis of a study file.
struct Override {
  /// Dotted path; numbers count from 0, a body may be named: "body.0.angular_velocity", "body.box.mass", "gravity.2".
  std::string key;
  std::string value;    ///< TOML text: "0.5", "[0.01, 1, 0.01]"
  std::string place{};  ///< place in a study file: "study.toml:3:8: vary.body.0.mass"; empty: command line
  std::string label() const { return place.empty() ? "--vary " + key : place; }
  bool operator==(const Override& other) const { return key == other.key && value == other.value; }
};

struct Scenario {
  std::string name;  ///< name of a built-in scenario, or the file's stem
  std::string title;
  std::string description;             ///< one line of physics; may be empty
  double t_end = 1;                    ///< s
  Problem problem;                     ///< moving bodies first, in the scenario's order
  std::vector<ShapePointer> shapes;    ///< shape of each body, contact or not; null if no known shape is named
  std::vector<Collider> colliders;     ///< collider of each body if the scenario has contact; else empty
  Compliance compliance;               ///< compliance of all surfaces, for a response by forces
  bool end_at_contact = false;         ///< a run ends at its first impact, before it is answered
  std::optional<double> energy_scale;  ///< scale of relative energy drifts, J; absent: computed from the motion
  std::vector<std::string>
      invariants;  ///< declared invariants besides energy and momenta; names of core/system/invariants
  /// Notes for a user about the scenario as it was read: bodies that were moved to close joints, joints that repeat
  /// each other's equations. One line each.
  std::vector<std::string> notes;
  std::string contact_text;  ///< the lines of canonical() about contact
  /// The TOML text that it was read from, without the varied keys.
  std::shared_ptr<const std::string> source{};

  /// Everything that affects the results, and nothing else, as text with every default filled in and numbers that read
  /// back exactly. t_end is not included, since it is an option of the run. Part of the identity of a run. Made anew by
  /// each call: most runs need it in the plan alone.
  std::string canonical() const;
};

/// Hash of a scenario's name and of its canonical text.
std::uint64_t number_of(std::string_view name, std::string_view canonical);
inline std::uint64_t number_of(const Scenario& scenario) { return number_of(scenario.name, scenario.canonical()); }

/// A key of a scenario.
struct FoundKey {
  std::string path;                ///< path with bodies by number: "body.0.mass" for body.box.mass
  std::optional<TomlValue> value;  ///< value in the file, else its default; absent: it has neither
};

/// A parsed scenario, from which variants are made.
class ScenarioSource {
 public:
  /// Opens a built-in scenario by name, or a file by path (with a '/' or ending in ".toml"). Throws InputError.
  static ScenarioSource open(const std::string& name_or_path, const std::string& label = "--scenario");
  /// Parses a text, for tests and fuzzers; `origin` replaces the file name in error messages.
  static ScenarioSource parse(std::string text, std::string origin);

  ScenarioSource(ScenarioSource&&) noexcept;
  ScenarioSource& operator=(ScenarioSource&&) noexcept;
  ~ScenarioSource();

  const std::string& name() const;

  /// The key of an override, whose value is not read. Throws InputError if the scenario cannot have the key.
  FoundKey find(const Override& key) const;

  /// The scenario with these keys set. All checks are made here, on the result. Throws InputError, which names file,
  /// line, column and key, or "--vary KEY" if an override is at fault. `plain`: what resolve() gives without overrides,
  /// if the caller has it; most variants are then made faster. Thread-safe.
  Scenario resolve(std::span<const Override> overrides = {}, const Scenario* plain = nullptr) const;

 private:
  struct Parsed;
  explicit ScenarioSource(std::unique_ptr<Parsed> parsed);
  std::unique_ptr<Parsed> parsed_;
};

}  // namespace polhode::study::scenario
