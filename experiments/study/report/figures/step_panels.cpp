// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/figures/step_panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "experiments/study/plot/axis.hpp"

namespace polhode::study::inline report::inline figures {

namespace {

Point point_of(const RunRecord& run, double step, const Quantity& quantity) {
  const double measured = quantity.of(run.result).value_or(std::numeric_limits<double>::quiet_NaN());
  const bool off_scale =
      ended_early(run) || !std::isfinite(measured) || (quantity.bounded && measured > off_scale_above);
  return {step, measured, 0, off_scale ? Mark::edge : measured == 0 ? Mark::zero : Mark::value};
}

PlottedCurve curve_against_step(const Curve& curve, const Quantity& quantity, const Selection& selection) {
  PlottedCurve plotted{
      .label = selection.label(curve), .method = curve.method_index, .variant = selection.dash_of(curve)};
  for (const auto* run : curve.runs) {
    const double step = abscissa(*run).value_or(0);
    if (!(step > 0)) continue;
    // A run that ended early is marked by a cross even if the quantity was never measured.
    if (ended_early(*run) || (completed(*run) && quantity.of(run->result))) {
      plotted.points.push_back(point_of(*run, step, quantity));
    }
  }
  return plotted;
}

Panel panel_of(const Block& block, bool adaptive, const Quantity& quantity, const Selection& selection) {
  Panel panel{.title = block.title, .x_column = adaptive ? "tolerance" : "dt_s", .y_column = quantity.column};
  const auto defined = [&](const Curve* curve) { return has_value(*curve, quantity); };
  if (std::none_of(block.curves.begin(), block.curves.end(), defined)) return panel;
  std::vector<double> steps;
  for (const auto* curve : block.curves) {
    auto plotted = curve_against_step(*curve, quantity, selection);
    for (const auto& point : plotted.points) steps.push_back(point.x);
    if (!plotted.points.empty()) panel.curves.push_back(std::move(plotted));
  }
  if (!steps.empty()) panel.x = step_axis(adaptive ? "tolerance (relative and absolute)" : "step h = dt (s)", steps);
  return panel;
}

/// All panels. If every case has both fixed steps and tolerances, the two panels of a case are side by side.
std::vector<Panel> all_panels(const Selection& selection, const Quantity& quantity) {
  std::vector<Panel> fixed, adaptive, panels;
  for (const auto& block : selection.blocks([](const Curve& c) { return !c.adaptive; })) {
    fixed.push_back(panel_of(block, false, quantity, selection));
  }
  for (const auto& block : selection.blocks([](const Curve& c) { return c.adaptive; })) {
    adaptive.push_back(panel_of(block, true, quantity, selection));
  }
  const auto add = [&](Panel& panel) {
    if (!panel.curves.empty()) panels.push_back(std::move(panel));
  };
  const bool side_by_side = fixed.size() == adaptive.size();
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    add(fixed[i]);
    if (side_by_side) add(adaptive[i]);
  }
  for (std::size_t i = 0; i < adaptive.size() && !side_by_side; ++i) add(adaptive[i]);
  return panels;
}

/// Removes panels in which all values are exactly zero, unless that is true of all panels.
void drop_all_zero(std::vector<Panel>& panels) {
  const auto all_zero = [](const Panel& panel) {
    return std::all_of(panel.curves.begin(), panel.curves.end(), [](const auto& curve) {
      return std::all_of(curve.points.begin(), curve.points.end(), [](const auto& p) { return p.mark == Mark::zero; });
    });
  };
  if (!std::all_of(panels.begin(), panels.end(), all_zero)) std::erase_if(panels, all_zero);
}

Axis y_axis(const std::vector<Panel>& panels, const Quantity& quantity) {
  std::vector<double> values;
  for (const auto& panel : panels) {
    for (const auto& curve : panel.curves) {
      for (const auto& point : curve.points) {
        if (point.mark == Mark::value) values.push_back(point.value);
      }
    }
  }
  return log_axis(quantity.axis, values, needs_of(panels));
}

/// Position of the lowest decade on the axis. If the axis has a place for zeros, it lies above that place.
double lowest_decade(const Axis& axis) {
  const auto tick = std::find_if(axis.ticks.begin(), axis.ticks.end(), [](const auto& t) { return t.label != "0"; });
  return tick == axis.ticks.begin() || tick == axis.ticks.end() ? axis.low : tick->at;
}

/// A rectangle of a panel, in coordinates of its axes.
struct Area {
  double x0, y0, width, height;
};
/// The area without the level of zeros at the bottom and the crosses, with their names, at the top.
Area drawing_area(const Panel& panel) {
  const double x = panel.x.place(panel.x.low), y = panel.y.place(lowest_decade(panel.y));
  double top = panel.y.place(panel.y.high);
  const double high = top;
  for (const auto& curve : panel.curves) {
    for (const auto& point : curve.points) {
      if (point.mark == Mark::edge) top = std::min(top, panel.y.place(point.drawn) - 0.03 * (high - y));
    }
  }
  return {x, y, panel.x.place(panel.x.high) - x, top - y};
}

/// Points along the curves, close enough together to find every crossing of a curve with a rectangle.
std::vector<std::pair<double, double>> places_along(const Panel& panel) {
  constexpr int between = 12;
  std::vector<std::pair<double, double>> places;
  for (const auto& curve : panel.curves) {
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const auto& a = curve.points[i];
      const auto& b = curve.points[std::min(i + 1, curve.points.size() - 1)];
      const double ax = panel.x.place(a.x), ay = panel.y.place(a.drawn);
      const double bx = panel.x.place(b.x), by = panel.y.place(b.drawn);
      for (int k = 0; k < between; ++k) {
        const double s = k / static_cast<double>(between);
        places.emplace_back(ax * (1 - s) + bx * s, ay * (1 - s) + by * s);
      }
    }
  }
  return places;
}

/// Lower left corner of the rectangle of this size that contains the fewest points of curves. Among equals, the one
/// nearest to the lower right corner of the panel, where most methods have no curves.
std::pair<double, double> emptiest_corner(const Panel& panel, double width, double height) {
  constexpr int trials = 10;
  const auto area = drawing_area(panel);
  const auto places = places_along(panel);
  std::pair<double, double> best{};
  auto least = std::numeric_limits<std::size_t>::max();
  for (int i = trials; i >= 0; --i) {
    for (int j = 0; j <= trials; ++j) {
      const double x = area.x0 + area.width * 0.03 + i * (0.94 * area.width - width) / trials;
      const double y = area.y0 + area.height * 0.03 + j * (0.94 * area.height - height) / trials;
      const auto is_inside = [&](const auto& p) {
        return p.first > x - 0.02 * area.width && p.first < x + width && p.second > y - 0.02 * area.height &&
               p.second < y + height + 0.02 * area.height;
      };
      std::size_t inside = 0;
      for (auto p = places.begin(); p != places.end() && inside < least; ++p) inside += is_inside(*p);
      if (inside < least) least = inside, best = {x, y};
    }
  }
  return best;
}

/// Lines of given slopes, in ascending order, from a common point, with space for their labels on the right.
std::vector<Guide> slope_guides(const Panel& panel, const std::vector<std::pair<double, std::string>>& slopes) {
  const auto area = drawing_area(panel);
  const auto run = [&](double slope) { return std::min(0.3 * area.width, 0.36 * area.height / slope); };
  constexpr double label_line = 0.06;
  double height = label_line * area.height * static_cast<double>(slopes.size());
  for (const auto& [slope, label] : slopes) height = std::max(height, slope * run(slope));
  const auto [x, y] = emptiest_corner(panel, 0.38 * area.width, height);
  std::vector<Guide> guides;
  double label_y = y - area.height;
  for (const auto& [slope, label] : slopes) {
    const double end = y + slope * run(slope);
    label_y = std::max(end, label_y + label_line * area.height);
    guides.push_back({panel.x.value_at(x), panel.y.value_at(y), panel.x.value_at(x + run(slope)), panel.y.value_at(end),
                      label, panel.y.value_at(label_y)});
  }
  return guides;
}

}  // namespace

bool has_several_steps(const Curve& curve) {
  std::set<double> steps;
  for (const auto* run : curve.runs) {
    if (abscissa(*run).value_or(0) > 0) steps.insert(*abscissa(*run));
  }
  return steps.size() > 1;
}

bool has_value(const Curve& curve, const Quantity& quantity) {
  return std::any_of(curve.runs.begin(), curve.runs.end(),
                     [&](const auto* run) { return quantity.of(run->result).has_value(); });
}

bool has_mark(const Curve& curve, const Quantity& quantity) {
  return has_value(curve, quantity) ||
         std::any_of(curve.runs.begin(), curve.runs.end(), [](const auto* run) { return ended_early(*run); });
}

std::vector<Panel> panels_against_step(const Selection& selection, const Quantity& quantity, bool guides) {
  auto panels = all_panels(selection, quantity);
  drop_all_zero(panels);
  share_y_axis(panels, y_axis(panels, quantity));
  for (auto& panel : panels) {
    if (!guides) break;
    panel.guides = panel.x_column == "tolerance" ? slope_guides(panel, {{1, "tol"}})
                                                 : slope_guides(panel, {{1, "h"}, {2, "h^{2}"}, {4, "h^{4}"}});
  }
  return panels;
}

}  // namespace polhode::study::report::figures
