// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/pgfplots_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_choice.hpp"
#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/plot/latex_table.hpp"
#include "experiments/study/plot/method_style.hpp"
#include "experiments/study/plot/tex_width.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {

namespace {

constexpr std::array<double, 3> panel_height_pt = {185, 142, 114};  // heights of a panel with 1, 2, 3 panels in a row
constexpr double label_size = 9, tick_size = 8;                     // letters, pt
constexpr double label_line = 11, tick_length = 24;  // line of labels and length of ticks with the gaps around them, pt
constexpr double node_margin = 3.7;                  // margin about the text of a node, pt
constexpr double least_height = 130;                 // least height of a panel, pt
constexpr double caption_size = 10, caption_line = 12;  // letters and lines of a caption, pt

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

std::string colour_name(std::size_t colour) { return fmt::format("polhode{}", static_cast<char>('a' + colour)); }

/// Values are written as their place on the axis (decades on logarithmic ones), which spares TeX the arithmetic. A
/// place on a short axis far from zero is counted from its low end: TeX has five digits.
double tex_place(const Axis& axis, double value) {
  const double low = axis.place(axis.low), high = axis.place(axis.high);
  const bool is_far = high - low < 0.01 * std::max(std::abs(low), std::abs(high));
  return axis.place(value) - (is_far ? low : 0);
}

/// Width of the label of a tick, pt; "10^{-4}" has a small exponent.
double tick_width(const Axis& axis, const Tick& tick) {
  if (axis.named) return tex_width(tick.label, tick_size);
  std::string plain = tick.label;
  const auto power = plain.find("^{");
  if (power == std::string::npos) return tex_width(plain, tick_size);
  const std::string exponent = plain.substr(power + 2, plain.size() - power - 3);
  return tex_width(plain.substr(0, power), tick_size) + tex_number_width(exponent, tick_size - 2);
}

double ticks_width(const Axis& axis) {
  double widest = 0;
  for (const auto& tick : axis.ticks) widest = std::max(widest, tick_width(axis, tick));
  return widest;
}

/// `apart`: every how manyth tick has its label.
void write_tex_axis(std::string& out, char name, const Axis& axis, std::size_t apart = 1) {
  std::vector<std::string> at, labels;
  for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
    const Tick& tick = axis.ticks[i];
    at.push_back(fmt::format("{:.6g}", tex_place(axis, tick.at)));
    labels.push_back(!axis.labelled || i % apart != 0 ? "" : axis.named ? tex(tick.label) : tick_label(tick.label));
  }
  tex_line(out, "  {0}min={1:.6g}, {0}max={2:.6g},", name, tex_place(axis, axis.low), tex_place(axis, axis.high));
  tex_line(out, "  {0}tick={{{1}}}, {0}ticklabels={{{2}}},", name, fmt::join(at, ","), fmt::join(labels, ","));
  if (axis.labelled && !axis.label.empty()) tex_line(out, "  {}label={{{}}},", name, tex_breakable(axis.label));
}

std::string shade_name(std::size_t shade) { return fmt::format("polhodeshade{}", static_cast<char>('a' + shade)); }

void write_cells(std::string& out, const Panel& panel) {
  for (const auto& c : panel.cells) {
    tex_line(out, "\\fill[{}] (axis cs:{:.5g},{:.5g}) rectangle (axis cs:{:.5g},{:.5g});", shade_name(c.shade),
             tex_place(panel.x, c.x_low), tex_place(panel.y, c.y_low), tex_place(panel.x, c.x_high),
             tex_place(panel.y, c.y_high));
  }
}

void write_tex_guides(std::string& out, const Panel& panel) {
  for (const auto& guide : panel.guides) {
    tex_line(out, "\\addplot[gray, dashed, no marks, forget plot] coordinates {{({:.5g},{:.5g}) ({:.5g},{:.5g})}};",
             tex_place(panel.x, guide.x0), tex_place(panel.y, guide.y0), tex_place(panel.x, guide.x1),
             tex_place(panel.y, guide.y1));
    tex_line(out, "\\node[right, gray, font=\\scriptsize] at (axis cs:{:.5g},{:.5g}) {{{}}};",
             tex_place(panel.x, guide.x1), tex_place(panel.y, guide.label_y), tick_label(guide.label));
  }
}

void write_tex_envelope(std::string& out, const Panel& panel) {
  if (panel.envelope.empty()) return;
  std::string points;
  for (const auto& mark : panel.envelope) {
    points += fmt::format(" ({:.5g},{:.5g})", tex_place(panel.x, mark.x), tex_place(panel.y, mark.y));
  }
  tex_line(out, "\\addplot[yellow!80!orange!60, line width=4pt, no marks, forget plot] coordinates {{{} }};", points);
  for (const auto& mark : panel.envelope) {
    if (mark.label.empty()) continue;
    tex_line(out, "\\node[below left, orange!50!black, font=\\scriptsize] at (axis cs:{:.5g},{:.5g}) {{{}}};",
             tex_place(panel.x, mark.x), tex_place(panel.y, mark.y), tex(mark.label));
  }
}

void write_points(std::string& out, const Panel& panel, const PlottedCurve& curve, Mark mark,
                  const std::string& options) {
  std::string points;
  int on_line = 0;
  for (const auto& point : curve.points) {
    if (point.mark != mark) continue;
    points += fmt::format("{}({:.5g},{:.5g})", on_line++ % 6 == 0 ? "\n  " : " ", tex_place(panel.x, point.x),
                          tex_place(panel.y, point.drawn));
  }
  if (!points.empty()) tex_line(out, "\\addplot[{}, forget plot] coordinates {{{}\n}};", options, points);
}

/// The name of a cross, shortened to the room beside it in a panel of this width, pt.
std::string name_in(const Panel& panel, const NameMark& mark, double width) {
  if (mark.opaque || mark.above) return mark.name;
  const double low = panel.x.place(panel.x.low), high = panel.x.place(panel.x.high), at = panel.x.place(mark.x);
  const double room = (mark.left ? at - low : high - at) / (high - low) * width - 2 * node_margin;
  std::string name = mark.name;
  for (std::size_t letters = length(name); letters > 4 && tex_width(name, tick_size) > room;)
    name = shortened(mark.name, --letters);
  return name;
}

void write_tex_names(std::string& out, const Panel& panel, const std::vector<MethodStyle>& styles, double width) {
  for (const auto& mark : panel.names) {
    tex_line(out, "\\node[overlay, {}{}, text={}, font=\\scriptsize] at (axis cs:{:.5g},{:.5g}) {{{}}};",
             mark.opaque ? "fill=white, inner sep=1pt, " : "", mark.left ? "left" : "right",
             colour_name(styles[mark.method].colour), tex_place(panel.x, mark.x), tex_place(panel.y, mark.y),
             tex(name_in(panel, mark, width)));
  }
}

void write_curve(std::string& out, const Figure& figure, const Panel& panel, const PlottedCurve& curve,
                 const MethodStyle& method) {
  const auto colour = colour_name(method.colour);
  const bool over_time = panel.x.scale == Scale::linear;
  const std::size_t repeat =
      over_time ? std::max<std::size_t>(1, curve.points.size() / 6) : style::points_to_a_mark(curve.points.size());
  const double size = style::mark_size(curve.method);
  tex_line(out, "% {}", one_line(curve.label));
  if (curve.muted) return write_points(out, panel, curve, Mark::value, "gray!50, thin, mark=*, mark size=0.3pt");
  write_points(
      out, panel, curve, Mark::value,
      fmt::format("{}, {}, line width={:.2f}pt, mark={}, mark size={:.2f}pt, mark options=solid, mark repeat={}",
                  colour,
                  style::dashes[figure.variants.size() > 1 ? curve.variant % style::dashes.size() : method.dash].pgf,
                  0.45 * style::line_width(curve.method), style::markers[method.marker].pgf,
                  2 * style::point_size(curve.method), repeat));
  write_points(
      out, panel, curve, Mark::zero,
      fmt::format("{}, only marks, mark=triangle, mark size={:.2f}pt, mark options={{rotate=180}}", colour, 2 * size));
  write_points(out, panel, curve, Mark::edge,
               fmt::format("{}, only marks, mark=x, mark size={:.2f}pt, thick", colour, 1.4 * size));
}

void write_legend(std::string& out, const Figure& figure, const std::vector<MethodStyle>& styles) {
  const auto entry = [&](const std::string& options, const std::string& text) {
    tex_line(out, "\\addlegendimage{{{}}}\\addlegendentry{{{}}}", options, tex(text));
  };
  for (const auto m : figure.used_methods) {
    const auto dash = figure.variants.size() > 1 ? "solid" : style::dashes[styles[m].dash].pgf;
    entry(fmt::format("{}, {}, mark={}, mark size=1.5pt, mark options=solid", colour_name(styles[m].colour), dash,
                      style::markers[styles[m].marker].pgf),
          figure.methods[m]);
  }
  for (std::size_t v = 0; v < figure.variants.size() && figure.variants.size() > 1; ++v) {
    entry(fmt::format("gray, {}, no marks", style::dashes[v % style::dashes.size()].pgf), figure.variants[v]);
  }
  for (std::size_t s = 0; s < figure.shades.size(); ++s) {
    entry(fmt::format("area legend, draw=gray, fill={}", shade_name(s)), figure.shades[s].label);
  }
  if (figure.has_envelope) entry("yellow!80!orange!60, line width=4pt, no marks", figure.legend.envelope);
  if (figure.has_muted) entry("gray!50, thin, no marks", figure.legend.muted);
  if (figure.has_zero_marks) entry("gray, only marks, mark=triangle, mark options={rotate=180}", figure.legend.zero);
  if (figure.has_edge_marks) entry("gray, only marks, mark=x, thick", figure.legend.edge);
}

/// The rows of the figure that stand on one page.
struct Page {
  std::size_t first = 0, end = 0;  ///< rows
};

/// The legend stands below the first panel of the last row, the width of the figure.
bool carries_legend(const Page& page, const Panel& panel) { return panel.row + 1 == page.end && panel.column == 0; }

/// The room that the panels of a figure leave free, and their size, pt.
struct Frame {
  double left = 0, gap = 0, right = 0, width = 0, height = 0;
  double title_lines = 0;
  double row = 0;  ///< distance from one row of panels to the next
};

/// Width of the whole figure, pt.
double line_width(const Figure& figure) {
  constexpr double points_in_cm = 28.45;
  return figure.look.width_cm ? *figure.look.width_cm * points_in_cm : tex_line_width;
}

/// Width of the widest entry of the legend, pt.
double legend_entry_width(const Figure& figure) {
  constexpr double mark = 36;  // width of a mark, with the room between columns
  double widest = 0;
  const auto take = [&](const std::string& text) { widest = std::max(widest, tex_width(text, label_size)); };
  for (const auto m : figure.used_methods) take(figure.methods[m]);
  for (const auto& variant : figure.variants) take(variant);
  for (const auto& shade : figure.shades) take(shade.label);
  if (figure.has_envelope) take(figure.legend.envelope);
  if (figure.has_muted) take(figure.legend.muted);
  if (figure.has_zero_marks) take(figure.legend.zero);
  if (figure.has_edge_marks) take(figure.legend.edge);
  return widest + mark;
}

std::size_t legend_columns(const Figure& figure) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(line_width(figure) / legend_entry_width(figure)));
}

std::size_t legend_entries(const Figure& figure) {
  return figure.used_methods.size() + (figure.variants.size() > 1 ? figure.variants.size() : 0) + figure.shades.size() +
         figure.has_envelope + figure.has_muted + figure.has_zero_marks + figure.has_edge_marks;
}

void write_panel(std::string& out, const Figure& figure, const Page& page, const Frame& frame, const Panel& panel,
                 const std::vector<MethodStyle>& styles) {
  tex_line(out, "\\nextgroupplot[");
  if (!panel.title.empty()) {
    std::vector<std::string> lines;
    for (const auto& text : panel.title) lines.push_back(tex_breakable(text));
    tex_line(out, "  title={{{}}},", fmt::join(lines, "\\\\"));
  }
  write_tex_axis(out, 'x', panel.x, labels_apart(panel.x, frame.width, ticks_width(panel.x) + node_margin));
  write_tex_axis(out, 'y', panel.y);
  if (carries_legend(page, panel)) {
    tex_line(out,
             "  legend style={{at={{(0,0)}}, xshift=-{:.0f}pt, yshift=-{:.0f}pt, anchor=north west, draw=none, inner "
             "xsep=0pt, font=\\footnotesize, cells={{anchor=west}}, /tikz/every even column/.append style={{column "
             "sep=6pt}}}},\n  legend columns={},",
             frame.left, 2.7 * label_line, legend_columns(figure));
  }
  tex_line(out, "]");
  write_cells(out, panel);
  write_tex_guides(out, panel);
  write_tex_envelope(out, panel);
  write_tex_names(out, panel, styles, frame.width);
  for (const auto& curve : panel.curves) write_curve(out, figure, panel, curve, styles.at(curve.method));
  if (carries_legend(page, panel)) write_legend(out, figure, styles);
}

/// Height of a page that the caption leaves, which the article ends with the number of pages, pt.
double room_beside_caption(const Figure& figure) {
  constexpr double least = 110, gaps = 30, of_typewriter = 1.15;
  const double words =
      tex_width(figure.title + figure.caption + " Page 1 of 10; the others are in the article's folder", caption_size);
  const double lines = std::ceil(of_typewriter * words / tex_line_width) + 1;
  return tex_page_height - std::max(least, gaps + lines * caption_line);
}

/// Lines that a text takes in this width.
double lines_in(const std::string& text, double width) {
  return std::max(1.0, std::ceil(1.25 * tex_width(text, label_size) / width));
}

Frame frame_of(const Figure& figure) {
  Frame f;
  const auto columns = static_cast<double>(figure.columns);
  f.height = figure.panel_height > 0 ? figure.panel_height * line_width(figure) / figure.look.width()
                                     : panel_height_pt[std::min<std::size_t>(figure.columns, 3) - 1];
  f.height = std::clamp(f.height, least_height, room_beside_caption(figure) - 4 * label_line);
  f.gap = 2 * node_margin;
  f.right = node_margin;
  for (const auto& panel : figure.panels) {
    if (panel.y.labelled) {
      const double label = panel.y.label.empty() ? 0 : label_line * lines_in(panel.y.label, f.height + label_line);
      auto& room = panel.column == 0 ? f.left : f.gap;
      room = std::max(room, label + ticks_width(panel.y) + tick_length + (panel.column == 0 ? 0 : f.right));
    }
    double beside = panel.x.ticks.empty() ? 0 : tick_width(panel.x, panel.x.ticks.back()) / 2 + node_margin;
    for (const auto& guide : panel.guides)
      beside = std::max(beside, tex_width(guide.label, tick_size) + 2 * node_margin);
    if (panel.column + 1 == figure.columns) f.right = std::max(f.right, beside);
    else f.gap = std::max(f.gap, beside + (panel.x.ticks.empty() ? 0 : tick_width(panel.x, panel.x.ticks.front()) / 2));
  }
  f.width = (line_width(figure) - f.left - f.right - (columns - 1) * f.gap) / columns;
  for (const auto& panel : figure.panels) {
    double lines = 0;
    for (const auto& text : panel.title) lines += lines_in(text, f.width);
    f.title_lines = std::max(f.title_lines, lines);
  }
  f.row = f.height + (f.title_lines + 3.4) * label_line;
  return f;
}

/// The figure with the panels of these rows alone, and the legend of what stands in them.
Figure part_of(const Figure& whole, const Page& page) {
  Figure part = whole;
  std::erase_if(part.panels, [&](const Panel& panel) { return panel.row < page.first || panel.row >= page.end; });
  std::set<std::size_t> used;
  part.has_envelope = part.has_muted = part.has_zero_marks = part.has_edge_marks = false;
  for (const Panel& panel : part.panels) {
    part.has_envelope |= !panel.envelope.empty();
    for (const PlottedCurve& curve : panel.curves) {
      if (curve.muted) part.has_muted = true;
      else used.insert(curve.method);
      for (const Point& point : curve.points) {
        part.has_zero_marks |= point.mark == Mark::zero;
        part.has_edge_marks |= point.mark == Mark::edge;
      }
    }
  }
  part.used_methods = {used.begin(), used.end()};
  return part;
}

/// Pages with as many rows as fit, the legend among them.
std::vector<Page> pages_of(const Figure& figure, const Frame& frame) {
  const double room = room_beside_caption(figure);
  const auto height = [&](const Page& page) {
    const Figure part = part_of(figure, page);
    const auto legend_lines =
        static_cast<double>((legend_entries(part) + legend_columns(part) - 1) / legend_columns(part));
    return static_cast<double>(page.end - page.first) * frame.row + (legend_lines + 1) * label_line;
  };
  std::vector<Page> pages;
  for (Page page; page.first < figure.rows; page.first = page.end) {
    page.end = page.first + 1;
    while (page.end < figure.rows && height({page.first, page.end + 1}) <= room) ++page.end;
    pages.push_back(page);
  }
  return pages;
}

const Panel* panel_at(const Figure& figure, std::size_t row, std::size_t column) {
  const auto found = std::find_if(figure.panels.begin(), figure.panels.end(),
                                  [&](const auto& panel) { return panel.row == row && panel.column == column; });
  return found == figure.panels.end() ? nullptr : &*found;
}

}  // namespace

namespace {

std::string picture(const Figure& figure, const Frame& frame, const Page& page) {
  std::string out;
  tex_line(out, "\\begin{{tikzpicture}}");
  for (std::size_t c = 0; c < style::colours.size(); ++c) {
    tex_line(out, "\\definecolor{{{}}}{{HTML}}{{{}}}", colour_name(c), style::colours[c]);
  }
  for (std::size_t s = 0; s < figure.shades.size(); ++s) {
    tex_line(out, "\\definecolor{{{}}}{{HTML}}{{{}}}", shade_name(s), figure.shades[s].colour);
  }
  const auto styles = styles_of(figure.methods);
  tex_line(out, "\\begin{{groupplot}}[");
  tex_line(out, "  group style={{group size={} by {}, horizontal sep={:.1f}pt, vertical sep={:.1f}pt}},",
           figure.columns, page.end - page.first, frame.gap, frame.row - frame.height);
  tex_line(out, "  scale only axis, width={:.1f}pt, height={:.1f}pt,", frame.width, frame.height);
  tex_line(out,
           "  axis lines=left, scaled ticks=false, grid=major, grid style={{gray!25}}, clip marker paths=false, clip "
           "mode=individual,");
  tex_line(out,
           "  title style={{align=flush center, text width={0:.0f}pt, font=\\footnotesize}}, label "
           "style={{font=\\footnotesize}},\n  xlabel style={{align=flush center, text width={0:.0f}pt}}, ylabel "
           "style={{align=flush center, text width={1:.0f}pt}},\n  tick label style={{font=\\scriptsize}},",
           frame.width, frame.height + label_line);
  tex_line(out, "]");
  std::size_t skipped = 0;
  for (std::size_t row = page.first; row < page.end; ++row) {
    for (std::size_t column = 0; column < figure.columns; ++column) {
      const auto* panel = panel_at(figure, row, column);
      if (!panel) {
        ++skipped;
        continue;
      }
      for (; skipped > 0; --skipped) tex_line(out, "\\nextgroupplot[group/empty plot, xmin=0, xmax=1, ymin=0, ymax=1]");
      write_panel(out, figure, page, frame, *panel, styles);
    }
  }
  tex_line(out, "\\end{{groupplot}}\n\\end{{tikzpicture}}");
  return out;
}

}  // namespace

std::string pgfplots_file(const std::string& figure, std::size_t page) {
  return page == 0 ? figure + ".tex" : fmt::format("{}_page_{}.tex", figure, page + 1);
}

std::vector<std::string> pgfplots(const Figure& given) {
  const Figure figure = fitted(given);
  const Frame frame = frame_of(figure);
  const std::vector<Page> pages = pages_of(figure, frame);
  std::vector<std::string> texts;
  for (std::size_t p = 0; p < pages.size(); ++p) {
    std::string out;
    tex_line(out, "% {}: {}", figure.name, one_line(figure.title));
    if (pages.size() > 1) tex_line(out, "% Page {} of {}.", p + 1, pages.size());
    tex_line(out, "% {}", one_line(figure.caption));
    tex_line(out, "% \\input this file inside a figure environment. The preamble needs:");
    tex_line(out, "%   {}", packages_of_pgfplots);
    tex_line(
        out,
        "% Coordinates are places on the axes: decades on logarithmic ones; from its low end on a short axis far from "
        "zero;");
    tex_line(out, "% on an axis that is logarithmic on both sides of");
    tex_line(out, "% zero sgn(y) asinh(|y|/threshold)/ln 10. {}.dat has the numbers themselves.", figure.name);
    texts.push_back(out + picture(part_of(figure, pages[p]), frame, pages[p]));
  }
  return texts;
}

}  // namespace polhode::study::plot
