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

/// Part of the width of a panel that a name takes, beside its cross.
double share_of(const std::string& name, const Figure& figure) {
  constexpr double letter = 6.4, sides = 120;  // pixels, of small letters and of both margins
  const double panel = (Look{}.width() - sides) / static_cast<double>(figure.columns);
  return (static_cast<double>(length(name)) + 2) * letter / panel;
}

/// Writes names beside crosses: left of the first one of a method, right of the last one, where there is room, or over
/// the last ones.
void name_crosses(Panel& panel, const Figure& figure) {
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
    const double room = share_of(name, figure) * (right - left);
    const bool fits_left = panel.x.place(first->x) - left > room, fits_right = right - panel.x.place(last->x) > room;
    const bool over = !fits_left && !fits_right;
    const Point& at = fits_left ? *first : *last;
    panel.names.push_back({.x = over ? panel.x.high : at.x,
                           .y = at.drawn,
                           .name = name,
                           .method = curve.method,
                           .left = fits_left || over,
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
