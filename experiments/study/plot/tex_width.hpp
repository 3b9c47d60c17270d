// SPDX-License-Identifier: BSD-3-Clause
// The width of a text that LaTeX sets in Latin Modern, so that tables and figures are made to fit a line.
#pragma once

#include <string_view>

namespace polhode::study::inline plot {

/// Width of a line and height of a page of an article of 11 pt on A4 without further packages, pt of TeX.
inline constexpr double tex_line_width = 360, tex_page_height = 595;

enum class TexFont { roman, typewriter, bold };

/// Width of the text in pt of TeX, a little more than LaTeX needs. `size`: of the font, pt. Characters beyond ASCII are
/// taken to be as wide as an average capital.
double tex_width(std::string_view utf8, double size, TexFont font = TexFont::roman);

/// The same for a number as tex_number() writes it: 2.3e-12 has a times sign and a small exponent.
double tex_number_width(std::string_view printed, double size, TexFont font = TexFont::roman);

}  // namespace polhode::study::plot
