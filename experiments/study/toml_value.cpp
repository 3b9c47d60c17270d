// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/toml_value.hpp"

#include <toml++/toml.h>

#include <algorithm>

namespace polhode::study {

namespace {

TomlPlace place_of(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), -1};
}

TomlValue converted(const toml::node& node) {
  TomlValue out;
  out.place = place_of(node.source());
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) {  // the library keeps its keys sorted
      out.entries.push_back({std::string(key.str()), place_of(key.source()), converted(value)});
    }
  } else if (const auto* array = node.as_array()) {
    out.type = TomlValue::Type::list;
    for (const auto& item : *array) out.items.push_back(converted(item));
  } else if (const auto* text = node.as_string()) {
    out.type = TomlValue::Type::text;
    out.text = text->get();
  } else if (const auto* whole = node.as_integer()) {
    out.type = TomlValue::Type::number;
    out.number = static_cast<double>(whole->get());
  } else if (const auto* number = node.as_floating_point()) {
    out.type = TomlValue::Type::number;
    out.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    out.type = TomlValue::Type::boolean;
    out.boolean = boolean->get();
  } else {
    out.type = TomlValue::Type::date;
  }
  return out;
}

/// The library recurses over the parts of a dotted key without a bound, so that a.a.a.… overflows the stack.
void refuse_endless_keys(std::string_view text) {
  constexpr int limit = 1000;
  int dots = 0, line = 1;
  for (const char c : text) {
    if (c == '\n') ++line;
    if (c == '.') ++dots;
    if (c == '\n' || c == '=' || c == ',') dots = 0;
    if (dots > limit) throw TomlSyntaxError{{line, 1, -1}, "a key of more than 1000 parts"};
  }
}

template <class Entries>
auto lower_bound(Entries& entries, std::string_view key) {
  return std::lower_bound(entries.begin(), entries.end(), key,
                          [](const TomlEntry& entry, std::string_view k) { return entry.key.compare(k) < 0; });
}

}  // namespace

TomlValue TomlValue::of(bool value) {
  TomlValue out;
  out.type = Type::boolean;
  out.boolean = value;
  return out;
}

TomlValue TomlValue::of(double value) {
  TomlValue out;
  out.type = Type::number;
  out.number = value;
  return out;
}

TomlValue TomlValue::of(std::string_view value) {
  TomlValue out;
  out.type = Type::text;
  out.text = value;
  return out;
}

TomlValue TomlValue::of(const char* value) { return of(std::string_view(value)); }

TomlValue TomlValue::of(const std::vector<double>& values) {
  TomlValue out;
  out.type = Type::list;
  for (const double x : values) out.items.push_back(of(x));
  return out;
}

const TomlValue* TomlValue::find(std::string_view key) const {
  const auto found = lower_bound(entries, key);
  return found != entries.end() && found->key == key ? &found->value : nullptr;
}

TomlValue* TomlValue::find(std::string_view key) {
  const auto found = lower_bound(entries, key);
  return found != entries.end() && found->key == key ? &found->value : nullptr;
}

TomlEntry& TomlValue::insert(std::string key, TomlValue value) {
  const auto where = lower_bound(entries, key);
  return *entries.insert(where, TomlEntry{std::move(key), value.place, std::move(value)});
}

TomlValue parse_toml(std::string_view text) {
  refuse_endless_keys(text);
  try {
    return converted(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw TomlSyntaxError{place_of(error.source()), std::string(error.description())};
  }
}

}  // namespace polhode::study
