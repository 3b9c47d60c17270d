// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/segment_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace polhode::viewer::inline session {
namespace {

/// The first options in a file; the others follow in the order of the table of run options.
constexpr std::array first_options = {"integrator", "dt",          "tolerance",     "order",      "summation",
                                      "t-end",      "orientation", "angular-state", "gyroscopic", "rotation-from",
                                      "normalize"};
/// Options without a key: a session has one scenario, computes in double and observes every step.
constexpr std::array<std::string_view, 3> fixed_options = {"scenario", "precision", "samples"};

SegmentOption as_in_file(const study::RunOption& option) {
  if (option.name == "gyroscopic") return {&option, "gyroscopic", "on"};
  if (option.name == "normalize") return {&option, "normalise", "step"};
  return {&option, study::file_key(option), ""};
}

}  // namespace

std::vector<SegmentOption> segment_options() {
  std::vector<SegmentOption> all;
  for (const char* name : first_options) all.push_back(as_in_file(study::run_option(name)));
  for (const study::RunOption* option : study::options_by_column()) {
    if (std::find(fixed_options.begin(), fixed_options.end(), option->name) != fixed_options.end()) continue;
    if (std::find(first_options.begin(), first_options.end(), option->name) != first_options.end()) continue;
    all.push_back(as_in_file(*option));
  }
  return all;
}

}  // namespace polhode::viewer::session
