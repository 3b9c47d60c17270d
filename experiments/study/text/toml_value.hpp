// SPDX-License-Identifier: BSD-3-Clause
// A TOML document as a tree of plain values with their places in the text. The TOML library is slow to compile and is
// included by the .cpp only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace polhode::study::inline text {

/// Place of a value: line and column of the text (from 1), or the override that set it.
struct TomlPlace {
  int line = 0;
  int column = 0;
  int from_override = -1;  ///< index of the override; −1: the text
};

struct TomlEntry;

/// One value. Integers are numbers: 1 and 1.0 are the same.
struct TomlValue {
  enum class Type { boolean, number, text, list, table, date };

  Type type = Type::table;
  TomlPlace place;
  bool boolean = false;
  double number = 0;
  std::string text;
  std::vector<TomlValue> items;    ///< items of a list
  std::vector<TomlEntry> entries;  ///< entries of a table, sorted by key

  static TomlValue of(bool value);
  static TomlValue of(double value);
  static TomlValue of(std::string_view value);
  static TomlValue of(const char* value);  // without it a literal would convert to bool
  static TomlValue of(const std::vector<double>& values);

  const TomlValue* find(std::string_view key) const;
  TomlValue* find(std::string_view key);
  TomlEntry& insert(std::string key, TomlValue value);
  void erase(std::string_view key);
};

struct TomlEntry {
  std::string key;
  TomlPlace key_place;
  TomlValue value;
};

/// The text is not TOML (a duplicate key, an unclosed bracket), or is nested too deep. what() is one sentence.
struct TomlSyntaxError {
  TomlPlace place;
  std::string message;
};

/// Parses a text. Throws TomlSyntaxError.
TomlValue parse_toml(std::string_view text);

}  // namespace polhode::study::text
