// SPDX-License-Identifier: BSD-3-Clause
// Run options of sessions: all that the table of run options has, with the few exceptions that stand here.
#include "experiments/viewer/session/segment_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "experiments/viewer/session/session.hpp"

namespace polhode::viewer::inline session {
namespace {

/// Axes with one value in every session: it has one scenario, computes in double and observes every step.
constexpr std::array<std::string_view, 3> fixed_options = {"scenario", "precision", "samples"};

}  // namespace

std::vector<const study::RunOption*> session_options() {
  std::vector<const study::RunOption*> all;
  for (const study::RunOption& option : study::run_options()) {
    const bool fixed = std::find(fixed_options.begin(), fixed_options.end(), option.name) != fixed_options.end();
    if (!fixed && study::is_axis(option)) all.push_back(&option);
  }
  return all;
}

std::vector<const study::RunOption*> chosen_options() {
  using Role = study::RunOption::Role;
  std::vector<const study::RunOption*> all = session_options();
  std::erase_if(all, [](const study::RunOption* o) { return o->role == Role::method || o->role == Role::size; });
  return all;
}

/// These two have always been booleans in session files.
std::string yes_of(const study::RunOption& option) {
  if (option.name == "gyroscopic") return "on";
  if (option.name == "normalize") return "step";
  return {};
}

std::vector<SegmentOption> segment_options() {
  std::vector<SegmentOption> all;
  for (const study::RunOption* option : session_options())
    all.push_back({option, study::file_key(*option), yes_of(*option)});
  return all;
}

}  // namespace polhode::viewer::session
