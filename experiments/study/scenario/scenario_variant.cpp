// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/scenario_variant.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "experiments/study/scenario/body_reader.hpp"
#include "experiments/study/scenario/body_repeat.hpp"
#include "experiments/study/scenario/scenario_reader.hpp"
#include "experiments/study/text/toml_cursor.hpp"

namespace polhode::study::inline scenario {

namespace {

/// A body with changed keys.
struct Changed {
  std::size_t table = 0;  ///< number of its table
  bool start_only = true;
};

/// The bodies into which the paths lead, in the order of their tables; absent if one leads elsewhere.
std::optional<std::vector<Changed>> changed_bodies(std::span<const std::string> paths) {
  constexpr std::string_view list = "body.";
  std::vector<Changed> all;
  for (const std::string& path : paths) {
    if (!path.starts_with(list)) return std::nullopt;
    std::size_t table = 0;
    const char* const end = path.data() + path.size();
    const char* const dot = std::from_chars(path.data() + list.size(), end, table).ptr;
    std::string_view key(dot + 1, end);
    key = key.substr(0, key.find('.'));
    const auto place = std::find_if(all.begin(), all.end(), [&](const Changed& c) { return c.table >= table; });
    const auto body = place != all.end() && place->table == table ? place : all.insert(place, Changed{table});
    body->start_only = body->start_only && is_of_start(key);
  }
  return all;
}

/// Reads the body again. False: it may affect more than itself.
bool read_again(const TomlCursor& table, const Changed& changed, Scenario& scenario) {
  if (table.has("repeat")) return false;
  Problem& problem = scenario.problem;
  const std::string name =
      table.has("name") ? table.at("name", "").value().text : "body" + std::to_string(changed.table);
  const auto old =
      std::find_if(problem.bodies.begin(), problem.bodies.end(), [&](const Body& b) { return b.name == name; });
  if (old == problem.bodies.end()) return false;
  const auto i = static_cast<std::size_t>(old - problem.bodies.begin());
  if (changed.start_only) {
    problem.starts[i] = read_start(table, *old);
    return true;
  }
  ReadBody body = std::move(repeated(table, changed.table, read_body(table, changed.table, false)).front());
  if (old->fixed || body.body.fixed) return false;  // static bodies have places of their own, and may have no mass
  *old = std::move(body.body);
  problem.starts[i] = body.start;
  scenario.shapes[i] = std::move(body.shape);
  return true;
}

}  // namespace

std::optional<Scenario> variant_of(const Scenario& plain, const TomlValue& tree, std::span<const std::string> paths) {
  // Joints look at all starts, and contact at all shapes.
  if (!plain.problem.joints.empty() || !plain.colliders.empty()) return std::nullopt;
  const auto changed = changed_bodies(paths);
  if (!changed) return std::nullopt;
  try {
    Scenario scenario = plain;
    const TomlCursor root(tree);
    const TomlCursor bodies = root.at("body", "");
    for (const Changed& one : *changed) {
      const TomlCursor table = bodies.item(one.table);
      if (!read_again(table, one, scenario)) return std::nullopt;
    }
    complete(scenario, root);
    return scenario;
  } catch (const Fault&) {
    return std::nullopt;
  }
}

}  // namespace polhode::study::scenario
