// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/plain_panel.hpp"

#include <algorithm>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"

namespace polhode::study::inline plot {

Panel plain_panel(std::string title, const PlainAxis& x, const PlainAxis& y, const std::vector<PlainCurve>& curves) {
  Panel panel{.title = {std::move(title)}, .x_column = x.column, .y_column = y.column};
  std::vector<double> xs, positive;
  Needs needs;
  double highest = 0;
  for (const PlainCurve& curve : curves) {
    PlottedCurve plotted{.label = curve.label, .method = curve.method, .variant = curve.variant};
    for (const auto& [at, value] : curve.points) {
      plotted.points.push_back({at, value, 0, value == 0 && y.scale == Scale::logarithmic ? Mark::zero : Mark::value});
      xs.push_back(at);
      highest = std::max(highest, value);
      needs.floor = needs.floor || value == 0;
      if (value > 0) positive.push_back(value);
    }
    if (!plotted.points.empty()) panel.curves.push_back(std::move(plotted));
  }
  if (xs.empty()) return panel;
  const auto [least, largest] = std::minmax_element(xs.begin(), xs.end());
  panel.x = x.scale == Scale::logarithmic ? step_axis(x.label, xs) : linear_axis(x.label, *least, *largest);
  std::vector<Panel> alone = {std::move(panel)};
  share_y_axis(alone, y.scale == Scale::logarithmic ? log_axis(y.label, positive, needs)
                                                    : linear_axis(y.label, 0, highest > 0 ? 1.05 * highest : 1));
  return std::move(alone.front());
}

Figure plain_figure(std::string name, std::string title, std::string caption, std::vector<std::string> methods,
                    std::vector<std::string> variants, std::vector<Panel> panels) {
  Figure figure{.name = std::move(name),
                .title = std::move(title),
                .caption = std::move(caption),
                .methods = std::move(methods),
                .variants = std::move(variants)};
  std::erase_if(panels, [](const Panel& panel) { return panel.curves.empty(); });
  add_rows(figure, std::move(panels), 1);
  note_marks(figure);
  if (figure.has_zero_marks) figure.caption += " An open triangle at the level 0 is a value of exactly zero.";
  return figure;
}

}  // namespace polhode::study::plot
