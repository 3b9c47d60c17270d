// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/parameter_reader.hpp"

#include <algorithm>

#include "experiments/study/text/suggestion.hpp"

namespace polhode::study::inline scenario {

namespace {

std::string quoted_choices(const std::vector<std::string>& choices) {
  std::string text;
  for (const std::string& choice : choices) text += (text.empty() ? "\"" : " or \"") + choice + '"';
  return text;
}

std::string must_be(const Parameter& p) {
  if (!p.choices.empty()) return quoted_choices(p.choices);
  if (std::holds_alternative<std::string>(p.value)) return "a text";
  return (std::holds_alternative<double>(p.value) ? "a number" : "3 numbers") + (p.unit.empty() ? "" : " of " + p.unit);
}

/// A table whose keys may all be left out, and are numbers that are then 0, does nothing until one of them is given.
void expect_an_effect(const TomlCursor& table, const std::vector<Parameter>& parameters) {
  std::string keys;
  for (const Parameter& p : parameters) {
    const double* number = std::get_if<double>(&p.value);
    if (p.need == Parameter::Need::required || !number || *number != 0 || table.has(p.key)) return;
    keys += (keys.empty() ? "" : ", ") + p.key;
  }
  if (!keys.empty()) table.fail("has no effect without any of its keys " + keys + "; give at least one of them");
}

ParameterValue read(const TomlCursor& value, const Parameter& p) {
  if (std::holds_alternative<double>(p.value)) return value.number(p.unit, p.range);
  if (std::holds_alternative<Vector3<double>>(p.value)) return value.vector(p.unit, p.range);
  const std::string& text = value.text(must_be(p));
  const bool known = p.choices.empty() || std::find(p.choices.begin(), p.choices.end(), text) != p.choices.end();
  if (!known) value.refuse(must_be(p));
  return text;
}

}  // namespace

std::map<std::string, ParameterValue> read_parameters(const TomlCursor& table, const std::vector<Parameter>& parameters,
                                                      std::vector<std::string_view> also, std::string_view introduction,
                                                      std::size_t bodies) {
  for (const Parameter& p : parameters) also.push_back(p.key);
  table.table(introduction, also);
  expect_an_effect(table, parameters);
  std::map<std::string, ParameterValue> values;
  for (const Parameter& p : parameters) {
    if (!table.has(p.key) && p.need == Parameter::Need::optional) {
      values.emplace(p.key, p.value);
      continue;
    }
    const TomlCursor value = table.at(p.key, must_be(p));
    if (p.needs_bodies != 0 && static_cast<std::size_t>(p.needs_bodies) != bodies) {
      value.fail("makes sense with " + std::to_string(p.needs_bodies) + (p.needs_bodies == 1 ? " body" : " bodies") +
                 " only, and this one names " + std::to_string(bodies));
    }
    values.emplace(p.key, read(value, p));
  }
  return values;
}

}  // namespace polhode::study::scenario
