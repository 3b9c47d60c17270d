// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/space_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/plot/method_style.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {
namespace {

constexpr double turn_x = 62, turn_z = 124;  // angles of gnuplot's view, degrees

/// Unit vector to the viewer, in the coordinates of the data.
Place to_viewer() {
  constexpr double radian = std::numbers::pi / 180;
  const double x = turn_x * radian, z = turn_z * radian;
  return {std::sin(x) * std::sin(z), -std::sin(x) * std::cos(z), std::cos(x)};
}

template <class... T>
void put(std::string& out, fmt::format_string<T...> format, T&&... values) {
  fmt::format_to(std::back_inserter(out), format, std::forward<T>(values)...);
  out += '\n';
}

/// Writes the parts of a line for which `drawn` holds, each followed by an empty line. Returns whether there are any.
bool write_parts(std::string& out, const std::vector<Place>& points, const std::function<bool(const Place&)>& drawn) {
  bool any = false, open = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool here = drawn(points[i]);
    // The first point of the other part belongs to both, so that there is no gap.
    if (here || open) put(out, "{:.6g} {:.6g} {:.6g}", points[i][0], points[i][1], points[i][2]), any = true;
    if (open && !here) out += '\n';
    open = here;
  }
  if (open) out += '\n';
  return any;
}

/// Meridians and parallels of the ellipsoid about its third axis.
std::vector<std::vector<Place>> grid_of(const Place& a) {
  constexpr int points = 72, meridians = 12, parallels = 7;
  std::vector<std::vector<Place>> lines;
  const auto at = [&](double polar, double turn) {
    return Place{a[0] * std::sin(polar) * std::cos(turn), a[1] * std::sin(polar) * std::sin(turn),
                 a[2] * std::cos(polar)};
  };
  for (int m = 0; m < meridians; ++m) {
    auto& one = lines.emplace_back();
    for (int k = 0; k <= points / 2; ++k)
      one.push_back(at(std::numbers::pi * 2 * k / points, std::numbers::pi * 2 * m / meridians));
  }
  for (int p = 1; p <= parallels; ++p) {
    auto& one = lines.emplace_back();
    for (int k = 0; k <= points; ++k)
      one.push_back(at(std::numbers::pi * p / (parallels + 1), std::numbers::pi * 2 * k / points));
  }
  return lines;
}

/// The outline of the ellipsoid: its points whose normal is across the line of sight.
std::vector<Place> outline_of(const Place& a) {
  const Place viewer = to_viewer();
  const Place w = {viewer[0] / a[0], viewer[1] / a[1], viewer[2] / a[2]};
  const auto unit = [](Place v) {
    const double size = std::hypot(v[0], v[1], v[2]);
    return Place{v[0] / size, v[1] / size, v[2] / size};
  };
  const Place first = unit({-w[1], w[0], 0});
  const Place second =
      unit({w[1] * first[2] - w[2] * first[1], w[2] * first[0] - w[0] * first[2], w[0] * first[1] - w[1] * first[0]});
  std::vector<Place> points;
  for (int k = 0; k <= 96; ++k) {
    const double turn = std::numbers::pi * 2 * k / 96, c = std::cos(turn), s = std::sin(turn);
    Place p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = a[i] * (c * first[i] + s * second[i]);
    points.push_back(p);
  }
  return points;
}

std::vector<std::vector<Place>> plane_of(const SpaceFigure& figure) {
  double reach = 0;
  for (const auto& curve : figure.curves) {
    for (const Place& p : curve.points) reach = std::max({reach, std::abs(p[0]), std::abs(p[1])});
  }
  const double h = *figure.plane, r = 1.15 * reach;
  return {{{-r, -r, h}, {r, -r, h}, {r, r, h}, {-r, r, h}, {-r, -r, h}}, {{0, 0, 0}, {0, 0, h}}};
}

/// Ranges of the axes, with a margin.
std::array<std::pair<double, double>, 3> ranges_of(const SpaceFigure& figure) {
  Place reach{};
  if (figure.semi_axes) reach = *figure.semi_axes;
  for (const auto& curve : figure.curves) {
    for (const Place& p : curve.points) {
      for (std::size_t i = 0; i < 3; ++i) reach[i] = std::max(reach[i], std::abs(p[i]));
    }
  }
  std::array<std::pair<double, double>, 3> ranges;
  for (std::size_t i = 0; i < 3; ++i) ranges[i] = {-1.05 * reach[i], 1.05 * reach[i]};
  if (figure.plane) {
    const double across = 1.15 * std::max(reach[0], reach[1]);
    ranges[0] = ranges[1] = {-across, across};
    ranges[2].first = 0;
  }
  return ranges;
}

/// Side in pixels of the square within gnuplot's margins with which the box of the axes fills the width and the height:
/// gnuplot draws the longer side of the ground as long as that, before it turns the box.
double square_of(const std::array<std::pair<double, double>, 3>& ranges, double width, double height) {
  constexpr double radian = std::numbers::pi / 180;
  Place side{};
  for (std::size_t i = 0; i < 3; ++i) side[i] = ranges[i].second - ranges[i].first;
  const double c = std::abs(std::cos(turn_z * radian)), s = std::abs(std::sin(turn_z * radian));
  const double across = side[0] * c + side[1] * s;
  const double up = side[2] * std::sin(turn_x * radian) + (side[0] * s + side[1] * c) * std::cos(turn_x * radian);
  return std::max(side[0], side[1]) * std::min(width / across, height / up);
}

struct Blocks {
  std::string text;
  bool grid = false;
  std::vector<std::pair<bool, bool>> curves;  ///< each curve: true for a part in front, for a part behind
};

Blocks blocks_of(const SpaceFigure& figure) {
  Blocks blocks;
  const auto in_front = [&](const Place& p) { return !figure.semi_axes || is_in_front(p, *figure.semi_axes); };
  const auto begin = [&](const std::string& what) {
    put(blocks.text, "{}# {}", blocks.text.empty() ? "" : "\n", what);
  };
  if (figure.semi_axes || figure.plane) {
    blocks.grid = true;
    begin(figure.semi_axes ? "ellipsoid" : "plane and its normal through the origin");
    for (const auto& one : figure.semi_axes ? grid_of(*figure.semi_axes) : plane_of(figure))
      write_parts(blocks.text, one, in_front);
    if (figure.semi_axes) write_parts(blocks.text, outline_of(*figure.semi_axes), [](const Place&) { return true; });
  }
  for (const auto& curve : figure.curves) {
    std::string front, behind;
    const bool has_front = write_parts(front, curve.points, in_front);
    const bool has_behind = write_parts(behind, curve.points, [&](const Place& p) { return !in_front(p); });
    blocks.curves.emplace_back(has_front, has_behind);
    if (has_front) begin(one_line(curve.label) + (has_behind ? ", in front" : "")), blocks.text += front;
    if (has_behind) begin(one_line(curve.label) + ", behind"), blocks.text += behind;
  }
  return blocks;
}

}  // namespace

bool is_in_front(const Place& point, const Place& semi_axes) {
  const Place viewer = to_viewer();
  double side = 0;
  for (std::size_t i = 0; i < 3; ++i) side += point[i] / (semi_axes[i] * semi_axes[i]) * viewer[i];
  return side >= 0;
}

std::string space_data(const SpaceFigure& figure) {
  std::string out;
  put(out, "# {}: {}", figure.name, one_line(figure.title));
  put(out, "# {}", fmt::join(figure.columns, " "));
  return out + blocks_of(figure).text;
}

std::string space_script(const SpaceFigure& figure) {
  const Blocks blocks = blocks_of(figure);
  const double size = figure.look.width(), height = 0.86 * size;
  const auto styles = styles_of(figure.methods);
  std::string out;
  put(out, "# {}: {}", figure.name, one_line(figure.title));
  put(out, "# {}", one_line(figure.caption));
  put(out, "# Run in this folder with gnuplot 5.4 or later: gnuplot {}.gp", figure.name);
  put(out, "data = '{}.dat'", figure.name);
  put(out, "do for [kind in 'svg pdf'] {{");
  put(out, "  font = '{},{:.4g}'", figure.look.font, figure.look.font_size * 96 / 72);
  put(out, "  if (kind eq 'svg') {{");
  put(out, "    set terminal svg size {:.0f},{:.0f} enhanced font font background rgb 'white' name '{}'", size, height,
      figure.name);
  put(out, "  }} else {{");
  put(out, "    set terminal pdfcairo size {:.4f}in,{:.4f}in enhanced font font fontscale 0.5625 linewidth 1.3",
      size / 96, height / 96);
  put(out, "  }}");
  put(out, "  set output '{}.'.kind", figure.name);
  put(out, "  set encoding utf8\n  set decimalsign '.'\n  set multiplot\n  unset key");
  std::size_t longest = 1;
  for (const auto& curve : figure.curves) longest = std::max(longest, length(curve.label));
  const double letters = figure.look.font_size / style::font_size;
  const auto in_a_row = static_cast<std::size_t>(
      std::max(1.0, 0.95 * size / ((static_cast<double>(longest) * style::character_width + 60) * letters)));
  const auto rows = static_cast<double>((figure.curves.size() + in_a_row - 1) / in_a_row);
  const double key_height = (rows * style::legend_line + 2 * style::legend_gap) * letters;
  // Room for the numbers and labels of the axes, pixels: the third axis stands at the left.
  const double left = 85 * letters, right = size - 40 * letters, bottom = height - key_height - 55 * letters,
               top = (figure.look.title ? style::title_line + 2 * style::legend_gap : style::legend_gap) * letters;
  const auto ranges = ranges_of(figure);
  const double half = square_of(ranges, right - left, bottom - top) / 2;
  const double across = (left + right) / 2, down = (top + bottom) / 2;
  put(out, "  set view {},{}\n  set view equal xyz\n  set surface explicit\n  set xyplane 0", turn_x, turn_z);
  put(out, "  set border 31 linewidth 1 linecolor rgb '#999999'");
  put(out, "  set lmargin at screen {:.5f}; set rmargin at screen {:.5f}", (across - half) / size,
      (across + half) / size);
  put(out, "  set bmargin at screen {:.5f}; set tmargin at screen {:.5f}", 1 - (down + half) / height,
      1 - (down - half) / height);
  for (std::size_t i = 0; i < 3; ++i) {
    const char axis = "xyz"[i];
    const Axis ticks = linear_axis("", ranges[i].first, ranges[i].second);
    std::vector<std::string> marks;
    const std::size_t stride = ticks.ticks.size() > 5 ? 2 : 1;
    const auto zero = std::find_if(ticks.ticks.begin(), ticks.ticks.end(), [](const Tick& t) { return t.at == 0; });
    for (std::size_t k = static_cast<std::size_t>(zero - ticks.ticks.begin()) % stride; k < ticks.ticks.size();
         k += stride)
      marks.push_back(fmt::format("'{}' {}", ticks.ticks[k].label, ticks.ticks[k].at));
    put(out, "  set {}range [{:.6g}:{:.6g}]\n  set {}tics ({}) offset {}", axis, ranges[i].first, ranges[i].second,
        axis, fmt::join(marks, ", "), i == 2 ? "0,0" : "0,-0.4");
    put(out, "  set {}label {} noenhanced {}", axis, gnuplot(figure.axes[i]),
        i == 2 ? "rotate parallel" : "offset 0,-0.8");
  }
  std::vector<std::string> items, entries;
  int block = 0;
  if (blocks.grid)
    items.push_back(fmt::format("data index {} with lines linewidth 0.7 linecolor rgb '#bbbbbb' notitle", block++));
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const auto& curve = figure.curves[i];
    const auto& style = styles.at(curve.method);
    const auto colour = html_colour(style);
    const auto dash =
        style::dashes[figure.variants.size() > 1 ? curve.variant % style::dashes.size() : style.dash].gnuplot;
    if (blocks.curves[i].second)
      items.push_back(fmt::format("data index {} with lines linewidth 0.9 dashtype (2,4) linecolor rgb '{}' notitle",
                                  block + (blocks.curves[i].first ? 1 : 0), colour));
    const auto drawn = fmt::format("with lines linewidth 2 dashtype {} linecolor rgb '{}'", dash, colour);
    if (blocks.curves[i].first) items.push_back(fmt::format("data index {} {} notitle", block, drawn));
    entries.push_back(fmt::format("keyentry {} title {}", drawn, gnuplot(curve.label)));
    block += blocks.curves[i].first + blocks.curves[i].second;
  }
  put(out, "  splot {}", fmt::join(items, ", \\\n        "));
  put(out, "  reset\n  unset border\n  unset tics\n  set xrange [0:1]\n  set yrange [0:1]");
  put(out, "  set lmargin at screen 0; set rmargin at screen 1; set bmargin at screen 0; set tmargin at screen 1");
  if (figure.look.title)
    put(out, "  set label {} at screen 0.5,{:.5f} center noenhanced", gnuplot(figure.title),
        1 - (style::legend_gap + style::title_line / 2) * letters / height);
  put(out, "  set key at screen 0.5,{:.5f} center top horizontal Left reverse noenhanced samplen 2.5 maxcols {}",
      (key_height - style::legend_gap * letters) / height, in_a_row);
  put(out, "  plot NaN notitle, {}", fmt::join(entries, ", \\\n       "));
  put(out, "  unset multiplot\n  unset output\n}}");
  return out;
}

}  // namespace polhode::study::plot
