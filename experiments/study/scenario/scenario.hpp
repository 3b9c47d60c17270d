// SPDX-License-Identifier: BSD-3-Clause
// Scenarios: TOML files, or the built-in ones, read into a Problem. Keys, units and defaults are in
// experiments/README.md.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collision/contact/collider.hpp"
#include "collision/response.hpp"
#include "core/problem/problem.hpp"

namespace polhode::study::inline scenario {

/// One key of a scenario set from outside: --vary body.0.inertia.1=… or the axis of a study file.
struct Override {
  /// Dotted path; numbers count from 0, a body may be named: "body.0.angular_velocity", "body.box.mass", "gravity.2".
  std::string key;
  std::string value;    ///< TOML text: "0.5", "[0.01, 1, 0.01]"
  std::string place{};  ///< where a study file says so: "study.toml:3:8: vary.body.0.mass"; empty: on the command line
  std::string label() const { return place.empty() ? "--vary " + key : place; }
  bool operator==(const Override& other) const { return key == other.key && value == other.value; }
};

struct Scenario {
  std::string name;  ///< of a built-in one, or the file's stem
  std::string title;
  std::string description;           ///< one line of physics; may be empty
  double t_end = 1;                  ///< s
  Problem problem;                   ///< moving bodies first, in the scenario's order
  std::vector<ShapePointer> shapes;  ///< of each body, contact or not; null where the scenario names none that is known
  std::vector<Collider> colliders;   ///< of each body where the scenario has contact; else empty
  Compliance compliance;             ///< of the surfaces, for a response by forces
  bool end_at_contact = false;       ///< a run ends at its first impact, before it is answered
  std::optional<double> energy_scale;   ///< J, that relative energy drifts are told against; absent: the motion's own
  std::vector<std::string> invariants;  ///< declared beyond energy and momenta; names of core/invariants
  /// Everything that decides how a run goes, and nothing else, as text with every default filled in and numbers that
  /// read back exactly; t_end is not in it, since it is an option of the run. Part of a run's identity.
  std::string canonical;
};

/// A scenario as it was read, from which variants are made.
class ScenarioSource {
 public:
  /// A built-in name, or the path of a file (anything with a '/' or ending in ".toml"). Throws InputError.
  static ScenarioSource open(const std::string& name_or_path, const std::string& label = "--scenario");
  /// For tests and fuzzers: the text itself; `origin` stands for the file in error messages.
  static ScenarioSource parse(std::string text, std::string origin);

  ScenarioSource(ScenarioSource&&) noexcept;
  ScenarioSource& operator=(ScenarioSource&&) noexcept;
  ~ScenarioSource();

  const std::string& name() const;

  /// The scenario with these keys set. Every check is made here, on the result. Throws InputError, which names file,
  /// line, column and key, or "--vary KEY" where an override is at fault.
  Scenario resolve(std::span<const Override> overrides = {}) const;

 private:
  struct Parsed;
  explicit ScenarioSource(std::unique_ptr<Parsed> parsed);
  std::unique_ptr<Parsed> parsed_;
};

}  // namespace polhode::study
