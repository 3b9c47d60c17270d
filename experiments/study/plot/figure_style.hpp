// SPDX-License-Identifier: BSD-3-Clause
// The style of figures: colours, markers, dashes, sizes; method_style.hpp has which of them a method has. To change
// it for one study, edit figures/style.gnuplot in its folder, which is written from these values.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace polhode::study::inline plot::style {

/// Colours that colour-blind readers can tell apart (Okabe & Ito 2008; brown in place of their yellow, which is too
/// pale for lines, and a dark magenta).
inline constexpr std::array<std::string_view, 9> colours = {"0072B2", "D55E00", "009E73", "CC79A7", "E69F00",
                                                            "56B4E9", "000000", "8C510A", "A0006E"};

/// A marker by gnuplot's pointtype and PGFPlots' name.
struct Marker {
  int gnuplot;
  std::string_view pgf;
};
inline constexpr std::array<Marker, 13> markers = {{{7, "*"},
                                                    {5, "square*"},
                                                    {9, "triangle*"},
                                                    {13, "diamond*"},
                                                    {15, "pentagon*"},
                                                    {6, "o"},
                                                    {4, "square"},
                                                    {8, "triangle"},
                                                    {12, "diamond"},
                                                    {14, "pentagon"},
                                                    {1, "+"},
                                                    {2, "x"},
                                                    {3, "asterisk"}}};

struct Dash {
  std::string_view gnuplot, pgf;
};
inline constexpr std::array<Dash, 5> dashes = {{{"1", "solid"},
                                                {"(10,5)", "dashed"},
                                                {"(2,3)", "densely dotted"},
                                                {"(10,4,2,4)", "dashdotted"},
                                                {"(10,3,2,3,2,3)", "dashdotdotted"}}};

// Line width by drawing order in the study: later methods are thinner, so that a covered curve remains visible at the
// sides.
constexpr double rank(std::size_t method) { return static_cast<double>(method % colours.size()); }
constexpr double line_width(std::size_t method) { return 2.3 - 0.16 * rank(method); }
constexpr double point_size(std::size_t method) { return 0.95 - 0.03 * rank(method); }
constexpr double mark_size(std::size_t method) { return 1.6 - 0.14 * rank(method); }
/// Number of points from one marker of a curve to the next, so that markers do not run into a band.
constexpr std::size_t points_to_a_mark(std::size_t points) { return points < 30 ? 1 : points / 15; }

inline constexpr double one_column = 8.6, two_columns = 17.8;  // column widths of journals with two columns, cm
inline constexpr double font_size = 9;                         // size of the letters, pt

// Sizes in pixels with letters of this size; 96 pixels are an inch. Those of margins and legends grow with the letters.
inline constexpr double narrowest_panel = 130;
inline constexpr double left_margin = 86, inner_margin = 24, right_margin = 18;
inline constexpr double title_line = 18.5, title_gap = 20, bottom_margin = 58;
inline constexpr double legend_line = 17, legend_gap = 8;
inline constexpr std::array<double, 3> panel_height = {330, 270, 230};  // panel heights with 1, 2, 3 panels in a row
inline constexpr double character_width = 7.4;  // width of the widest usual sans-serif font at this size

}  // namespace polhode::study::inline plot::style
