// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/tex_width.hpp"

#include <array>
#include <cmath>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {
namespace {

/// Widths of the characters from ' ' to '~' of the roman font at 10 pt, thousandths of its size.
constexpr std::array<short, 95> roman = {
    333, 278, 500, 833, 500, 833, 778, 278,  389, 389, 500, 778, 278, 333, 278, 500,  //  !"#$%&'()*+,-./
    500, 500, 500, 500, 500, 500, 500, 500,  500, 500, 278, 278, 778, 778, 778, 472,  // 0-9 :;<=>?
    778, 750, 708, 722, 764, 681, 653, 785,  750, 361, 514, 778, 625, 917, 750, 778,  // @A-O
    681, 778, 736, 556, 722, 750, 750, 1028, 750, 750, 611, 278, 500, 278, 500, 695,  // P-Z [\]^_
    278, 500, 556, 444, 556, 444, 306, 500,  556, 278, 306, 528, 278, 833, 556, 500,  // `a-o
    556, 528, 392, 394, 389, 556, 528, 722,  528, 528, 444, 500, 278, 500, 500};      // p-z {|}~
constexpr double of_other = 800, of_typewriter = 525, bold_over_roman = 1.16;

/// Fonts of small sizes are drawn wider.
double design(double size) { return size >= 10 ? 1 : size >= 9 ? 1.028 : size >= 8 ? 1.063 : size >= 7 ? 1.139 : 1.22; }

}  // namespace

double tex_width(std::string_view utf8, double size, TexFont font) {
  if (font == TexFont::typewriter) return static_cast<double>(length(utf8)) * of_typewriter * size / 1000;
  double sum = 0;
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) sum += roman[byte - 0x20];
    else if ((byte & 0xC0) != 0x80) sum += of_other;
  }
  return sum * size * design(size) * (font == TexFont::bold ? bold_over_roman : 1) / 1000;
}

double tex_number_width(std::string_view printed, double size, TexFont font) {
  const auto e = printed.find('e');
  if (!printed_number(printed)) return tex_width(printed, size, font);
  const auto minus_as_wide_as = [](std::string_view text) { return text.starts_with('-') ? 0.45 : 0.0; };
  if (e == std::string_view::npos) return tex_width(printed, size, font) + size * minus_as_wide_as(printed);
  const auto mantissa = printed.substr(0, e), exponent = printed.substr(e + 1);
  double width = tex_width("10", size, font) + tex_width(exponent, size - 3, font) + size * minus_as_wide_as(exponent);
  if (mantissa != "1") width += tex_width(mantissa, size, font) + size * (1.25 + minus_as_wide_as(mantissa));
  return width;
}

}  // namespace polhode::study::plot
