// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/axis_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline plan {
namespace {

constexpr std::size_t most_listed = 20;  // most names listed in an error message

/// Throws InputError if the option has no such name.
void check_name(const RunOption& option, const std::string& name, const std::vector<std::string>& known,
                const std::string& label) {
  if (!option.known || std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::vector<std::string_view> all(known.begin(), known.end());
  throw InputError(label + ": no '" + name + "'" +
                   (all.size() > most_listed ? suggestion_of_many(name, all, "--list " + option.name + "s")
                                             : suggestion(name, "There are", all)));
}

}  // namespace

OptionValue option_value(const RunOption& option, double x, const std::string& label) {
  if (option.kind == RunOption::Kind::name) throw InputError(fmt::format("{}: {} is no name", label, x));
  if (!(x > 0)) {
    throw InputError(fmt::format("{}: {} is not positive; it must be a positive number{}", label, x, option.of_unit));
  }
  if (const std::string fault = option.fault ? option.fault(x) : ""; !fault.empty())
    throw InputError(fmt::format("{}: {} {}", label, x, fault));
  if (option.kind == RunOption::Kind::whole) return static_cast<std::int64_t>(x);
  return x;
}

std::vector<OptionValue> option_values(const RunOption& option, const std::string& text, const std::string& label) {
  std::vector<OptionValue> values;
  if (option.kind != RunOption::Kind::name) {
    for (const double x : numbers(text, label)) values.push_back(option_value(option, x, label));
    return values;
  }
  const std::vector<std::string> known = option.known ? option.known() : std::vector<std::string>{};
  if (option.takes_all && text == "all") return {known.begin(), known.end()};
  for (const std::string& item : split_list(text, ',', label)) {
    check_name(option, item, known, label);
    values.emplace_back(item);
  }
  return values;
}

std::vector<double> axis_numbers(const RunOption& option, const std::string& text, const std::string& label) {
  std::vector<double> values = numbers(text, label);
  for (const double x : values) option_value(option, x, label);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::vector<OptionValue> axis_values(const RunOption& option, const std::string& text, const std::string& label) {
  std::vector<OptionValue> once;
  if (option.kind != RunOption::Kind::name) {
    for (const double x : axis_numbers(option, text, label)) once.push_back(option_value(option, x, label));
    return once;
  }
  for (OptionValue& value : option_values(option, text, label)) {
    if (std::find(once.begin(), once.end(), value) == once.end()) once.push_back(std::move(value));
  }
  return once;
}

}  // namespace polhode::study::plan
