// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/toml_value.hpp"

// The library asserts that a key begins with a character of keys. A malformed file may have another one there, which
// the library then refuses.
#define TOML_ASSERT(condition) static_assert(true)
#include <toml++/toml.h>

#include <algorithm>

namespace polhode::study::inline text {

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

/// The end of the string that begins at `at`, or of the text.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool lines = text.substr(at, 3) == std::string(3, quote);  // """ and ''': over several lines
  for (std::size_t i = at + (lines ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') ++i;
    else if (text[i] == '\n' && !lines) return i;  // never closed, which the library reports
    else if (text[i] == quote && (!lines || text.substr(i, 3) == std::string(3, quote))) return i + (lines ? 3 : 1);
  }
  return text.size();
}

/// The library recurses over the parts of a dotted key without a bound, so that a.a.a.… overflows the stack; and so do
/// we over what it gives. The depth is that of the brackets that are open, and of the dots before each and before here.
void refuse_deep_nesting(std::string_view text) {
  constexpr std::size_t limit = 100;
  std::vector<std::size_t> outer;  // dots in front of each bracket that is open
  std::size_t dots = 0, outer_dots = 0, line_start = 0;
  int line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(text, i);
      for (std::size_t k = i; k < end; ++k) {
        if (text[k] == '\n') ++line, line_start = k + 1;
      }
      i = end - 1;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '[' || c == '{') {
      outer.push_back(dots);
      outer_dots += dots;
      dots = 0;
    } else if ((c == ']' || c == '}') && !outer.empty()) {
      dots = outer.back();
      outer_dots -= dots;
      outer.pop_back();
    } else if (c == '.') {
      ++dots;
    } else if (c == ',' || c == '\n') {
      dots = 0;
      if (c == '\n') ++line, line_start = i + 1;
    }
    if (outer.size() + outer_dots + dots <= limit) continue;
    throw TomlSyntaxError{{line, static_cast<int>(i - line_start) + 1, -1},
                          "keys and lists are nested more than 100 deep; give fewer"};
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

void TomlValue::erase(std::string_view key) {
  const auto found = lower_bound(entries, key);
  if (found != entries.end() && found->key == key) entries.erase(found);
}

TomlValue parse_toml(std::string_view text) {
  refuse_deep_nesting(text);
  try {
    return converted(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw TomlSyntaxError{place_of(error.source()), std::string(error.description())};
  }
}

}  // namespace polhode::study::text
