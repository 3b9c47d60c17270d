// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/configurations.hpp"

#include <string_view>
#include <type_traits>
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

}  // namespace

Configuration configuration_of(const RunConfig& config) {
  Configuration values;
  for (const RunOption& option : run_options()) {
    if (!option.applies_to(config)) continue;
    OptionValue value = option.value(config);
    if (value != OptionValue{})
      values.emplace(option.column.empty() ? file_key(option) : option.column, std::move(value));
  }
  return values;
}

std::int64_t key_of(const Configuration& configuration) {
  std::vector<Value> values;
  for (const auto& [name, value] : configuration) {
    values.emplace_back(std::string_view(name));
    values.push_back(value_of_option(value));
  }
  return checksum_of(0, values);
}

std::string varied_text(const RunConfig& config) {
  std::string text;
  for (const Override& varied : config.varied) {
    if (varied.value.empty()) continue;
    text += (text.empty() ? "" : "\n") + varied.key + "=";
    for (const char c : varied.value) text += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : std::string(1, c);
  }
  return text;
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

std::map<std::int64_t, Configuration> read_configurations(const Database& db) {
  std::map<std::int64_t, Configuration> all;
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
    if (key_of(one) == key) all.emplace(key, std::move(one));
  }
  return all;
}

}  // namespace polhode::study::store
