// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/bound_conditions.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "experiments/study/plan/study_axes.hpp"
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
WhereValue where_value(const TomlValue& value, const std::string& label) {
  switch (value.type) {
    case TomlValue::Type::number: return value.number;
    case TomlValue::Type::text: return value.text;
    case TomlValue::Type::boolean: return std::string(value.boolean ? "true" : "false");
    default: throw InputError(label + ": it is a list; name one number of it, as in body.0.inertia.1");
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

}  // namespace

BoundConditions::BoundConditions(std::span<const Where> conditions, const ScenarioSource& source,
                                 const std::vector<std::string>& varied)
    : conditions_(conditions) {
  for (const Where& condition : conditions) {
    std::vector<Source>& keys = sources_.emplace_back();
    for (const std::string& key : condition.keys()) {
      Source& from = keys.emplace_back();
      from.option = option_named(key);
      const std::string label = label_of_key(condition, key);
      std::string path = key;
      if (!from.option) {
        const std::optional<FoundKey> found = found_in(source, key, label);
        if (!found) continue;  // this scenario does not have the key
        path = found->path;
        if (found->value) from.otherwise = where_value(*found->value, label);
      }
      for (const std::string& other : varied) {
        const std::string set = from.option ? other : source.find({other, "", ""}).path;
        if (path == set) from.setters.push_back({other, {}});
        else if (path.starts_with(set + "."))
          from.setters.push_back({other, parts_of_path(path.substr(set.size() + 1))});
      }
    }
  }
}

void BoundConditions::check_keys(const Where& condition, std::span<const ScenarioSource* const> sources) {
  for (const std::string& key : condition.keys()) {
    if (option_named(key)) continue;
    const std::string label = label_of_key(condition, key);
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

std::optional<WhereValue> BoundConditions::set_by(const Source& source, const Cell& cell) {
  std::optional<WhereValue> value;
  for (const Source::Setter& setter : source.setters) {
    const auto set = std::find_if(cell.varied.begin(), cell.varied.end(),
                                  [&](const Override& override) { return override.key == setter.key; });
    if (set == cell.varied.end()) continue;
    if (const auto x = setter.rest.empty() ? to_number(set->value) : std::nullopt) {
      value = *x;
      continue;
    }
    try {
      const TomlValue line = parse_toml("value = " + set->value);
      const TomlValue* said = line.find("value");
      if (said) said = below(*said, setter.rest);
      value = said ? where_value(*said, set->label()) : WhereValue{};
    } catch (const TomlSyntaxError& error) {
      throw InputError(set->label() + ": '" + set->value + "' is not a TOML value: " + error.message);
    }
  }
  return value;
}

bool BoundConditions::hold(const Cell& cell, const RunConfig& config) const {
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    std::vector<WhereValue> values;
    for (const Source& source : sources_[i]) {
      const RunOption* option = source.option;
      const auto given = std::find_if(cell.options.begin(), cell.options.end(),
                                      [&](const auto& pair) { return option && pair.first == option; });
      if (const auto set = given == cell.options.end() ? set_by(source, cell) : std::nullopt) {
        values.push_back(*set);
      } else if (!option) {
        values.push_back(source.otherwise);
      } else {
        const OptionValue value = option->applies_to(config) ? option->value(config) : OptionValue{};
        if (const double* x = std::get_if<double>(&value)) values.emplace_back(*x);
        else if (const auto* n = std::get_if<std::int64_t>(&value)) values.emplace_back(static_cast<double>(*n));
        else if (const auto* text = std::get_if<std::string>(&value)) values.emplace_back(*text);
        else values.emplace_back();
      }
    }
    if (!conditions_[i].holds(values)) return false;
  }
  return true;
}

}  // namespace polhode::study::plan
