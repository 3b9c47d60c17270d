// SPDX-License-Identifier: BSD-3-Clause
// Figures of the experiment: errors against the step and against time, one colour for each precision, dashed lines for
// compensated summation.
#pragma once

#include <vector>

#include "experiments/precision/families.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study::precision {

std::vector<Figure> rounding_figures(const std::vector<precision::RoundingProblem>& problems);

}  // namespace polhode::study::precision
