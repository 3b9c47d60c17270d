// SPDX-License-Identifier: BSD-3-Clause
// The command line of `narrow_phase`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace polhode::study::narrow_phase {

struct NarrowPhaseOptions {
  std::string pairs;         ///< empty: the comparison
  std::string narrow_phase;  ///< empty: sat for --pairs, all of them for the comparison
  std::string out;
  std::size_t count = 2000;  ///< pairs of each class in the comparison
  std::uint64_t seed = 1;
  bool figures = true;
  std::optional<std::string> list;
  std::optional<int> exit_status{};  ///< the command line said it all (--help)
};

/// Throws InputError.
NarrowPhaseOptions parse_narrow_phase_options(const std::string& question, int argc, const char* const* argv);

}  // namespace polhode::study
