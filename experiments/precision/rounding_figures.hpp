// SPDX-License-Identifier: BSD-3-Clause
// The figures of the experiment: errors against the step and against time, one colour for each precision, dashes for
// compensated summation.
#pragma once

#include <vector>

#include "experiments/precision/families.hpp"
#include "experiments/study/plot/figure.hpp"

namespace polhode::study {

std::vector<report::Figure> rounding_figures(const std::vector<precision::Problem>& problems);

}  // namespace polhode::study
