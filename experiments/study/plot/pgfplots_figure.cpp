// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/pgfplots_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {

namespace {

constexpr double text_width_cm = 12.5;  // just below that of an article of 11 pt on A4, 360 pt
constexpr std::array<double, 3> panel_height_cm = {8, 6.5, 5.5};  // with 1, 2, 3 panels in a row

template <class... T>
void tex_line(std::string& out, fmt::format_string<T...> format, T&&... values) {
  fmt::format_to(std::back_inserter(out), format, std::forward<T>(values)...);
  out += '\n';
}

/// "−10^{-4}" → "$-10^{-4}$".
std::string tick_label(std::string label) {
  constexpr std::string_view minus = "−";
  if (const auto at = label.find(minus); at != std::string::npos) label.replace(at, minus.size(), "-");
  return "$" + label + "$";
}

std::string colour_name(std::size_t method) {
  return fmt::format("polhode{}", static_cast<char>('a' + method % style::colours.size()));
}

/// Values are written as their place on the axis (decades on logarithmic ones), which spares TeX the arithmetic.
void write_tex_axis(std::string& out, char name, const Axis& axis) {
  std::vector<std::string> at, labels;
  for (const auto& tick : axis.ticks) {
    at.push_back(fmt::format("{:.6g}", axis.place(tick.at)));
    labels.push_back(!axis.labelled ? "" : axis.named ? tex(tick.label) : tick_label(tick.label));
  }
  tex_line(out, "  {0}min={1:.6g}, {0}max={2:.6g},", name, axis.place(axis.low), axis.place(axis.high));
  tex_line(out, "  {0}tick={{{1}}}, {0}ticklabels={{{2}}},", name, fmt::join(at, ","), fmt::join(labels, ","));
  if (axis.labelled && !axis.label.empty()) tex_line(out, "  {}label={{{}}},", name, tex(axis.label));
}

std::string shade_name(std::size_t shade) { return fmt::format("polhodeshade{}", static_cast<char>('a' + shade)); }

void write_cells(std::string& out, const Panel& panel) {
  for (const auto& c : panel.cells) {
    tex_line(out, "\\fill[{}] (axis cs:{:.5g},{:.5g}) rectangle (axis cs:{:.5g},{:.5g});", shade_name(c.shade),
             panel.x.place(c.x_low), panel.y.place(c.y_low), panel.x.place(c.x_high), panel.y.place(c.y_high));
  }
}

void write_tex_guides(std::string& out, const Panel& panel) {
  for (const auto& guide : panel.guides) {
    tex_line(out, "\\addplot[gray, dashed, no marks, forget plot] coordinates {{({:.5g},{:.5g}) ({:.5g},{:.5g})}};",
             panel.x.place(guide.x0), panel.y.place(guide.y0), panel.x.place(guide.x1), panel.y.place(guide.y1));
    tex_line(out, "\\node[right, gray, font=\\scriptsize] at (axis cs:{:.5g},{:.5g}) {{${}$}};",
             panel.x.place(guide.x1), panel.y.place(guide.label_y), guide.label);
  }
}

void write_tex_envelope(std::string& out, const Panel& panel) {
  if (panel.envelope.empty()) return;
  std::string points;
  for (const auto& mark : panel.envelope) {
    points += fmt::format(" ({:.5g},{:.5g})", panel.x.place(mark.x), panel.y.place(mark.y));
  }
  tex_line(out, "\\addplot[yellow!80!orange!60, line width=4pt, no marks, forget plot] coordinates {{{} }};", points);
  for (const auto& mark : panel.envelope) {
    if (mark.label.empty()) continue;
    tex_line(out, "\\node[below left, orange!50!black, font=\\scriptsize] at (axis cs:{:.5g},{:.5g}) {{{}}};",
             panel.x.place(mark.x), panel.y.place(mark.y), tex(mark.label));
  }
}

void write_points(std::string& out, const Panel& panel, const PlottedCurve& curve, Mark mark,
                  const std::string& options) {
  std::string points;
  int on_line = 0;
  for (const auto& point : curve.points) {
    if (point.mark != mark) continue;
    points += fmt::format("{}({:.5g},{:.5g})", on_line++ % 6 == 0 ? "\n  " : " ", panel.x.place(point.x),
                          panel.y.place(point.drawn));
  }
  if (!points.empty()) tex_line(out, "\\addplot[{}, forget plot] coordinates {{{}\n}};", options, points);
}

void write_curve(std::string& out, const Panel& panel, const PlottedCurve& curve) {
  const auto colour = colour_name(curve.method);
  const bool over_time = panel.x.scale == Scale::linear;
  const std::size_t repeat = over_time ? std::max<std::size_t>(1, curve.points.size() / 6) : 1;
  const double size = style::mark_size(curve.method);
  tex_line(out, "% {}", one_line(curve.label));
  if (curve.muted) return write_points(out, panel, curve, Mark::value, "gray!50, thin, mark=*, mark size=0.3pt");
  write_points(
      out, panel, curve, Mark::value,
      fmt::format("{}, {}, line width={:.2f}pt, mark={}, mark size={:.2f}pt, mark options=solid, mark repeat={}",
                  colour, style::dash(curve.variant).pgf, 0.45 * style::line_width(curve.method),
                  style::pgf_mark(curve.method, curve.variant), 2 * style::point_size(curve.method), repeat));
  write_points(
      out, panel, curve, Mark::zero,
      fmt::format("{}, only marks, mark=triangle, mark size={:.2f}pt, mark options={{rotate=180}}", colour, 2 * size));
  write_points(out, panel, curve, Mark::edge,
               fmt::format("{}, only marks, mark=x, mark size={:.2f}pt, thick", colour, 2 * size));
}

void write_legend(std::string& out, const Figure& figure) {
  const auto entry = [&](const std::string& options, const std::string& text) {
    tex_line(out, "\\addlegendimage{{{}}}\\addlegendentry{{{}}}", options, tex(text));
  };
  for (const auto m : figure.used_methods) {
    entry(fmt::format("{}, mark={}, mark size=1.5pt", colour_name(m), style::pgf_mark(m, 0)), figure.methods[m]);
  }
  for (std::size_t v = 0; v < figure.variants.size() && figure.variants.size() > 1; ++v) {
    entry(fmt::format("gray, {}, no marks", style::dash(v).pgf), figure.variants[v]);
  }
  for (std::size_t s = 0; s < figure.shades.size(); ++s) {
    entry(fmt::format("area legend, draw=gray, fill={}", shade_name(s)), figure.shades[s].label);
  }
  if (figure.has_envelope) entry("yellow!80!orange!60, line width=4pt, no marks", "lower envelope");
  if (figure.has_muted) entry("gray!50, thin, no marks", "other methods");
  if (figure.has_zero_marks) entry("gray, only marks, mark=triangle, mark options={rotate=180}", "exactly zero");
  if (figure.has_edge_marks) entry("gray, only marks, mark=x, thick", "diverged or off scale");
}

/// The legend stands below the first panel of the last row, the width of the figure.
bool carries_legend(const Figure& figure, const Panel& panel) {
  return panel.row + 1 == figure.rows && panel.column == 0;
}

std::size_t legend_columns(const Figure& figure) {
  constexpr std::size_t characters_in_line = 66;  // of a footnote, with the marks
  std::size_t longest = figure.has_edge_marks ? 21 : 12;
  for (const auto m : figure.used_methods) longest = std::max(longest, length(figure.methods[m]));
  for (const auto& variant : figure.variants) longest = std::max(longest, length(variant));
  for (const auto& shade : figure.shades) longest = std::max(longest, length(shade.label));
  return std::max<std::size_t>(1, characters_in_line / (longest + 6));
}

void write_panel(std::string& out, const Figure& figure, const Panel& panel) {
  tex_line(out, "\\nextgroupplot[");
  if (!panel.title.empty()) {
    std::vector<std::string> lines;
    for (const auto& text : panel.title) lines.push_back(tex(text));
    tex_line(out, "  title={{{}}},", fmt::join(lines, "\\\\"));
  }
  write_tex_axis(out, 'x', panel.x);
  write_tex_axis(out, 'y', panel.y);
  if (carries_legend(figure, panel)) {
    tex_line(
        out,
        "  legend style={{at={{(0,-0.28)}}, anchor=north west, draw=none, font=\\footnotesize, cells={{anchor=west}}, "
        "/tikz/every even column/.append style={{column sep=8pt}}}},\n  legend columns={},",
        legend_columns(figure));
  }
  tex_line(out, "]");
  write_cells(out, panel);
  write_tex_guides(out, panel);
  write_tex_envelope(out, panel);
  for (const auto& curve : panel.curves) write_curve(out, panel, curve);
  if (carries_legend(figure, panel)) write_legend(out, figure);
}

/// The room on the left: names take more than numbers.
double labels_width_cm(const Figure& figure) {
  double width = 1.9;
  for (const auto& panel : figure.panels) {
    for (const auto& tick : panel.y.ticks) {
      if (panel.y.named) width = std::max(width, 0.14 * static_cast<double>(length(tick.label)));
    }
  }
  return width;
}

const Panel* panel_at(const Figure& figure, std::size_t row, std::size_t column) {
  const auto found = std::find_if(figure.panels.begin(), figure.panels.end(),
                                  [&](const auto& panel) { return panel.row == row && panel.column == column; });
  return found == figure.panels.end() ? nullptr : &*found;
}

}  // namespace

std::string pgfplots(const Figure& figure) {
  std::string out;
  tex_line(out, "% {}: {}", figure.name, one_line(figure.title));
  tex_line(out, "% {}", one_line(figure.caption));
  tex_line(out, "% \\input this file inside a figure environment. The preamble needs:");
  tex_line(out, "%   \\usepackage[utf8]{{inputenc}}\\usepackage[T1]{{fontenc}}\\usepackage{{pgfplots}}");
  tex_line(out, "%   \\usepgfplotslibrary{{groupplots}}\\pgfplotsset{{compat=1.17}}");
  tex_line(out,
           "% Coordinates are places on the axes: decades on logarithmic ones; on an axis that is logarithmic on both "
           "sides of");
  tex_line(out, "% zero sgn(y) asinh(|y|/threshold)/ln 10. {}.dat has the numbers themselves.", figure.name);
  tex_line(out, "\\begin{{tikzpicture}}");
  for (std::size_t c = 0; c < style::colours.size(); ++c) {
    tex_line(out, "\\definecolor{{{}}}{{HTML}}{{{}}}", colour_name(c), style::colours[c]);
  }
  for (std::size_t s = 0; s < figure.shades.size(); ++s) {
    tex_line(out, "\\definecolor{{{}}}{{HTML}}{{{}}}", shade_name(s), figure.shades[s].colour);
  }
  const auto columns = static_cast<double>(figure.columns);
  const bool close = std::none_of(figure.panels.begin(), figure.panels.end(),
                                  [](const auto& p) { return p.column > 0 && p.y.labelled; });
  const double gap = close ? 0.4 : 1.9;
  std::size_t title_lines = 0;
  for (const auto& panel : figure.panels) title_lines = std::max(title_lines, panel.title.size());
  tex_line(out, "\\begin{{groupplot}}[");
  tex_line(out, "  group style={{group size={} by {}, horizontal sep={}cm, vertical sep={}cm}},", figure.columns,
           figure.rows, gap, 1.7 + 0.4 * static_cast<double>(title_lines));
  const double height = figure.panel_height > 0 ? figure.panel_height * text_width_cm / style::figure_width
                                                : panel_height_cm[std::min<std::size_t>(figure.columns, 3) - 1] - 1.5;
  tex_line(out, "  scale only axis, width={:.2f}cm, height={:.4g}cm,",
           (text_width_cm - labels_width_cm(figure) - (columns - 1) * gap) / columns, height);
  tex_line(out,
           "  axis lines=left, grid=major, grid style={{gray!25}}, clip marker paths=false, clip mode=individual,");
  tex_line(out,
           "  title style={{align=center, font=\\footnotesize}}, label style={{font=\\footnotesize}}, tick label "
           "style={{font=\\scriptsize}},");
  tex_line(out, "]");
  for (std::size_t row = 0; row < figure.rows; ++row) {
    for (std::size_t column = 0; column < figure.columns; ++column) {
      if (const auto* panel = panel_at(figure, row, column)) write_panel(out, figure, *panel);
      else tex_line(out, "\\nextgroupplot[group/empty plot]");
    }
  }
  tex_line(out, "\\end{{groupplot}}\n\\end{{tikzpicture}}");
  return out;
}

}  // namespace polhode::study::plot
