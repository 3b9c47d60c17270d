// SPDX-License-Identifier: BSD-3-Clause
// The command line of broad_phase.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "collision/broad_phase.hpp"

namespace polhode::study::broad_phase {

inline constexpr const char* broad_phase_question =
    "What does each broad phase cost as the bodies become more, and do all report the same pairs?";

struct BroadPhaseOptions {
  std::vector<const BroadPhaseEntry*> phases;
  std::string boxes;  ///< recorded motion to answer; empty: measure made-up motion
  std::string out;    ///< of recorded motion: the file of pairs; otherwise the folder of results
  std::vector<std::size_t> bodies;
  double filling = 0.1;   ///< of the volume, by boxes
  double motion = 0.02;   ///< mean path of a box in a step, over the mean edge
  double patience = 0.5;  ///< s, the longest step that is worth waiting for
  std::uint64_t seed = 1;
  bool figures = true;
  std::string command;
  std::optional<std::string> list;
  std::optional<int> exit_status;  ///< the command line said it all (--help)
};

/// Throws InputError.
BroadPhaseOptions parse_broad_phase_options(int argc, const char* const* argv);

}  // namespace polhode::study
