// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/bound_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/study/plan/study_axes.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/toml_value.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline plan {
namespace {

const RunOption* option_named(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return is_option(name) ? &run_option(name) : nullptr;
}

/// The value below `value` on that way; null if there is none.
const TomlValue* below(const TomlValue& value, std::span<const std::string> way) {
  const TomlValue* at = &value;
  for (const std::string& part : way) {
    if (at->type == TomlValue::Type::table) {
      at = at->find(part);
    } else {
      std::size_t i = 0;
      const char* end = part.data() + part.size();
      const auto read = std::from_chars(part.data(), end, i);
      if (at->type != TomlValue::Type::list || read.ec != std::errc() || read.ptr != end || i >= at->items.size())
        return nullptr;
      at = &at->items[i];
    }
    if (!at) return nullptr;
  }
  return at;
}

/// Throws InputError for a list, since a condition is about numbers and texts.
HeldValue held(const TomlValue& value, const std::string& label) {
  switch (value.type) {
    case TomlValue::Type::number: return value.number;
    case TomlValue::Type::text: return value.text;
    case TomlValue::Type::boolean: return std::string(value.boolean ? "true" : "false");
    default: throw InputError(label + ": it is a list; name one number of it, as in body.0.inertia.1");
  }
}

HeldValue held(const OptionValue& value) {
  if (const double* x = std::get_if<double>(&value)) return *x;
  if (const auto* n = std::get_if<std::int64_t>(&value)) return static_cast<double>(*n);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return {};
}

WhereValue shown(const HeldValue& value) {
  if (const double* x = std::get_if<double>(&value)) return *x;
  if (const auto* text = std::get_if<std::string>(&value)) return std::string_view(*text);
  return {};
}

/// Number i of a plain list of numbers, "[1, 0.5, 2]"; absent if the text is anything else.
std::optional<double> number_in_list(std::string_view text, std::size_t i) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') return std::nullopt;
  text = text.substr(1, text.size() - 2);
  std::optional<double> found;
  for (std::size_t k = 0;; ++k) {
    std::string_view item = text.substr(0, text.find(','));
    while (item.starts_with(' ')) item.remove_prefix(1);
    const auto x = to_number(item);
    if (!x) return std::nullopt;
    if (k == i) found = x;
    if (text.find(',') == std::string_view::npos) return found;
    text.remove_prefix(text.find(',') + 1);
  }
}

/// The value that the override gives to the key which `rest` leads to.
HeldValue value_below(const Override& set, std::span<const std::string> rest) {
  if (rest.size() == 1 && rest[0].size() == 1 && rest[0][0] >= '0' && rest[0][0] <= '9') {
    if (const auto x = number_in_list(set.value, static_cast<std::size_t>(rest[0][0] - '0'))) return *x;
  }
  try {
    const TomlValue line = parse_toml("value = " + set.value);
    const TomlValue* said = line.find("value");
    if (said) said = below(*said, rest);
    return said ? held(*said, set.label()) : HeldValue{};
  } catch (const TomlSyntaxError& error) {
    throw InputError(set.label() + ": '" + set.value + "' is not a TOML value: " + error.message);
  }
}

std::string label_of_key(const Where& condition, const std::string& key) { return condition.label() + ": " + key; }

std::optional<FoundKey> found_in(const ScenarioSource& source, const std::string& key, const std::string& label) {
  try {
    return source.find({key, "", label});
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::vector<std::string> parts_of_path(std::string_view path) {
  std::vector<std::string> parts;
  while (!path.empty()) {
    parts.emplace_back(path.substr(0, path.find('.')));
    path.remove_prefix(std::min(parts.back().size() + 1, path.size()));
  }
  return parts;
}

/// Throws InputError for a word that is the value of an option: it lacks its quotes.
void refuse_value(const std::string& word, const std::string& label) {
  for (const RunOption& option : run_options()) {
    if (!option.known) continue;
    const std::vector<std::string> known = option.known();
    if (std::find(known.begin(), known.end(), word) == known.end()) continue;
    throw InputError(fmt::format("{}: {} is a value of {}; put it into quotes, as in {} == '{}'", label, word,
                                 option.name, option.name, word));
  }
}

}  // namespace

BoundConditions::BoundConditions(std::span<const Where> conditions, const ScenarioSource& source,
                                 const std::vector<std::string>& varied)
    : conditions_(conditions) {
  std::map<std::string, std::size_t> known;
  for (const Where& condition : conditions) {
    std::vector<std::size_t>& keys = keys_of_.emplace_back();
    for (const std::string& name : condition.keys()) {
      const auto [found, added] = known.try_emplace(name, keys_.size());
      keys.push_back(found->second);
      if (!added) continue;
      Key& key = keys_.emplace_back();
      key.option = option_named(name);
      const std::string label = label_of_key(condition, name);
      std::string path = name;
      if (!key.option) {
        const std::optional<FoundKey> in_scenario = found_in(source, name, label);
        if (!in_scenario) continue;  // this scenario does not have the key
        path = in_scenario->path;
        if (in_scenario->value) key.otherwise = held(*in_scenario->value, label);
      }
      for (const std::string& other : varied) {
        const std::string set = key.option ? other : source.find({other, "", ""}).path;
        if (path == set) key.setters.push_back({other, {}});
        else if (path.starts_with(set + "."))
          key.setters.push_back({other, parts_of_path(path.substr(set.size() + 1))});
      }
    }
  }
}

void BoundConditions::check_keys(const Where& condition, std::span<const ScenarioSource* const> sources) {
  for (const std::string& key : condition.keys()) {
    if (option_named(key)) continue;
    const std::string label = label_of_key(condition, key);
    refuse_value(key, condition.label());
    axis_key(key, condition.label() + ": " + key);  // throws if it cannot be a key
    std::string fault;
    const bool known = std::any_of(sources.begin(), sources.end(), [&](const ScenarioSource* source) {
      try {
        source->find({key, "", label});
        return true;
      } catch (const InputError& error) {
        if (fault.empty()) fault = error.what();
        return false;
      }
    });
    if (!known) throw InputError(fault);
  }
}

std::vector<BoundConditions::Found> BoundConditions::find_keys(const Cells& cells, std::size_t block) const {
  std::vector<Found> all;
  for (const Key& key : keys_) {
    Found& found = all.emplace_back();
    const auto add = [&](const std::vector<std::string>& rest, const auto& is_it) {
      for (std::size_t d = 0; d < cells.dimensions().size(); ++d) {
        const auto& keys = cells.dimensions()[d].keys;
        for (std::size_t i = 0; i < keys.size(); ++i) {
          if (cells.applies(block, d, i) && is_it(keys[i])) found.givers.push_back({d, i, rest, {}, {}});
        }
      }
    };
    if (key.option) add({}, [&](const DimensionKey& other) { return other.option == key.option; });
    for (auto setter = key.setters.rbegin(); setter != key.setters.rend(); ++setter)
      add(setter->rest, [&](const DimensionKey& other) { return !other.option && other.name == setter->key; });
    if (!key.option) found.otherwise = key.otherwise;
  }
  return all;
}

bool BoundConditions::gives(Giver& giver, const Cells& cells, const Cells::Place& place, WhereValue& value) {
  const Dimension& dimension = cells.dimensions()[giver.dimension];
  const std::size_t point = place.points[giver.dimension];
  const Glance glance = dimension.look(point, giver.key);
  if (glance.kind == Glance::Kind::none) return false;
  value = std::monostate();
  if (glance.kind != Glance::Kind::unknown) {
    if (!giver.rest.empty()) return true;  // a number or a name has nothing below it
    if (glance.kind == Glance::Kind::number) value = glance.number;
    else value = glance.text;
    return true;
  }
  if (dimension.keys[giver.key].option) {
    giver.value = held(dimension.value(point, giver.key));
    value = shown(giver.value);
    return true;
  }
  Override set = cells.override_at(place, giver.dimension, giver.key);
  if (set.value.empty()) return false;
  if (set.value != giver.text) {
    giver.value = value_below(set, giver.rest);
    giver.text = std::move(set.value);
  }
  value = shown(giver.value);
  return true;
}

WhereValue BoundConditions::value_of(std::size_t key, const Cells& cells, const Cells::Place& place,
                                     const Default& otherwise) {
  auto block = blocks_.find(place.block);
  if (block == blocks_.end()) block = blocks_.emplace(place.block, find_keys(cells, place.block)).first;
  Found& found = block->second[key];
  WhereValue value;
  for (Giver& giver : found.givers) {
    if (gives(giver, cells, place, value)) return value;
  }
  if (!found.otherwise) found.otherwise = held(otherwise(*keys_[key].option, cells.at(place)));
  return shown(*found.otherwise);
}

bool BoundConditions::hold(const Cells& cells, const Cells::Place& place, const Default& otherwise) {
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    values_.clear();
    for (const std::size_t key : keys_of_[i]) values_.push_back(value_of(key, cells, place, otherwise));
    if (!conditions_[i].holds(values_)) return false;
  }
  return true;
}

}  // namespace polhode::study::plan
