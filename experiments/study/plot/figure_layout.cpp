// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/figure_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {

void add_rows(Figure& figure, std::vector<Panel> panels, std::size_t columns) {
  const std::size_t first_row = figure.panels.empty() ? 0 : figure.rows;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    panels[i].row = first_row + i / columns;
    panels[i].column = i % columns;
    panels[i].y.labelled = panels[i].column == 0;
    figure.rows = panels[i].row + 1;
    figure.columns = std::max(figure.columns, panels[i].column + 1);
    figure.panels.push_back(std::move(panels[i]));
  }
}

namespace {

/// Letters that this part of the width of a panel has room for, beside a cross.
std::size_t letters_in(double share, const Figure& figure) {
  constexpr double letter = 6.4, sides = 120;  // pixels, of small letters and of both margins
  const double panel = (FigureLook{}.width() - sides) / static_cast<double>(figure.columns);
  return static_cast<std::size_t>(std::max(0.0, share * panel / letter - 2));
}

/// Writes names beside crosses: left of the first one of a method or right of the last one, shortened where there is
/// little room; where there is none, over the last ones.
void name_crosses(Panel& panel, const Figure& figure) {
  constexpr std::size_t shortest = 8;
  const double left = panel.x.place(panel.x.low), right = panel.x.place(panel.x.high);
  std::set<double> named;  // lanes
  for (const auto& curve : panel.curves) {
    const Point *first = nullptr, *last = nullptr;
    for (const auto& point : curve.points) {
      if (point.mark != Mark::edge) continue;
      if (first == nullptr || point.x < first->x) first = &point;
      if (last == nullptr || point.x > last->x) last = &point;
    }
    if (first == nullptr || curve.method >= figure.methods.size() || !named.insert(first->drawn).second) continue;
    const std::string& name = figure.methods[curve.method];
    const std::size_t on_left = letters_in((panel.x.place(first->x) - left) / (right - left), figure);
    const std::size_t on_right = letters_in((right - panel.x.place(last->x)) / (right - left), figure);
    const bool over = std::max(on_left, on_right) < std::min(shortest, length(name));
    const bool is_left = over || length(name) <= on_left || (length(name) > on_right && on_left >= on_right);
    panel.names.push_back({.x = over      ? panel.x.high
                                : is_left ? first->x
                                          : last->x,
                           .y = first->drawn,
                           .name = over ? name : shortened(name, is_left ? on_left : on_right),
                           .method = curve.method,
                           .left = is_left,
                           .opaque = over});
  }
}

/// Names of the methods that have crosses.
std::vector<std::string> crossed_methods(const Figure& figure) {
  std::set<std::size_t> crossed;
  for (const auto& panel : figure.panels) {
    for (const auto& curve : panel.curves) {
      const auto is_cross = [](const Point& point) { return point.mark == Mark::edge; };
      if (std::any_of(curve.points.begin(), curve.points.end(), is_cross)) crossed.insert(curve.method);
    }
  }
  std::vector<std::string> names;
  for (const auto m : crossed) {
    if (m < figure.methods.size()) names.push_back(figure.methods[m]);
  }
  return names;
}

}  // namespace

void note_marks(Figure& figure) {
  std::set<std::size_t> used;
  for (auto& panel : figure.panels) {
    name_crosses(panel, figure);
    figure.has_envelope = figure.has_envelope || !panel.envelope.empty();
    for (const auto& curve : panel.curves) {
      if (curve.muted) figure.has_muted = true;
      else used.insert(curve.method);
      for (const auto& point : curve.points) {
        figure.has_zero_marks = figure.has_zero_marks || point.mark == Mark::zero;
        figure.has_edge_marks = figure.has_edge_marks || point.mark == Mark::edge;
      }
    }
  }
  figure.used_methods = {used.begin(), used.end()};
}

std::string marks_caption(const Figure& figure) {
  std::string text;
  if (figure.variants.size() > 1) text += " Dashes tell the variants of the formulation apart.";
  if (figure.has_zero_marks) text += " An open triangle at the level 0 is a value of exactly zero.";
  if (figure.has_edge_marks) {
    text += fmt::format(" A cross at the edge is a run that diverged or failed, or a value above {}: {}.",
                        off_scale_above, words(first_items(crossed_methods(figure), 12)));
  }
  return text;
}

}  // namespace polhode::study::plot
