// SPDX-License-Identifier: BSD-3-Clause
// How figures, tables and the report print numbers and names, and how each format wants a text escaped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace polhode::study::inline text {

/// A measured number to so many significant digits: "0.0325", "3.25e-5"; "not finite" if it is not.
std::string number(double value, int digits = 3);

/// A number that was given, as people read it, to 5 significant digits: "0.0021544". runs.csv has all of them.
std::string rounded(double value);
/// The same of a text that is a number; any other text as it is.
std::string rounded(const std::string& text);

/// A given number with all its digits: "0.001", "1e-5", "2.5e-4".
std::string exact_number(double value);

/// With an exponent and no more digits than it takes to read it back: "1e-3", "2.5e-4", "1e0". Finite values only.
std::string scientific(double value);

/// "1 run", "2 runs".
std::string count(std::size_t n, std::string_view noun);

/// "a", "a and b", "a, b and c".
std::string words(const std::vector<std::string>& items);

std::string html(std::string_view text);
std::string markdown(std::string_view text);  ///< for a cell of a table
std::string tex(std::string_view text);
/// What number() or exact() printed, as LaTeX mathematics: "$3.25\times10^{-5}$".
std::string tex_number(std::string_view printed);
/// A string literal of gnuplot, in single quotes, in which nothing is expanded. Print it `noenhanced`.
std::string gnuplot(std::string_view text);
/// For a comment: one line.
std::string one_line(std::string_view text);

std::string base64(std::string_view bytes);

/// Characters, not bytes, of a text in UTF-8.
std::size_t length(std::string_view utf8);
/// The text itself, or its beginning and "…", so many characters at most.
std::string shortened(std::string_view utf8, std::size_t characters);

}  // namespace polhode::study::report
