// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/toml_cursor.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/study/text/legible.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline text {

namespace {

using Type = TomlValue::Type;

/// A value that an override set anywhere inside is the override's fault, not the file's.
TomlPlace place_of(const TomlValue& value) {
  if (value.place.from_override >= 0) return value.place;
  for (const TomlValue& item : value.items) {
    if (const TomlPlace p = place_of(item); p.from_override >= 0) return p;
  }
  for (const TomlEntry& entry : value.entries) {
    if (const TomlPlace p = place_of(entry.value); p.from_override >= 0) return p;
  }
  return value.place;
}

std::string describe(const TomlValue& value) {
  switch (value.type) {
    case Type::boolean: return value.boolean ? "true" : "false";
    case Type::number: return exact(value.number);
    case Type::text: return '"' + shortened(value.text) + '"';
    case Type::list: return "a list of " + std::to_string(value.items.size());
    case Type::table: return "a table";
    default: return "a date or time";
  }
}

std::string in_words(TomlCursor::Range range, const char* noun) {
  switch (range) {
    case TomlCursor::Range::positive: return std::string("positive ") + noun;
    case TomlCursor::Range::non_negative: return std::string("non-negative ") + noun;
    default: return std::string("finite ") + noun;
  }
}

std::string of_unit(std::string_view unit) { return unit.empty() ? "" : " of " + std::string(unit); }

bool within(double x, TomlCursor::Range range) {
  if (!std::isfinite(x)) return false;
  return range == TomlCursor::Range::positive ? x > 0 : range == TomlCursor::Range::non_negative ? x >= 0 : true;
}

}  // namespace

std::string TomlCursor::path() const {
  if (!above_) return "";
  std::string path = above_->path();
  if (!path.empty()) path += '.';
  return path.append(key_.empty() ? std::to_string(index_) : std::string(key_));
}

TomlCursor TomlCursor::at(std::string_view key, std::string_view must_be) const& {
  if (const TomlValue* found = value_->find(key)) return {*found, *this, key, 0};
  const std::string above = path();
  throw Fault{place_of(*value_), above + (above.empty() ? "" : ".") + std::string(key),
              "is missing; it must be " + std::string(must_be)};
}

TomlCursor TomlCursor::at(std::string_view key, const TomlValue& otherwise) const& {
  const TomlValue* found = value_->find(key);
  return {found ? *found : otherwise, *this, key, 0};
}

TomlCursor TomlCursor::item(std::size_t i) const& { return {value_->items[i], *this, {}, i}; }

double TomlCursor::number(std::string_view unit, Range range) const {
  if (value_->type == Type::number && within(value_->number, range)) return value_->number;
  refuse("a " + in_words(range, "number") + of_unit(unit));
}

Vector3<double> TomlCursor::vector(std::string_view unit, Range range) const {
  if (value_->type != Type::list || value_->items.size() != 3) {
    refuse("3 " + in_words(range, "numbers") + of_unit(unit));
  }
  return {item(0).number(unit, range), item(1).number(unit, range), item(2).number(unit, range)};
}

bool TomlCursor::boolean() const {
  if (value_->type != Type::boolean) refuse("true or false");
  return value_->boolean;
}

const std::string& TomlCursor::text(std::string_view must_be) const {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (value_->type != Type::text || std::any_of(value_->text.begin(), value_->text.end(), is_control)) refuse(must_be);
  return value_->text;
}

std::size_t TomlCursor::list(std::string_view must_be) const {
  if (value_->type != Type::list || value_->items.empty()) refuse(must_be);
  return value_->items.size();
}

void TomlCursor::table(std::string_view introduction, const std::vector<std::string_view>& keys) const {
  if (value_->type != Type::table) refuse("a table");
  for (const TomlEntry& entry : value_->entries) {
    if (std::find(keys.begin(), keys.end(), entry.key) != keys.end()) continue;
    const std::string above = path();
    throw Fault{entry.key_place, above + (above.empty() ? "" : ".") + entry.key,
                "there is no such key" + suggestion(entry.key, introduction, keys)};
  }
}

void TomlCursor::fail(std::string message) const { throw Fault{place_of(*value_), path(), std::move(message)}; }

void TomlCursor::refuse(std::string_view must_be) const {
  std::string noun;
  const TomlCursor* named = this;
  for (; named->key_.empty() && named->above_; named = named->above_) noun = "item of ";
  fail(describe(*value_) + " is not a valid " + noun.append(named->key_) + "; it must be " + std::string(must_be));
}

void TomlCursor::unknown(std::string_view what, std::string_view introduction,
                         const std::vector<std::string_view>& known) const {
  fail("no " + std::string(what) + " is called '" + shortened(value_->text) + "'" +
       suggestion(value_->text, introduction, known));
}

}  // namespace polhode::study::text
