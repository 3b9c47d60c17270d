// SPDX-License-Identifier: BSD-3-Clause
// Command line of the program figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/study/plot/figure_choice.hpp"

namespace polhode::study::figures_program {

struct FiguresOptions {
  std::vector<std::string> folders;
  std::vector<std::string> where;  ///< conditions
  std::string out;                 ///< folder in which figures/ is written
  FigureChoice choice{};
  std::optional<int> exit_status;  ///< the program must end at once
};

/// Throws InputError.
FiguresOptions parse_figures_options(int argc, const char* const* argv);

}  // namespace polhode::study::figures_program
