// SPDX-License-Identifier: BSD-3-Clause
// Values of an option, parsed from the text on the command line or in a study file.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/run_options.hpp"

namespace polhode::study::inline plan {

/// The values in the order of the text. Throws InputError, which begins with the label, for an invalid value.
std::vector<OptionValue> option_values(const RunOption& option, const std::string& text, const std::string& label);

/// A number as a value of the option. Throws InputError, which begins with the label, if it is none.
OptionValue option_value(const RunOption& option, double x, const std::string& label);

/// The numbers of an option that is no name, in ascending order without duplicates. option_value() takes each of them.
/// Throws InputError, which begins with the label, for an invalid one.
std::vector<double> axis_numbers(const RunOption& option, const std::string& text, const std::string& label);

/// The values without duplicates: names in the given order, numbers in ascending order.
std::vector<OptionValue> axis_values(const RunOption& option, const std::string& text, const std::string& label);

}  // namespace polhode::study::plan
