// SPDX-License-Identifier: BSD-3-Clause
// Figures as files: for each a gnuplot script and its data, what gnuplot draws from them, and PGFPlots.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study {

/// Into a folder within that of a study, in which figures of an earlier study are removed. Returns what to tell the
/// user where gnuplot is not installed. Throws std::runtime_error where gnuplot fails.
std::string draw_figures(const report::FigureSet& set, const std::filesystem::path& study_folder,
                         const std::string& where);

}  // namespace polhode::study
