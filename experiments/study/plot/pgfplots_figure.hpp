// SPDX-License-Identifier: BSD-3-Clause
// A figure in LaTeX: a tikzpicture of PGFPlots that needs no other file.
#pragma once

#include <string>

#include "experiments/study/plot/figure.hpp"

namespace polhode::study::inline plot {

std::string pgfplots(const Figure& figure);

}  // namespace polhode::study::plot
