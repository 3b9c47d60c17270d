// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/figure_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

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

void note_marks(Figure& figure) {
  std::set<std::size_t> used;
  for (const auto& panel : figure.panels) {
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
    text += fmt::format(" A cross at the edge is a run that diverged or failed, or a value above {}.", off_scale_above);
  }
  return text;
}

}  // namespace polhode::study::plot
