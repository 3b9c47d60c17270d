// SPDX-License-Identifier: BSD-3-Clause
// A figure in LaTeX: tikzpictures of PGFPlots that need no other file.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

/// Pictures as wide as the line of an article of 11 pt on A4, with letters of 8 and 9 pt. One picture is made for each
/// page that the figure takes: it has a row of panels or more.
std::vector<std::string> pgfplots(const Figure& figure);

/// Name of the file of a page, counted from 0: "momentum.tex", "momentum_page_2.tex".
std::string pgfplots_file(const std::string& figure, std::size_t page);

/// Packages that pgfplots() needs.
inline constexpr const char* packages_of_pgfplots =
    "\\usepackage[utf8]{inputenc}\\usepackage[T1]{fontenc}\\usepackage{textcomp,lmodern,pgfplots}"
    "\\usepgfplotslibrary{groupplots}\\pgfplotsset{compat=1.17}";

}  // namespace polhode::study::plot
