// SPDX-License-Identifier: BSD-3-Clause
// Command line of broad_phase.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "collision/broad_phase.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::broad_phase {

inline constexpr const char* broad_phase_question =
    "What does each broad phase cost as the bodies become more, and do all report the same pairs?";

struct BroadPhaseOptions {
  std::vector<const BroadPhaseEntry*> phases;
  std::string boxes;  ///< file of a recorded motion whose pairs are computed; empty: measure FlyingBoxes
  std::string out;    ///< file of pairs to write for a recorded motion; otherwise the results folder
  std::vector<std::size_t> bodies;
  double filling = 0.1;   ///< volume of the boxes over that of the cube
  double motion = 0.02;   ///< mean path of a box in a step, over the mean edge
  double patience = 0.5;  ///< longest wall time of a step to measure, s
  std::uint64_t seed = 1;
  bool figures = true;
  FigureLook look{};  ///< look of the figures
  bool article = false;
  std::string command;
  std::optional<std::string> list;
  std::optional<int> exit_status;  ///< set if the program must end at once (--help)
};

/// Parses the command line. Throws InputError.
BroadPhaseOptions parse_broad_phase_options(int argc, const char* const* argv);

}  // namespace polhode::study::broad_phase
