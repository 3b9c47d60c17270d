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

std::vector<OptionValue> known_names(const RunOption& option, const std::string& text, const std::string& label) {
  const std::vector<std::string> known = option.known();
  if (option.takes_all && text == "all") return {known.begin(), known.end()};
  std::vector<OptionValue> items;
  for (const std::string& item : split_list(text, ',', label)) {
    if (std::find(known.begin(), known.end(), item) == known.end()) {
      const std::vector<std::string_view> all(known.begin(), known.end());
      throw InputError(label + ": no '" + item + "'" +
                       (all.size() > most_listed ? suggestion_of_many(item, all, "--list " + option.name + "s")
                                                 : suggestion(item, "There are", all)));
    }
    if (std::find(items.begin(), items.end(), OptionValue(item)) == items.end()) items.emplace_back(item);
  }
  return items;
}

std::vector<OptionValue> positive_numbers(const RunOption& option, const std::string& text, const std::string& label) {
  std::vector<double> values = numbers(text, label);
  for (const double x : values) {
    if (x > 0) continue;
    throw InputError(fmt::format("{}: {} is not positive; it must be a positive number{}", label, x, option.of_unit));
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<OptionValue> found;
  for (const double x : values) {
    if (const std::string fault = option.fault ? option.fault(x) : ""; !fault.empty())
      throw InputError(fmt::format("{}: {} {}", label, x, fault));
    if (option.kind == RunOption::Kind::whole) found.emplace_back(static_cast<std::int64_t>(x));
    else found.emplace_back(x);
  }
  return found;
}

}  // namespace

std::vector<OptionValue> axis_values(const RunOption& option, const Options& options) {
  const auto said = options.axes.find(option.name);
  if (said == options.axes.end()) return {};
  const std::string label = options.label(option.name);
  return option.kind == RunOption::Kind::name ? known_names(option, said->second, label)
                                              : positive_numbers(option, said->second, label);
}

}  // namespace polhode::study::plan
