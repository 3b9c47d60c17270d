// SPDX-License-Identifier: BSD-3-Clause
// Command line of `narrow_phase`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::narrow_phase {

struct NarrowPhaseOptions {
  std::string pairs;         ///< file of pairs to compute; empty: make the comparison
  std::string narrow_phase;  ///< narrow phase; empty: sat for --pairs, all for the comparison
  std::string out;
  std::size_t count = 2000;  ///< number of pairs of each class in the comparison
  std::uint64_t seed = 1;
  bool figures = true;
  FigureLook look{};  ///< look of the figures
  bool article = false;
  std::optional<std::string> list;
  std::optional<int> exit_status{};  ///< set if the program must end at once (--help)
};

/// Parses the command line. Throws InputError.
NarrowPhaseOptions parse_narrow_phase_options(const std::string& question, int argc, const char* const* argv);

}  // namespace polhode::study::narrow_phase
