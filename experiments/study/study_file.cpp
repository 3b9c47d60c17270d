// SPDX-License-Identifier: BSD-3-Clause
// Reads a study file: the axes of a study as TOML instead of options.
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "experiments/study/axes.hpp"
#include "experiments/study/input_error.hpp"
#include "experiments/study/options.hpp"
#include "experiments/study/suggestion.hpp"

namespace polhode::study {
namespace {

std::string place(const std::string& path, const toml::source_region& source) {
  return path + ":" + std::to_string(source.begin.line) + ":" + std::to_string(source.begin.column) + ": ";
}

/// A value as the command line would write it.
std::string as_text(const toml::node& node, const std::string& where) {
  if (const auto* s = node.as_string()) return s->get();
  if (const auto* i = node.as_integer()) return std::to_string(i->get());
  if (const auto* x = node.as_floating_point()) return exact(x->get());
  if (const auto* b = node.as_boolean()) return b->get() ? "true" : "false";
  if (const auto* list = node.as_array()) {
    std::string text = "[";
    for (const toml::node& item : *list) text += (text.size() > 1 ? ", " : "") + as_text(item, where);
    return text + "]";
  }
  throw InputError(where + "this type of value is not known here; use numbers, texts and lists");
}

std::string as_list(const toml::node& node, char separator, const std::string& where) {
  const toml::array* list = node.as_array();
  if (!list) return as_text(node, where);
  if (list->empty()) throw InputError(where + "an empty list; give at least one value");
  std::string text;
  for (const toml::node& item : *list) text += (text.empty() ? "" : std::string(1, separator)) + as_text(item, where);
  return text;
}

void read_vary(const std::string& path, const toml::node& node, Options& options) {
  const toml::table* table = node.as_table();
  if (!table) throw InputError(place(path, node.source()) + "vary: must be a table from scenario keys to lists");
  for (const auto& [key, value] : *table) {
    const std::string name = "vary." + std::string(key.str());
    options.places[name] = place(path, value.source()) + name;
    const std::string where = options.places[name] + ": ";
    const bool vectors = value.is_array() && !value.as_array()->empty() && value.as_array()->front().is_array();
    options.vary.emplace_back(std::string(key.str()), as_list(value, vectors ? ';' : ',', where));
  }
}

}  // namespace

void read_study_file(const std::string& path, Options& options) {
  toml::table file;
  try {
    file = toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    if (error.source().begin.line == 0) throw InputError("--study " + path + ": cannot be read");
    throw InputError(place(path, error.source()) + std::string(error.description()));
  }
  const auto& names = axis_names();
  for (const auto& [key, value] : file) {
    std::string name(key.str());
    const std::string where = place(path, value.source()) + name + ": ";
    if (name == "vary") {
      read_vary(path, value, options);
      continue;
    }
    if (name == "reference") {
      const auto* on = value.as_boolean();
      if (!on) throw InputError(where + "must be true or false");
      options.reference = options.reference || on->get();
      continue;
    }
    std::replace(name.begin(), name.end(), '_', '-');
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw InputError(where + "no such axis" + suggestion(name, "There are", {names.begin(), names.end()}) +
                       "; a study file takes vary and reference too");
    }
    options.axes[name] = as_list(value, ',', where);
    options.places[name] = place(path, value.source()) + std::string(key.str());
  }
}

}  // namespace polhode::study
