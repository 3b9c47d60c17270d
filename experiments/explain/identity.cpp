// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/explain/identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/scenario/scenario_override.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/text_hash.hpp"
#include "experiments/study/text/toml_value.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::explain {
namespace {

using Type = TomlValue::Type;

std::string words_of(const TomlValue& value) {
  switch (value.type) {
    case Type::number: return exact(value.number);
    case Type::boolean: return value.boolean ? "true" : "false";
    case Type::list: {
      std::string items;
      for (const TomlValue& item : value.items) items += (items.empty() ? "" : ", ") + words_of(item);
      return "[" + items + "]";
    }
    case Type::table: {
      std::string entries;
      for (const TomlEntry& entry : value.entries)
        entries += (entries.empty() ? "" : ", ") + entry.key + " = " + words_of(entry.value);
      return "{" + entries + "}";
    }
    default: return value.text;
  }
}

/// The scenario's tree with the varied keys set, and the paths of those.
struct Tree {
  TomlValue root;
  std::set<std::string> varied;
};

Tree tree_of(const ExplainedRun& run) {
  Tree tree{parse_toml(run.source), {}};
  int index = 0;
  for (const Override& one : run.read.config.varied) {
    if (!one.value.empty()) tree.varied.insert(apply_override(tree.root, one, index++));
  }
  return tree;
}

/// True if the key decides nothing about a run, or, as t_end, by an option of the run.
bool is_idle(const std::vector<ScenarioKey>& keys, const std::string& name, bool contact) {
  const ScenarioKey* key = find_key(keys, name);
  return name == "title" || name == "description" || name == "name" || name == "t_end" ||
         (key && key->decides == Decides::with_contact && !contact);
}

/// Paths of all keys that decide something: "gravity", "body.0.mass".
void add_paths(const TomlValue& root, std::set<std::string>& paths) {
  const TomlValue* said = root.find("contact");
  const bool contact = said && said->boolean;
  for (const TomlEntry& entry : root.entries) {
    const bool elements = is_list_of_tables(entry.key) && entry.value.type == Type::list;
    if (!elements) {
      if (!is_idle(root_keys(), entry.key, contact)) paths.insert(entry.key);
      continue;
    }
    for (std::size_t k = 0; k < entry.value.items.size(); ++k) {
      for (const TomlEntry& part : entry.value.items[k].entries) {
        if (entry.key == "force" || !is_idle(body_keys(), part.key, contact))
          paths.insert(fmt::format("{}.{}.{}", entry.key, k, part.key));
      }
    }
  }
}

bool overlap(const std::string& a, const std::string& b) {
  return a == b || a.starts_with(b + ".") || b.starts_with(a + ".");
}

/// The lines of canonical texts that are not in the other one.
void compare_lines(const std::string& a, const std::string& b, std::vector<KeyDifference>& found) {
  const auto lines = [](const std::string& text) {
    std::vector<std::string> all;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      all.push_back(text.substr(at, end - at));
      at = end + 1;
    }
    return all;
  };
  const std::vector<std::string> first = lines(a), second = lines(b);
  for (std::size_t k = 0; k < std::max(first.size(), second.size()); ++k) {
    const std::string one = k < first.size() ? first[k] : "", other = k < second.size() ? second[k] : "";
    if (one != other) found.push_back({fmt::format("scenario text, line {}", k + 1), one, other});
  }
}

/// Keys of the scenario that differ, without those that both runs vary: they are named as varied keys.
void compare_scenarios(const ExplainedRun& a, const ExplainedRun& b, std::vector<KeyDifference>& found) {
  if (a.read.scenario->canonical() == b.read.scenario->canonical()) return;
  const std::size_t before = found.size();
  const Tree first = tree_of(a), second = tree_of(b);
  std::set<std::string> paths, varied = first.varied;
  varied.insert(second.varied.begin(), second.varied.end());
  add_paths(first.root, paths);
  add_paths(second.root, paths);
  bool said = false;
  for (const std::string& path : paths) {
    const auto one = value_at(first.root, path), other = value_at(second.root, path);
    const std::string x = one ? words_of(*one) : "", y = other ? words_of(*other) : "";
    if (x == y) continue;
    said = std::any_of(varied.begin(), varied.end(), [&](const std::string& v) { return overlap(v, path); }) || said;
    if (std::none_of(varied.begin(), varied.end(), [&](const std::string& v) { return overlap(v, path); }))
      found.push_back({path, x, y});
  }
  if (found.size() == before && !said) compare_lines(a.read.scenario->canonical(), b.read.scenario->canonical(), found);
}

std::string version_of(const ExplainedRun& run) {
  return run.read.version ? std::to_string(*run.read.version) : "unknown";
}

}  // namespace

ExplainedRun explained(const FoundRun& found) {
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("run {} of {}: {}", found.id, found.where->file.string(), why));
  };
  ExplainedRun run{.id = found.id, .read = {}, .source = {}};
  const auto stored = found.where->store.find(found.id, Curves::without);
  if (!stored) fail("it was removed meanwhile");
  try {
    run.read = read_run(*stored, found.where->configurations, found.where->scenarios);
  } catch (const std::runtime_error& reason) {
    fail(reason.what());
  }
  run.source = found.where->scenarios.at(run.read.config.scenario).source;
  return run;
}

std::vector<std::pair<std::string, std::string>> identity_of_run(const ExplainedRun& run) {
  std::vector<std::pair<std::string, std::string>> keys = {
      {"results version", version_of(run)}, {"scenario text", text_hash(run.read.scenario->canonical())}};
  const auto parts = identity_parts(run.read.config);
  keys.insert(keys.end(), parts.begin(), parts.end());
  return keys;
}

std::vector<KeyDifference> differing_keys(const ExplainedRun& a, const ExplainedRun& b) {
  std::vector<KeyDifference> found;
  const std::string versions[] = {version_of(a), version_of(b)};
  if (versions[0] != versions[1]) found.push_back({"results version", versions[0], versions[1]});
  const auto first = identity_parts(a.read.config), second = identity_parts(b.read.config);
  const auto value = [](const auto& parts, const std::string& key) {
    const auto at = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.first == key; });
    return at == parts.end() ? std::string() : at->second;
  };
  std::vector<std::string> keys;
  for (const auto* parts : {&first, &second}) {
    for (const auto& [key, text] : *parts) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  for (const std::string& key : keys) {
    if (value(first, key) != value(second, key)) found.push_back({key, value(first, key), value(second, key)});
  }
  compare_scenarios(a, b, found);
  return found;
}

}  // namespace polhode::study::explain
