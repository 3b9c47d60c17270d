// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/segment_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace polhode::viewer::inline session {
namespace {

/// The first options in a file. The settings of methods follow, then the second options, then all others in the order
/// of the columns of runs.csv.
constexpr std::array<std::string_view, 3> first_options = {"integrator", "dt", "tolerance"};
constexpr std::array<std::string_view, 7> second_options = {
    "summation", "t-end", "orientation", "angular-state", "gyroscopic", "rotation-from", "normalize"};
/// Options without a key: a session has one scenario, computes in double and observes every step.
constexpr std::array<std::string_view, 3> fixed_options = {"scenario", "precision", "samples"};

SegmentOption as_in_file(const study::RunOption& option) {
  if (option.name == "gyroscopic") return {&option, "gyroscopic", "on"};
  if (option.name == "normalize") return {&option, study::file_key(option), "step"};
  return {&option, study::file_key(option), ""};
}

}  // namespace

std::vector<SegmentOption> segment_options() {
  std::vector<SegmentOption> all;
  const auto add = [&](const study::RunOption& option) {
    const auto same = [&](const SegmentOption& known) { return known.option == &option; };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back(as_in_file(option));
  };
  const auto by_column = study::options_by_column();
  for (const std::string_view name : first_options) add(study::run_option(std::string(name)));
  for (const study::RunOption* option : by_column) {
    if (option->of_methods) add(*option);
  }
  for (const std::string_view name : second_options) add(study::run_option(std::string(name)));
  for (const study::RunOption* option : by_column) {
    if (std::find(fixed_options.begin(), fixed_options.end(), option->name) == fixed_options.end()) add(*option);
  }
  return all;
}

}  // namespace polhode::viewer::session
