// SPDX-License-Identifier: BSD-3-Clause
// Writes figures as files: a gnuplot script and its data for each, the SVG and PDF that gnuplot draws, and PGFPlots.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

/// Draws into a subfolder of a study's folder; figures of an earlier study there are removed. Returns a message for the
/// user if gnuplot is not installed. Throws std::runtime_error if gnuplot fails.
std::string draw_figures(const FigureSet& set, const std::filesystem::path& study_folder, const std::string& where);

}  // namespace polhode::study::plot
