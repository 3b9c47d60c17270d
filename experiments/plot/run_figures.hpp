// SPDX-License-Identifier: BSD-3-Clause
// Figures of recorded runs.
#pragma once

#include <string>
#include <vector>

#include "experiments/plot/recording.hpp"
#include "experiments/study/plot/figure.hpp"
#include "experiments/study/plot/space_figure.hpp"

namespace polhode::study::plot_program {

struct RunFigures {
  std::vector<Figure> figures{};
  std::vector<SpaceFigure> in_space{};
  std::vector<std::string> absent{};  ///< "polhode_error: no torque-free motion …"
};

/// A figure for each quantity; the methods of the runs have their colours, and dashes tell the runs of one method
/// apart.
RunFigures figures_of_runs(const std::vector<Recording>& runs, const std::vector<const PlotQuantity*>& quantities,
                           const FigureLook& look);

}  // namespace polhode::study::plot_program
