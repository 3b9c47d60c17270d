// SPDX-License-Identifier: BSD-3-Clause
// Numbers and names as figures, tables and the report print them, and escaping for each format.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polhode::study::inline text {

/// A measured number to a given number of significant digits: "0.0325", "3.25e-5"; "not finite" if it is not finite.
std::string number(double value, int digits = 3);

/// A given number to 5 significant digits: "0.0021544". runs.csv has all digits.
std::string rounded(double value);
/// The same for a text that is a number; any other text unchanged.
std::string rounded(const std::string& text);

/// A given number with all its digits: "0.001", "1e-5", "2.5e-4".
std::string exact_number(double value);

/// A finite number with an exponent and the fewest digits that read back exactly: "1e-3", "2.5e-4", "1e0".
std::string scientific(double value);

/// "1 run", "2 runs".
std::string count(std::size_t n, std::string_view noun);

/// "a", "a and b", "a, b and c".
std::string words(const std::vector<std::string>& items);

/// The first `most` items and "3 more"; all items if they are not more than `most`.
std::vector<std::string> first_items(std::vector<std::string> items, std::size_t most);

std::string html(std::string_view text);
std::string markdown(std::string_view text);  ///< the text for a cell of a table
std::string tex(std::string_view text);
/// A number printed by number() or exact_number() as LaTeX mathematics: "$3.25\times10^{-5}$".
std::string tex_number(std::string_view printed);
/// The value of a text that tex_number() sets as a number; absent: it sets it as a text.
std::optional<double> printed_number(std::string_view text);
/// A gnuplot string literal in single quotes, in which nothing is expanded. Print it `noenhanced`.
std::string gnuplot(std::string_view text);
/// Text for a comment: one line.
std::string one_line(std::string_view text);

std::string base64(std::string_view bytes);

/// Number of characters, not bytes, of a UTF-8 text.
std::size_t length(std::string_view utf8);
/// The text, shortened to at most that many characters with "…" at the end.
std::string shortened(std::string_view utf8, std::size_t characters);

}  // namespace polhode::study::text
