// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/gnuplot_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_choice.hpp"
#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/plot/method_style.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {

namespace {

template <class... T>
void line(std::string& out, fmt::format_string<T...> format, T&&... values) {
  fmt::format_to(std::back_inserter(out), format, std::forward<T>(values)...);
  out += '\n';
}

/// Line styles: 1, 2, … of methods with their own dash; 1001, … of those with the dash of variant 0, 2001, … 1. The
/// styles of a figure begin after the first ones.
struct StyleNumbers {
  std::size_t first;
  bool by_variant;

  std::size_t of(std::size_t method, std::size_t variant) const {
    return (by_variant ? 1000 * (variant + 1) : 0) + first + method + 1;
  }
};

/// Letters of the longest label, an exponent's half as wide.
double longest_label(const Axis& axis) {
  double longest = 0;
  for (const Tick& tick : axis.ticks) {
    const std::size_t power = tick.label.find("^{");
    const auto letters = static_cast<double>(length(tick.label));
    longest = std::max(longest, power == std::string::npos ? letters : (letters - 3 + static_cast<double>(power)) / 2);
  }
  return longest;
}

/// Positions of all parts of the figure, in pixels from the top left corner.
class Layout {
 public:
  explicit Layout(const Figure& figure) : figure_(figure) {
    for (const auto& panel : figure.panels) title_lines_ = std::max(title_lines_, title(panel).size());
    double y = (style::legend_gap + (figure.look.title ? style::title_line : 0)) * scale_;
    const double legend = (static_cast<double>(legend_rows()) * style::legend_line + 2 * style::legend_gap) * scale_;
    if (is_high()) {
      legend_top_ = y - style::legend_gap * scale_;
      y += legend;
    }
    for (std::size_t row = 0; row < figure.rows; ++row) {
      tops_.push_back(y + (style::title_gap + static_cast<double>(title_lines_) * style::title_line) * scale_);
      y = tops_.back() + plot_height() + style::bottom_margin * scale_;
    }
    if (!is_high()) {
      legend_top_ = y;
      y += legend;
    }
    height_ = y;
  }

  double width() const { return figure_.look.width(); }
  double height() const { return height_; }
  double plot_height() const {
    if (figure_.panel_height > 0) return figure_.panel_height;
    const double height = style::panel_height[std::min<std::size_t>(figure_.columns, 3) - 1];
    return figure_.columns == 1 ? std::min(height, 0.9 * plot_width()) : height;  // in one column no tower
  }

  // Edges of a panel as gnuplot's screen coordinates, from the bottom left.
  double left(const Panel& panel) const { return x(panel.column) / width(); }
  double right(const Panel& panel) const { return (x(panel.column) + plot_width()) / width(); }
  double top(const Panel& panel) const { return 1 - tops_[panel.row] / height_; }
  double bottom(const Panel& panel) const { return 1 - (tops_[panel.row] + plot_height()) / height_; }
  double title_line() const { return 1 - (style::legend_gap + style::title_line / 2) * scale_ / height_; }
  double legend_top() const { return 1 - (legend_top_ + style::legend_gap * scale_) / height_; }

  std::size_t x_labels_apart(const Panel& panel) const {
    return labels_apart(panel.x, plot_width(), (longest_label(panel.x) + 1) * style::character_width * scale_);
  }

  /// The rows of a panel's title. One that is too long goes on in another, after an underscore or a space.
  std::vector<std::string> title(const Panel& panel) const {
    const auto most = static_cast<std::size_t>(plot_width() / (style::character_width * scale_));
    std::vector<std::string> rows;
    for (std::string row : panel.title) {
      while (length(row) > most) {
        const auto end = row.find_last_of("_ ", most - 1);
        if (end == std::string::npos) break;
        rows.push_back(row.substr(0, end + 1));
        row.erase(0, end + 1);
      }
      rows.push_back(shortened(row, most));
    }
    return rows;
  }

  std::size_t legend_columns() const {
    std::size_t longest = 1;
    for (const auto& text : legend_texts()) longest = std::max(longest, length(text));
    const double entry = (static_cast<double>(longest) * style::character_width + 60) * scale_;
    return std::max<std::size_t>(1, static_cast<std::size_t>((width() - 20) / entry));
  }

  std::vector<std::string> legend_texts() const {
    std::vector<std::string> texts;
    for (const auto m : figure_.used_methods) texts.push_back(figure_.methods[m]);
    if (figure_.variants.size() > 1) texts.insert(texts.end(), figure_.variants.begin(), figure_.variants.end());
    for (const auto& shade : figure_.shades) texts.push_back(shade.label);
    if (figure_.has_envelope) texts.push_back(figure_.legend.envelope);
    if (figure_.has_muted) texts.push_back(figure_.legend.muted);
    if (figure_.has_zero_marks) texts.push_back(figure_.legend.zero);
    if (figure_.has_edge_marks) texts.push_back(figure_.legend.edge);
    return texts;
  }

 private:
  /// The first panels of a high figure are seen without what is below them, so that its legend stands above them.
  bool is_high() const { return static_cast<double>(figure_.rows) * plot_height() > 450; }

  std::size_t legend_rows() const { return (legend_texts().size() + legend_columns() - 1) / legend_columns(); }

  /// Room for the labels of the ticks of y axes: names, numbers of many digits.
  double left_margin() const {
    double widest = 0;
    for (const auto& panel : figure_.panels) {
      const double beside = panel.y.named ? 20 : style::title_line + 26;  // no label, or one turned upright
      for (const auto& tick : panel.y.ticks)
        if (tick.label.find('^') == std::string::npos)
          widest = std::max(widest, beside + style::character_width * static_cast<double>(length(tick.label)));
    }
    return std::max(style::left_margin, widest) * scale_;
  }

  /// Columns without labels on their y axis stand close to the one on their left.
  double gap(std::size_t column) const {
    if (column == 0) return left_margin();
    const bool labelled = std::any_of(figure_.panels.begin(), figure_.panels.end(),
                                      [&](const auto& p) { return p.column == column && p.y.labelled; });
    return labelled ? left_margin() : style::inner_margin * scale_;
  }
  double plot_width() const {
    double free = width() - style::right_margin * scale_;
    for (std::size_t c = 0; c < figure_.columns; ++c) free -= gap(c);
    return free / static_cast<double>(figure_.columns);
  }
  double x(std::size_t column) const {
    double at = 0;
    for (std::size_t c = 0; c <= column; ++c) at += gap(c) + (c > 0 ? plot_width() : 0);
    return at;
  }

  const Figure& figure_;
  double scale_ = figure_.look.font_size / style::font_size;
  std::size_t title_lines_ = 0;
  std::vector<double> tops_;
  double legend_top_ = 0, height_ = 0;
};

/// `apart`: every how manyth tick has its label.
std::string ticks(const Axis& axis, std::size_t apart) {
  std::string list;
  for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
    const Tick& tick = axis.ticks[i];
    list +=
        fmt::format("{}'{}' {}", list.empty() ? "" : ", ", axis.labelled && i % apart == 0 ? tick.label : "", tick.at);
  }
  return "(" + list + ")";
}

void write_axis(std::string& out, char name, const Axis& axis, std::size_t apart = 1) {
  line(out, "  set {}range [{}:{}]", name, axis.low, axis.high);
  if (axis.scale == Scale::logarithmic) line(out, "  set logscale {}", name);
  if (axis.scale == Scale::symlog) {
    line(out,
         "  set nonlinear {0} via sgn({0})*asinh(abs({0})/{1})/log(10) inverse sgn({0})*{1}*sinh(abs({0})*log(10))",
         name, axis.threshold);
  }
  line(out, "  set {}tics {}{}", name, ticks(axis, apart), axis.named ? " noenhanced" : "");
  if (axis.labelled && !axis.label.empty()) line(out, "  set {}label {} noenhanced", name, gnuplot(axis.label));
  else line(out, "  unset {}label", name);
}

void write_title(std::string& out, const std::vector<std::string>& rows) {
  if (rows.empty()) return line(out, "  unset title");
  std::string text;
  for (const auto& row : rows) text += (text.empty() ? "" : ".\"\\n\".") + gnuplot(row);
  line(out, "  set title {} noenhanced", text);
}

void write_guides(std::string& out, const Panel& panel) {
  line(out, "  unset arrow\n  unset label");
  for (const auto& guide : panel.guides) {
    line(out, "  set arrow from first {},{} to first {},{} nohead back linestyle 9001", guide.x0, guide.y0, guide.x1,
         guide.y1);
    line(out, "  set label '{}' at first {},{} left offset character 0.4,0 front textcolor rgb '#555555'", guide.label,
         guide.x1, guide.label_y);
  }
}

void write_envelope(std::string& out, const Panel& panel) {
  for (std::size_t i = 0; i + 1 < panel.envelope.size(); ++i) {
    const auto &a = panel.envelope[i], &b = panel.envelope[i + 1];
    line(out, "  set arrow from first {},{} to first {},{} nohead back linestyle 9002", a.x, a.y, b.x, b.y);
  }
  for (const auto& mark : panel.envelope) {
    if (mark.label.empty()) continue;
    line(out, "  set label {} at first {},{} right offset character -0.8,-0.6 front noenhanced textcolor rgb '#7a5c00'",
         gnuplot(mark.label), mark.x, mark.y);
  }
}

void write_names(std::string& out, const Panel& panel, const std::vector<MethodStyle>& styles) {
  for (const auto& mark : panel.names) {
    line(out,
         "  set label {} at first {},{} {} offset character {},{} front noenhanced font small textcolor rgb '{}'{}",
         gnuplot(mark.name), mark.x, mark.y, mark.left ? "right" : "left", mark.left ? "-1" : "1",
         mark.above ? "0.5" : "0", html_colour(styles[mark.method]), mark.opaque ? " boxed" : "");
  }
}

bool has(const PlottedCurve& curve, Mark mark) {
  return std::any_of(curve.points.begin(), curve.points.end(), [&](const auto& point) { return point.mark == mark; });
}

std::vector<MapCell> cells_of(const Panel& panel, std::size_t shade) {
  std::vector<MapCell> some;
  std::copy_if(panel.cells.begin(), panel.cells.end(), std::back_inserter(some),
               [&](const auto& cell) { return cell.shade == shade; });
  return some;
}

/// The plot command of a panel; `block` counts the blocks of the data file.
void write_plot(std::string& out, const Figure& figure, const Panel& panel, const StyleNumbers& numbers, int& block) {
  const bool over_time = panel.x.scale == Scale::linear;
  std::vector<std::string> items;
  for (std::size_t s = 0; s < figure.shades.size(); ++s) {
    if (cells_of(panel, s).empty()) continue;
    items.push_back(fmt::format(
        "data index {} using 1:3:1:2:3:4 with boxxyerror fillstyle solid 1 noborder linecolor rgb '#{}' notitle",
        block++, figure.shades[s].colour));
  }
  for (const auto& curve : panel.curves) {
    const auto item = [&](Mark mark, const std::string& with) {
      if (!has(curve, mark)) return;
      items.push_back(fmt::format("data index {} using 1:(drawn('{}')) with {} notitle", block, name(mark), with));
    };
    const std::size_t number = curve.muted ? 9003 : numbers.of(curve.method, curve.variant);
    const bool line_alone = curve.muted && curve.points.size() > 1;
    item(Mark::value,
         fmt::format("{} linestyle {}{}", line_alone ? "lines" : "linespoints", number,
                     over_time ? std::string(" pointnumber 6")
                               : fmt::format(" pointinterval {}", style::points_to_a_mark(curve.points.size()))));
    const double size = style::mark_size(curve.method);
    item(Mark::zero, fmt::format("points linestyle {} pointtype 10 pointsize {:.2f} linewidth 1.5", number, size));
    item(Mark::edge, fmt::format("points linestyle {} pointtype 2 pointsize {:.2f} linewidth 2", number, size));
    ++block;
  }
  line(out, "  plot {}", fmt::join(items, ", \\\n       "));
}

void write_panel(std::string& out, const Figure& figure, const Panel& panel, const std::vector<MethodStyle>& styles,
                 const StyleNumbers& numbers, const Layout& layout, int& block) {
  line(out, "\n  # panel {},{}", panel.row + 1, panel.column + 1);
  line(out, "  unset logscale\n  unset nonlinear y");
  line(out, "  set lmargin at screen {:.5f}; set rmargin at screen {:.5f}", layout.left(panel), layout.right(panel));
  line(out, "  set bmargin at screen {:.5f}; set tmargin at screen {:.5f}", layout.bottom(panel), layout.top(panel));
  write_title(out, layout.title(panel));
  write_axis(out, 'x', panel.x, layout.x_labels_apart(panel));
  write_axis(out, 'y', panel.y);
  write_guides(out, panel);
  write_envelope(out, panel);
  write_names(out, panel, styles);
  write_plot(out, figure, panel, numbers, block);
}

/// The legend is a plot of its own with nothing but its key, so that it covers no data.
void write_legend(std::string& out, const Figure& figure, const StyleNumbers& numbers, const Layout& layout) {
  std::vector<std::string> entries;
  for (const auto m : figure.used_methods) {
    entries.push_back(
        fmt::format("keyentry with linespoints linestyle {} title {}", numbers.of(m, 0), gnuplot(figure.methods[m])));
  }
  for (std::size_t v = 0; v < figure.variants.size() && figure.variants.size() > 1; ++v) {
    entries.push_back(fmt::format("keyentry with lines linestyle {} title {}", 9010 + v, gnuplot(figure.variants[v])));
  }
  for (const auto& shade : figure.shades) {
    entries.push_back(fmt::format("keyentry with boxes fillcolor rgb '#{}' fillstyle solid 1 noborder title {}",
                                  shade.colour, gnuplot(shade.label)));
  }
  const auto entry = [&](const char* with, const std::string& title) {
    entries.push_back(fmt::format("keyentry with {} title {}", with, gnuplot(title)));
  };
  if (figure.has_envelope) entry("lines linestyle 9002", figure.legend.envelope);
  if (figure.has_muted) entry("lines linestyle 9003", figure.legend.muted);
  if (figure.has_zero_marks) entry("points pointtype 10 pointsize 1 linecolor rgb '#555555'", figure.legend.zero);
  if (figure.has_edge_marks)
    entry("points pointtype 2 pointsize 1 linewidth 2 linecolor rgb '#555555'", figure.legend.edge);
  line(out, "\n  # legend");
  line(out,
       "  unset logscale\n  unset nonlinear y\n  unset title\n  unset xlabel\n  unset ylabel\n  unset arrow\n  unset "
       "label");
  line(out, "  unset border\n  unset tics\n  unset grid");
  line(out, "  set lmargin at screen 0.01; set rmargin at screen 0.99");
  line(out, "  set bmargin at screen 0; set tmargin at screen {:.5f}", layout.legend_top());
  line(out, "  set xrange [0:1]; set yrange [0:1]");
  if (figure.look.title)
    line(out, "  set label {} at screen 0.5,{:.5f} center front noenhanced", gnuplot(figure.title),
         layout.title_line());
  line(out, "  set key at screen 0.5,{:.5f} center top horizontal Left reverse noenhanced maxcols {} samplen 2.5",
       layout.legend_top(), layout.legend_columns());
  line(out, "  plot NaN notitle, \\\n       {}", fmt::join(entries, ", \\\n       "));
}

}  // namespace

std::string gnuplot_style(const FigureSet& set) {
  std::string out;
  line(
      out,
      "# How the figures of this folder look; every NAME.gp loads this file. Change it and run gnuplot NAME.gp again.");
  line(out,
       "# A method has one colour, marker and dash in all studies; where there are variants of the formulation, they "
       "have "
       "the dashes.");
  const FigureLook look = set.figures.empty() ? FigureLook{} : set.figures.front().look;
  line(out, "font_face = '{}'", look.font);
  line(out, "font_size = {:.4g}  # pixels, 96 to the inch", look.font_size * 96 / 72);
  line(out, "small = sprintf('%s,%g', font_face, 0.85 * font_size)");
  line(out, "set encoding utf8\nset decimalsign '.'");
  line(out, "set border 31 linewidth 1 linecolor rgb '#333333'");
  line(out, "set grid xtics ytics linetype 1 linewidth 0.6 linecolor rgb '#e2e2e2'");
  line(out, "set tics nomirror scale 0.6");
  line(out, "set style textbox opaque noborder margins 0.4,0.1 fillcolor rgb 'white'");
  line(out, "set style line 9001 linewidth 1.2 dashtype (6,4) linecolor rgb '#888888'");
  line(out, "set style line 9002 linewidth 9 dashtype 1 linecolor rgb '#ffe08a'");
  line(out, "set style line 9003 linewidth 1 dashtype 1 pointtype 7 pointsize 0.3 linecolor rgb '#bdbdbd'");
  std::size_t variants = 1;
  for (const auto& figure : set.figures) variants = std::max(variants, figure.variants.size());
  for (std::size_t v = 0; v < variants; ++v) {
    line(out, "set style line {} linewidth 1.6 dashtype {} linecolor rgb '#555555'", 9010 + v,
         style::dashes[v % style::dashes.size()].gnuplot);
  }
  const auto first = first_styles(set);
  std::size_t written = 0;
  for (std::size_t f = 0; f < set.figures.size(); ++f) {
    if (first[f] < written) continue;
    const auto& methods = set.figures[f].methods;
    const auto styles = styles_of(methods);
    for (std::size_t m = 0; m < methods.size(); ++m, ++written) {
      line(out, "\n# {}", one_line(methods[m]));
      const auto write_style = [&](std::size_t number, std::size_t dash) {
        line(out, "set style line {} linecolor rgb '{}' linewidth {:.2f} dashtype {} pointtype {} pointsize {:.2f}",
             number, html_colour(styles[m]), style::line_width(m), style::dashes[dash].gnuplot,
             style::markers[styles[m].marker].gnuplot, style::point_size(m));
      };
      write_style(written + 1, styles[m].dash);
      for (std::size_t v = 0; v < variants && variants > 1; ++v) {
        write_style(1000 * (v + 1) + written + 1, v % style::dashes.size());
      }
    }
  }
  return out;
}

std::vector<std::size_t> first_styles(const FigureSet& set) {
  std::vector<std::size_t> first;
  std::size_t total = 0;
  for (std::size_t f = 0; f < set.figures.size(); ++f) {
    const auto& methods = set.figures[f].methods;
    const auto same = std::find_if(set.figures.begin(), set.figures.begin() + static_cast<std::ptrdiff_t>(f),
                                   [&](const Figure& earlier) { return earlier.methods == methods; });
    const auto at = static_cast<std::size_t>(same - set.figures.begin());
    first.push_back(at < f ? first[at] : total);
    if (at == f) total += methods.size();
  }
  return first;
}

std::string gnuplot_script(const Figure& given, std::size_t first_style) {
  const Figure figure = fitted(given);
  const Layout layout(figure);
  std::string out;
  line(out, "# {}: {}", figure.name, one_line(figure.title));
  line(out, "# {}", one_line(figure.caption));
  line(out, "# Run in this folder with gnuplot 5.4 or later: gnuplot {}.gp", figure.name);
  line(out, "data = '{}.dat'", figure.name);
  line(out, "drawn(mark) = strcol(4) eq mark ? column(3) : NaN\n");
  line(out, "do for [kind in 'svg pdf'] {{");
  line(out, "  load '{}'", style_file);
  line(out, "  if (kind eq 'svg') {{");
  line(out,
       "    set terminal svg size {:.0f},{:.0f} enhanced font sprintf('%s,%g', font_face, font_size) background rgb "
       "'white' "
       "name '{}'",
       layout.width(), layout.height(), figure.name);
  line(out, "  }} else {{");
  line(out,
       "    set terminal pdfcairo size {:.4f}in,{:.4f}in enhanced font sprintf('%s,%g', font_face, font_size) "
       "fontscale 0.5625 "
       "linewidth 1.3",
       layout.width() / 96, layout.height() / 96);
  line(out, "  }}");
  line(out, "  set output '{}.'.kind", figure.name);
  line(out, "  set multiplot");
  line(out, "  unset key");
  int block = 0;
  const auto styles = styles_of(figure.methods);
  const StyleNumbers numbers{first_style, figure.variants.size() > 1};
  for (const auto& panel : figure.panels) write_panel(out, figure, panel, styles, numbers, layout, block);
  write_legend(out, figure, numbers, layout);
  line(out, "\n  unset multiplot\n  unset output\n}}");
  return out;
}

std::string gnuplot_data(const Figure& figure) {
  std::string out;
  line(out, "# {}: {}", figure.name, one_line(figure.title));
  line(out,
       "# One block for each curve (gnuplot: index 0, 1, ...), two empty lines between. SI units, in the columns' "
       "names.");
  line(out,
       "# drawn_at: where the point stands on the figure's axis. mark: value; zero (exactly zero, drawn at the level "
       "0);");
  line(out, "# edge (diverged, failed or off the scale, drawn at the edge; '-' where nothing was measured).");
  bool first = true;
  const auto begin_block = [&] {
    if (!first) out += "\n\n";
    first = false;
  };
  for (const auto& panel : figure.panels) {
    const auto title = panel.title.empty() ? "" : fmt::format("{}: ", fmt::join(panel.title, ", "));
    for (std::size_t s = 0; s < figure.shades.size(); ++s) {
      const auto cells = cells_of(panel, s);
      if (cells.empty()) continue;
      begin_block();
      line(out, "# {}{}", one_line(title), one_line(figure.shades[s].label));
      line(out, "# from_{0} to_{0} from_{1} to_{1}", panel.x_column, panel.y_column);
      for (const auto& c : cells) line(out, "{} {} {} {}", c.x_low, c.x_high, c.y_low, c.y_high);
    }
    for (const auto& curve : panel.curves) {
      begin_block();
      line(out, "# {}{}", one_line(title), one_line(curve.label));
      line(out, "# {} {} drawn_at mark", panel.x_column, panel.y_column);
      for (const auto& point : curve.points) {
        line(out, "{} {} {} {}", point.x, std::isfinite(point.value) ? fmt::format("{}", point.value) : "-",
             point.drawn, name(point.mark));
      }
    }
  }
  return out;
}

}  // namespace polhode::study::plot
