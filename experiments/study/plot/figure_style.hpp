// SPDX-License-Identifier: BSD-3-Clause
// The style of all figures: colours, markers, dashes, sizes. To change it for one study, edit figures/style.gnuplot in
// its folder, which is written from these values.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace polhode::study::inline plot::style {

/// Colours that colour-blind readers can tell apart (Okabe & Ito 2008, brown in place of their yellow, which is too
/// pale for lines).
inline constexpr std::array<std::string_view, 8> colours = {"0072B2", "D55E00", "009E73", "CC79A7",
                                                            "E69F00", "56B4E9", "000000", "8C510A"};

/// A marker by gnuplot's pointtype and PGFPlots' name; the second variant of a formulation has the open marker.
struct Marker {
  int filled, open;
  std::string_view pgf_filled, pgf_open;
};
inline constexpr std::array<Marker, 5> markers = {{{7, 6, "*", "o"},
                                                   {5, 4, "square*", "square"},
                                                   {9, 8, "triangle*", "triangle"},
                                                   {13, 12, "diamond*", "diamond"},
                                                   {15, 14, "pentagon*", "pentagon"}}};

struct Dash {
  std::string_view gnuplot, pgf;
};
inline constexpr std::array<Dash, 4> dashes = {
    {{"1", "solid"}, {"(10,5)", "dashed"}, {"(2,3)", "densely dotted"}, {"(10,4,2,4)", "dashdotted"}}};

// A method determines colour and marker together; the combinations repeat after 8 × 5 methods.
constexpr std::string_view colour(std::size_t method) { return colours[method % colours.size()]; }
constexpr const Marker& marker(std::size_t method) { return markers[method % markers.size()]; }
constexpr const Dash& dash(std::size_t variant) { return dashes[variant % dashes.size()]; }
constexpr int point_type(std::size_t method, std::size_t variant) {
  return variant % 2 == 0 ? marker(method).filled : marker(method).open;
}
// Line width by drawing order: later methods are thinner, so that a covered curve remains visible at the sides.
constexpr double rank(std::size_t method) { return static_cast<double>(method % colours.size()); }
constexpr double line_width(std::size_t method) { return 2.3 - 0.16 * rank(method); }
constexpr double point_size(std::size_t method) { return 0.95 - 0.05 * rank(method); }
constexpr double mark_size(std::size_t method) { return 1.6 - 0.14 * rank(method); }
constexpr std::string_view pgf_mark(std::size_t method, std::size_t variant) {
  return variant % 2 == 0 ? marker(method).pgf_filled : marker(method).pgf_open;
}

// Sizes in pixels of the SVG; 96 pixels are an inch of the PDF.
inline constexpr double figure_width = 800;
inline constexpr double font_size = 12;
inline constexpr double left_margin = 86, inner_margin = 24, right_margin = 18;
inline constexpr double title_line = 18.5, title_gap = 20, bottom_margin = 58;
inline constexpr double legend_line = 20, legend_gap = 8;
inline constexpr std::array<double, 3> panel_height = {330, 270, 230};  // with 1, 2, 3 panels in a row
inline constexpr double character_width = 7.4;  // of the widest usual sans-serif font at this size

}  // namespace polhode::study::inline plot::style
