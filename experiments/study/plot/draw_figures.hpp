// SPDX-License-Identifier: BSD-3-Clause
// Writes figures as files: a gnuplot script and its data for each, the SVG and PDF that gnuplot draws, and PGFPlots.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"
#include "experiments/study/plot/space_figure.hpp"

namespace polhode::study::inline plot {

/// The treatment of figures that are in the folder and not drawn.
enum class Others { remove, keep };

/// Draws into a subfolder of a study's folder. Returns a message for the user if gnuplot is not installed, or words of
/// the figures have no translation. Throws std::runtime_error if gnuplot fails.
std::string draw_figures(const FigureSet& set, const std::filesystem::path& study_folder, const std::string& where,
                         Others others = Others::remove);

/// The same for figures in three dimensions, as SVG and PDF.
std::string draw_space_figures(const std::vector<SpaceFigure>& figures, const std::filesystem::path& study_folder,
                               const std::string& where);

/// Time in which gnuplot starts and ends without drawing, s: the median of five. Absent if it is not installed.
std::optional<double> time_of_gnuplot();

/// Names of the figures in a folder, sorted.
std::vector<std::string> figures_in(const std::filesystem::path& folder);

}  // namespace polhode::study::plot
