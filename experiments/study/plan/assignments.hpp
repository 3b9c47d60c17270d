// SPDX-License-Identifier: BSD-3-Clause
// Words of the command line that hold several keys: "dt=1e-3,1e-2 t-end=10,100".
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace polhode::study::inline plan {

/// Splits at the separator, except within (), [], {} and quotes, and trims blanks. Empty items are kept.
std::vector<std::string> split_outside_brackets(std::string_view text, char separator);

/// Keys and values, separated by blanks. Throws InputError, which begins with the label.
std::vector<std::pair<std::string, std::string>> assignments(std::string_view text, const std::string& label);

}  // namespace polhode::study::plan
