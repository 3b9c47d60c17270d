// SPDX-License-Identifier: BSD-3-Clause
// Values of an axis, parsed from the text on the command line or in a study file.
#pragma once

#include <vector>

#include "experiments/study/plan/options.hpp"
#include "experiments/study/record/run_options.hpp"

namespace polhode::study::inline plan {

/// The values of the option without duplicates: names in the given order, numbers in ascending order. Empty if the axis
/// is not given. Throws InputError, which names the axis, for an invalid value.
std::vector<OptionValue> axis_values(const RunOption& option, const Options& options);

}  // namespace polhode::study::plan
