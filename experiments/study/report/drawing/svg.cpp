// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/drawing/svg.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline drawing {

std::string coordinate(double x) {
  const double tenths = std::round(10 * x);
  std::string text = fmt::format("{:.1f}", tenths == 0 ? 0.0 : tenths / 10);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

std::string path_of(std::span<const PagePoint> points, bool closed) {
  std::string commands;
  for (const PagePoint& p : points)
    commands += fmt::format("{}{} {}", commands.empty() ? "M" : "L", coordinate(p.x()), coordinate(p.y()));
  return closed ? commands + "Z" : commands;
}

void Svg::path(std::string_view commands, std::string_view style) {
  text_ += fmt::format("<path {} d=\"{}\"/>\n", style, commands);
}

void Svg::line(const PagePoint& from, const PagePoint& to, std::string_view style) {
  const PagePoint both[] = {from, to};
  path(path_of(both, false), style);
}

void Svg::circle(const PagePoint& centre, double radius, std::string_view style) {
  text_ += fmt::format("<circle {} cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", style, coordinate(centre.x()),
                       coordinate(centre.y()), coordinate(radius));
}

void Svg::text(const PagePoint& middle, std::string_view words, std::string_view style) {
  text_ += fmt::format("<text {} x=\"{}\" y=\"{}\" dy=\".35em\" text-anchor=\"middle\">{}</text>\n", style,
                       coordinate(middle.x()), coordinate(middle.y()), html(words));
}

}  // namespace polhode::study::report::drawing
