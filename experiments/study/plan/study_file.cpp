// SPDX-License-Identifier: BSD-3-Clause
// Reader of study files: the axes of a study as TOML instead of options.
#include <algorithm>

#include "experiments/study/plan/options.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/text_hash.hpp"
#include "experiments/study/text/toml_value.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline plan {
namespace {

using Type = TomlValue::Type;

std::string place(const std::string& path, const TomlPlace& at) {
  return path + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": ";
}

/// The value in the syntax of the command line.
std::string as_text(const TomlValue& value, const std::string& where) {
  if (value.type == Type::text) return value.text;
  if (value.type == Type::number) return exact(value.number);
  if (value.type == Type::boolean) return value.boolean ? "true" : "false";
  if (value.type == Type::list) {
    std::string text = "[";
    for (const TomlValue& item : value.items) text += (text.size() > 1 ? ", " : "") + as_text(item, where);
    return text + "]";
  }
  throw InputError(where + "this type of value is not known here; use numbers, texts and lists");
}

std::string as_list(const TomlValue& value, char separator, const std::string& where) {
  if (value.type != Type::list) return as_text(value, where);
  if (value.items.empty()) throw InputError(where + "an empty list; give at least one value");
  std::string text;
  for (const TomlValue& item : value.items)
    text += (text.empty() ? "" : std::string(1, separator)) + as_text(item, where);
  return text;
}

void read_vary(const std::string& path, const TomlValue& table, Options& options) {
  if (table.type != Type::table)
    throw InputError(place(path, table.place) + "vary: must be a table from scenario keys to lists");
  for (const auto& [key, key_place, value] : table.entries) {
    const std::string name = "vary." + key;
    options.places[name] = place(path, value.place) + name;
    const std::string where = options.places[name] + ": ";
    const bool vectors = value.type == Type::list && !value.items.empty() && value.items.front().type == Type::list;
    options.vary.emplace_back(key, as_list(value, vectors ? ';' : ',', where));
  }
}

TomlValue read_tree(const std::string& path, Options& options) {
  TomlValue file;
  try {
    const std::string text = read_text(path);
    options.study_file = path;
    options.study_file_hash = text_hash(text);
    file = parse_toml(text);
  } catch (const TomlSyntaxError& error) {
    throw InputError(place(path, error.place) + error.message);
  } catch (const InputError& error) {
    throw InputError(std::string("--study ") + error.what());
  }
  if (file.entries.empty()) {
    throw InputError("--study " + path +
                     ": there is nothing in it; it sets axes, such as integrator = [\"rk4\"] and dt = [1e-3, 1e-2]");
  }
  return file;
}

}  // namespace

void read_study_file(const std::string& path, Options& options) {
  const TomlValue file = read_tree(path, options);
  const std::vector<std::string> names = axis_names();
  for (const auto& [key, key_place, value] : file.entries) {
    const std::string where = place(path, value.place) + key + ": ";
    if (key == "vary") {
      read_vary(path, value, options);
      continue;
    }
    if (key == "reference") {
      if (value.type != Type::boolean) throw InputError(where + "must be true or false");
      options.reference = options.reference || value.boolean;
      continue;
    }
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw InputError(where + "no such axis" + suggestion(name, "There are", {names.begin(), names.end()}) +
                       "; a study file takes vary and reference too");
    }
    options.axes[name] = as_list(value, ',', where);
    options.places[name] = place(path, value.place) + key;
  }
}

}  // namespace polhode::study::plan
