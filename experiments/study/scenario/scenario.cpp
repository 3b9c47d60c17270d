// SPDX-License-Identifier: BSD-3-Clause
// Opening scenarios, and reporting errors in them.
#include "experiments/study/scenario/scenario.hpp"

#include <filesystem>

#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/canonical_text.hpp"
#include "experiments/study/scenario/scenario_override.hpp"
#include "experiments/study/scenario/scenario_reader.hpp"
#include "experiments/study/scenario/scenario_variant.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/text_hash.hpp"
#include "experiments/study/text/toml_cursor.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline scenario {

struct ScenarioSource::Parsed {
  std::string name;
  std::string origin;  ///< name in messages: the path as the user gave it, or "builtin NAME"
  std::shared_ptr<const std::string> text;
  std::shared_ptr<const TomlValue> root;

  Parsed(std::string given_name, std::string given_origin, std::string_view given_text)
      : name(std::move(given_name)),
        origin(std::move(given_origin)),
        text(std::make_shared<const std::string>(given_text)),
        root(std::make_shared<const TomlValue>(parsed())) {}

  TomlValue parsed() const {
    try {
      return parse_toml(*text);
    } catch (const TomlSyntaxError& error) {
      throw InputError(at(error.place) + error.message);
    }
  }

  std::string at(TomlPlace place) const {
    return origin + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": ";
  }

  Scenario resolve(std::span<const Override> overrides, const Scenario* plain) const;
  [[noreturn]] void tell(const Fault& fault, std::span<const Override> overrides,
                         const std::vector<std::string>& paths) const;
  bool sound_by_itself() const;
};

namespace {

constexpr std::string_view list_scenarios = "./run energy_drift --list scenarios";

std::vector<std::string_view> builtin_names() {
  std::vector<std::string_view> all;
  for (const BuiltinScenario& scenario : builtin_scenarios()) all.push_back(scenario.name);
  return all;
}

bool is_path(const std::string& name) { return name.find('/') != std::string::npos || name.ends_with(".toml"); }

std::string text_of(const std::string& path, const std::string& label) {
  std::error_code error;
  if (std::filesystem::exists(path, error)) return read_text(path);
  const std::string stem = std::filesystem::path(path).stem().string();
  throw InputError(
      label + ": there is no file " + path +
      (path.find('/') == std::string::npos ? suggestion_of_many(stem, builtin_names(), list_scenarios) : ""));
}

/// True if an error at `at`, which may be above `path`, belongs to the override that set `path`.
bool speaks_for(const std::string& path, const std::string& at) { return path == at || path.starts_with(at + "."); }

}  // namespace

// Faults.

bool ScenarioSource::Parsed::sound_by_itself() const {
  try {
    read_scenario(*root, name);
    return true;
  } catch (const Fault&) {
    return false;
  }
}

void ScenarioSource::Parsed::tell(const Fault& fault, std::span<const Override> overrides,
                                  const std::vector<std::string>& paths) const {
  const std::string path = fault.path.empty() ? "" : fault.path + ": ";
  if (fault.place.from_override >= 0) {
    const auto i = static_cast<std::size_t>(fault.place.from_override);
    const bool said = i < paths.size() && speaks_for(paths[i], fault.path);
    throw InputError(overrides[i].label() + ": " + (said ? "" : path) + fault.message);
  }
  // The file's text is at fault only if it fails by itself; otherwise what the overrides made of the rest is.
  std::string blamed;
  if (!overrides.empty() && sound_by_itself()) {
    for (const Override& override : overrides) blamed += (blamed.empty() ? "" : ", ") + override.label();
    blamed += ": ";
  }
  throw InputError(blamed + at(fault.place) + path + fault.message);
}

Scenario ScenarioSource::Parsed::resolve(std::span<const Override> overrides, const Scenario* plain) const {
  const auto read = [&](const TomlValue& tree) {
    Scenario scenario = read_scenario(tree, name);
    scenario.source = text;
    return scenario;
  };
  // The tree of this thread, which is that of the file between two calls: a large study sets the same few keys in each
  // run, and a copy of the tree for each takes longer than to read what they change.
  thread_local struct {
    std::shared_ptr<const TomlValue> of;  // null: the tree is that of no file
    TomlValue tree;
  } own;
  std::vector<std::string> paths;
  try {
    if (overrides.empty()) return read(*root);
    if (own.of != root) own.tree = *root;
    own.of = nullptr;
    for (std::size_t i = 0; i < overrides.size(); ++i) {
      paths.push_back(apply_override(own.tree, overrides[i], static_cast<int>(i)));
    }
    std::optional<Scenario> variant = plain ? variant_of(*plain, own.tree, paths) : std::nullopt;
    if (!variant) variant = read(own.tree);
    for (const std::string& path : paths) undo_override(own.tree, *root, path);
    own.of = root;
    return *std::move(variant);
  } catch (const Fault& fault) {
    tell(fault, overrides, paths);
  }
}

// The interface.

std::string Scenario::canonical() const {
  std::string text;
  add_canonical_text(problem, invariants, text);
  text += contact_text;
  if (energy_scale) text += "energy_scale " + exact(*energy_scale) + "\n";
  return text;
}

std::uint64_t number_of(std::string_view name, std::string_view canonical) {
  std::string text;
  text.reserve(name.size() + 1 + canonical.size());
  return text_number(text.append(name).append("\n").append(canonical));
}

ScenarioSource ScenarioSource::open(const std::string& name_or_path, const std::string& label) {
  if (is_path(name_or_path)) {
    const std::string stem = std::filesystem::path(name_or_path).stem().string();
    return ScenarioSource(std::make_unique<Parsed>(stem, name_or_path, text_of(name_or_path, label)));
  }
  for (const BuiltinScenario& scenario : builtin_scenarios()) {
    if (scenario.name != name_or_path) continue;
    return ScenarioSource(std::make_unique<Parsed>(name_or_path, "builtin " + name_or_path, scenario.text));
  }
  throw InputError(label + ": no built-in scenario is called '" + name_or_path + "'" +
                   suggestion_of_many(name_or_path, builtin_names(), list_scenarios) +
                   "; a file's name holds a '/' or ends in .toml");
}

ScenarioSource ScenarioSource::parse(std::string text, std::string origin) {
  const std::string stem = std::filesystem::path(origin).stem().string();
  return ScenarioSource(std::make_unique<Parsed>(stem, std::move(origin), text));
}

ScenarioSource::ScenarioSource(std::unique_ptr<Parsed> parsed) : parsed_(std::move(parsed)) {}
ScenarioSource::ScenarioSource(ScenarioSource&&) noexcept = default;
ScenarioSource& ScenarioSource::operator=(ScenarioSource&&) noexcept = default;
ScenarioSource::~ScenarioSource() = default;

const std::string& ScenarioSource::name() const { return parsed_->name; }

FoundKey ScenarioSource::find(const Override& key) const {
  TomlValue tree = *parsed_->root;
  try {
    const std::string path = apply_override(tree, {key.key, "0", key.place}, 0);
    return {path, value_at(*parsed_->root, path)};
  } catch (const Fault& fault) {
    parsed_->tell(fault, {&key, 1}, {});
  }
}

Scenario ScenarioSource::resolve(std::span<const Override> overrides, const Scenario* plain) const {
  return parsed_->resolve(overrides, plain);
}

}  // namespace polhode::study::scenario
