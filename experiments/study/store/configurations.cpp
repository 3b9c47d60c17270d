// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/configurations.hpp"

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/study/store/value.hpp"

namespace polhode::study::inline store {
namespace {

Value value_of_option(const OptionValue& option) {
  return std::visit(
      []<class T>(const T& v) -> Value {
        if constexpr (std::is_same_v<T, std::string>) return std::string_view(v);
        else if constexpr (std::is_same_v<T, double>) return as_kept(v);
        else return v;
      },
      option);
}

OptionValue option_of_value(const Value& value) {
  return std::visit(
      []<class T>(const T& v) -> OptionValue {
        if constexpr (std::is_same_v<T, std::string_view>) return std::string(v);
        else if constexpr (std::is_same_v<T, Blob>) return {};  // none is written
        else return v;
      },
      value);
}

/// The entries of configuration_of(), in the order of their names.
std::vector<std::pair<std::string_view, OptionValue>> entries_of(const RunConfig& config) {
  std::vector<std::pair<std::string_view, OptionValue>> entries;
  entries.reserve(options_by_stored_name().size());
  for (const auto& [name, option] : options_by_stored_name()) {
    if (!option->applies_to(config)) continue;
    OptionValue value = option->value(config);
    if (value != OptionValue{}) entries.emplace_back(name, std::move(value));
  }
  return entries;
}

/// `entries`: sorted by name.
template <class Entries>
std::int64_t key_of_entries(const Entries& entries) {
  std::vector<Value> values;
  values.reserve(2 * entries.size());
  for (const auto& [name, value] : entries) values.insert(values.end(), {name, value_of_option(value)});
  return checksum_of(0, values);
}

}  // namespace

Configuration configuration_of(const RunConfig& config) {
  const auto entries = entries_of(config);
  return {entries.begin(), entries.end()};
}

std::int64_t key_of(const Configuration& configuration) { return key_of_entries(configuration); }
std::int64_t configuration_key(const RunConfig& config) { return key_of_entries(entries_of(config)); }

std::string varied_text(const RunConfig& config) {
  std::string text;
  set_varied_text(text, config);
  return text;
}

void set_varied_text(std::string& text, const RunConfig& config) {
  text.clear();
  for (const Override& varied : config.varied) {
    if (varied.value.empty()) continue;
    if (!text.empty()) text += '\n';
    text += varied.key;
    text += '=';
    const auto is_escaped = [](char c) { return c == '\\' || c == '\n'; };
    if (std::none_of(varied.value.begin(), varied.value.end(), is_escaped)) {
      text += varied.value;
      continue;
    }
    for (const char c : varied.value) {
      if (c == '\\') text += "\\\\";
      else if (c == '\n') text += "\\n";
      else text += c;
    }
  }
}

TableForm configurations_form() {
  return {.name = "configurations", .columns = {{"key", "INTEGER"}}, .may_have_more = true};
}

ConfigurationWriter::ConfigurationWriter(const Database& db) : db_(&db) {
  Statement columns(db, "SELECT name FROM pragma_table_info('configurations')");
  while (columns.step()) {
    const Value name = columns.value(0);
    if (const auto* text = std::get_if<std::string_view>(&name)) columns_.emplace(*text);
  }
}

void ConfigurationWriter::keep(std::int64_t key, const RunConfig& config) {
  constexpr std::size_t most_known = 100'000;  // bounds the memory
  if (known_.contains(key)) return;
  const Configuration configuration = configuration_of(config);
  std::string names = "key", parameters = "?";
  std::vector<Value> values = {key};
  for (const auto& [name, value] : configuration) {
    if (columns_.insert(name).second) db_->execute("ALTER TABLE configurations ADD COLUMN " + quoted_name(name));
    names += ", " + quoted_name(name);
    parameters += ",?";
    values.push_back(value_of_option(value));
  }
  Statement(*db_, "INSERT OR REPLACE INTO configurations (" + names + ") VALUES (" + parameters + ")").run(values);
  if (known_.size() == most_known) known_.clear();
  known_.insert(key);
}

namespace {

/// Calls use(key, configuration) for each configuration that is not damaged.
template <class Use>
void for_each_configuration(const Database& db, const Use& use) {
  Statement rows(db, "SELECT * FROM configurations");
  while (rows.step()) {
    Configuration one;
    std::int64_t key = 0;
    for (int k = 0; k < rows.columns(); ++k) {
      const std::string name = rows.name(k);
      if (name == "key") {
        key = rows.integer(k);
      } else if (OptionValue value = option_of_value(rows.value(k)); value != OptionValue{}) {
        one.emplace(name, std::move(value));
      }
    }
    if (key_of(one) == key) use(key, std::move(one));
  }
}

}  // namespace

std::map<std::int64_t, Configuration> read_configurations(const Database& db) {
  std::map<std::int64_t, Configuration> all;
  for_each_configuration(db, [&](std::int64_t key, Configuration&& one) { all.emplace(key, std::move(one)); });
  return all;
}

std::unordered_set<std::int64_t> configuration_keys(const Database& db) {
  std::unordered_set<std::int64_t> keys;
  for_each_configuration(db, [&](std::int64_t key, Configuration&&) { keys.insert(key); });
  return keys;
}

}  // namespace polhode::study::store
