// SPDX-License-Identifier: BSD-3-Clause
// The values of an axis as written on the command line: lists a,b,c and ranges first:last:count[:log].
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polhode::study::inline text {

/// Splits at the separator and trims blanks. Throws InputError, naming `option`, for an empty list or item.
std::vector<std::string> split_list(std::string_view text, char separator, const std::string& option);

/// Numbers: 0.1,0.2, or 1e-4:1e-1:10 (evenly spaced, ends included), or 1e-4:1e-1:10:log. Throws InputError.
std::vector<double> numbers(std::string_view text, const std::string& option);

/// TOML values for --vary: [1,2,3];[4,5,6], or numbers as above, or texts.
std::vector<std::string> toml_values(std::string_view text, const std::string& option);

/// The numbers of a text whose toml_values() are all exact() texts of numbers. Throws InputError as toml_values().
std::optional<std::vector<double>> toml_numbers(std::string_view text, const std::string& option);

/// The number of values that numbers() or toml_values() makes of the text, counted without making them. For a text that
/// they refuse it is any number.
std::size_t count_values(std::string_view text);

/// A finite number, if the whole text is one.
std::optional<double> to_number(std::string_view text);

/// The shortest text that reads back as the same double.
std::string exact(double x);
/// Adds exact(x) to a text.
void add_exact(std::string& out, double x);

}  // namespace polhode::study::text
