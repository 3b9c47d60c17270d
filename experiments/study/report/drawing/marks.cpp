// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/drawing/marks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline drawing {
namespace {

constexpr double head_length = 10, head_width = 3.6;
constexpr double shortest = 9;  // shortest length of an arrow that is not drawn as a circle
constexpr double letter = 8.2, line_height = 17;

std::string of_class(std::string_view name) { return fmt::format("class=\"{}\"", name); }

PagePoint across(const PagePoint& direction) { return {-direction.y(), direction.x()}; }

PagePoint unit(const PagePoint& direction) {
  const double length = direction.norm();
  return length > 0 ? PagePoint(direction / length) : PagePoint(0, -1);
}

}  // namespace

void Marks::head(const PagePoint& tip, const PagePoint& along, std::string_view style) {
  const PagePoint back = tip - head_length * along, side = head_width * across(along);
  const PagePoint corners[] = {tip, back + side, back - side};
  svg_.path(path_of(corners, true), of_class(fmt::format("{} head", style)));
}

void Marks::arrow(const PagePoint& from, const PagePoint& by, bool toward, std::string_view style,
                  std::string_view text, int heads) {
  if (by.norm() < shortest) {
    svg_.circle(from, 6, fmt::format("class=\"{} round\"", style));
    if (toward) svg_.circle(from, 1.6, fmt::format("class=\"{} head\"", style));
    for (const double s : {-1.0, 1.0}) {
      if (!toward) svg_.line(from + PagePoint(-4, -4 * s), from + PagePoint(4, 4 * s), of_class(style));
    }
    return label(from, {1, -1}, text, style);
  }
  const PagePoint along = unit(by), tip = from + by;
  svg_.line(from, tip - 0.6 * head_length * along, of_class(style));
  keep_free(from, tip);
  for (int k = 0; k < heads; ++k) head(tip - 0.75 * head_length * k * along, along, style);
  label(tip, along, text, style);
}

void Marks::axis(const PagePoint& from, const PagePoint& by, double inside, std::string_view text) {
  const PagePoint along = unit(by), tip = from + by;
  keep_free(from + inside * by, tip);
  svg_.line(from, from + inside * by, "class=\"axis hidden\"");
  svg_.line(from + inside * by, tip, "class=\"axis\"");
  if (by.norm() > shortest) {
    const PagePoint back = tip - 6 * along, side = 2.6 * across(along);
    const PagePoint open[] = {back + side, tip, back - side};
    svg_.path(path_of(open, false), "class=\"axis\"");
  }
  label(tip, along, text, "axis");
}

void Marks::spring(const PagePoint& from, const PagePoint& to) {
  constexpr int teeth = 9;
  constexpr double amplitude = 5;
  const PagePoint along = to - from, side = amplitude * across(unit(along));
  std::vector<PagePoint> points = {from, from + 0.12 * along};
  for (int k = 0; k < teeth; ++k)
    points.push_back(from + (0.12 + 0.76 * (k + 0.5) / teeth) * along + (k % 2 == 0 ? side : PagePoint(-side)));
  points.push_back(from + 0.88 * along);
  points.push_back(to);
  svg_.path(path_of(points, false), "class=\"spring\"");
}

void Marks::damper(const PagePoint& from, const PagePoint& to) {
  const PagePoint along = to - from, side = 5 * across(unit(along));
  svg_.line(from, from + 0.5 * along, "class=\"spring\"");
  svg_.line(from + 0.5 * along + side, from + 0.5 * along - side, "class=\"spring\"");
  const PagePoint cup[] = {from + 0.4 * along + 1.5 * side, from + 0.6 * along + 1.5 * side,
                           from + 0.6 * along - 1.5 * side, from + 0.4 * along - 1.5 * side};
  svg_.path(path_of(cup, false), "class=\"spring\"");
  svg_.line(from + 0.6 * along, to, "class=\"spring\"");
}

void Marks::anchor(const PagePoint& at, bool in_the_world) {
  if (!in_the_world) return svg_.circle(at, 2.8, "class=\"anchor\"");
  const PagePoint corners[] = {at + PagePoint(-4, -4), at + PagePoint(4, -4), at + PagePoint(4, 4),
                               at + PagePoint(-4, 4)};
  svg_.path(path_of(corners, true), "class=\"anchor\"");
}

void Marks::pivot(const PagePoint& at) {
  const PagePoint corners[] = {at, at + PagePoint(-7, 11), at + PagePoint(7, 11)};
  svg_.path(path_of(corners, true), "class=\"pivot\"");
  svg_.circle(at, 2.4, "class=\"anchor\"");
}

void Marks::joint(const PagePoint& at) { svg_.circle(at, 4, "class=\"joint\""); }

void Marks::keep_free(const PagePoint& from, const PagePoint& to) {
  constexpr double apart = 6, half = 3;
  const int n = int((to - from).norm() / apart) + 1;
  for (int k = 0; k <= n; ++k) {
    const PagePoint at = from + (double(k) / n) * (to - from);
    taken_.emplace_back(at - PagePoint(half, half), at + PagePoint(half, half));
  }
}

void Marks::label(const PagePoint& at, const PagePoint& away, std::string_view text, std::string_view style) {
  if (!text.empty()) labels_.push_back({at, unit(away), std::string(text), std::string(style)});
}

void Marks::finish() {
  for (const Label& label : labels_) place(label);
  labels_.clear();
}

void Marks::place(const Label& label) {
  const PagePoint half(0.5 * letter * double(length(label.text)) + 1, 0.5 * line_height), &along = label.away;
  const PagePoint side = across(along);
  // The distance at which the box of the text just stands beside the point.
  const auto beside = [&](const PagePoint& d) {
    return PagePoint(d * (4 + std::abs(d.x()) * half.x() + std::abs(d.y()) * half.y()));
  };
  std::vector<PagePoint> places;
  for (const double further : {0.0, 12.0, 26.0}) {
    for (const PagePoint& d :
         {along, unit(along + side), unit(along - side), side, PagePoint(-side), PagePoint(-along)})
      places.push_back(label.at + beside(d) + further * d);
  }
  const auto box = [&](const PagePoint& middle) { return Eigen::AlignedBox2d(middle - half, middle + half); };
  const auto fits = [&](const PagePoint& middle) {
    return around_.contains(box(middle)) &&
           std::none_of(taken_.begin(), taken_.end(), [&](const auto& other) { return other.intersects(box(middle)); });
  };
  auto place = std::find_if(places.begin(), places.end(), fits);
  if (place == places.end()) place = places.begin();
  taken_.push_back(box(*place));
  svg_.text(*place, label.text, of_class(fmt::format("{} label", label.style)));
}

void Marks::length_bar(const PagePoint& left, double units, std::string_view text) {
  const PagePoint right = left + PagePoint(units, 0);
  svg_.line(left, right, "class=\"bar\"");
  for (const PagePoint& end : {left, right}) svg_.line(end - PagePoint(0, 4), end + PagePoint(0, 4), "class=\"bar\"");
  label(right, {1, 0}, text, "bar");
}

}  // namespace polhode::study::report::drawing
