// SPDX-License-Identifier: BSD-3-Clause
// Command line of judge.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/system/formulation.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::judge {

struct JudgeOptions {
  std::string scenario;            ///< built-in name or file
  std::vector<std::string> files;  ///< trajectories, without duplicates
  bool reference = false;
  RotationFrom rotation_from = RotationFrom::normalized;
  std::string out;  ///< results folder; empty: results/judge-<scenario>-<hash>
  bool force = false, figures = true;
  FigureLook look{};               ///< look of the figures
  std::string command;             ///< the command line, quoted for a shell
  std::optional<int> exit_status;  ///< set if the program must end at once (--help)
};

/// Parses the command line. Throws InputError.
JudgeOptions parse_judge_options(int argc, const char* const* argv);

inline constexpr const char* judge_question =
    "How far is a trajectory, from whatever program, from the exact motion, and what is wrong with it?";

}  // namespace polhode::study::judge
