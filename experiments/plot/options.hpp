// SPDX-License-Identifier: BSD-3-Clause
// Command line of the program plot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/plot/quantities.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::plot_program {

inline constexpr std::size_t most_runs = 12;  ///< largest number of runs in one figure

struct PlotOptions {
  std::vector<std::string> ids;      ///< ids of runs, or their beginnings; empty: the runs that satisfy `where`
  std::vector<std::string> folders;  ///< folders of results
  std::vector<std::string> where;    ///< conditions
  std::vector<const PlotQuantity*> quantities;
  std::string body, out;
  FigureLook look{};
  bool list = false;
  std::optional<int> exit_status;  ///< the program must end at once
};

/// Throws InputError.
PlotOptions parse_plot_options(int argc, const char* const* argv);

}  // namespace polhode::study::plot_program
