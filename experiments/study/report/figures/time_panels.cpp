// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/figures/time_panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "experiments/study/plot/axis.hpp"

namespace polhode::study::inline report::inline figures {

namespace {

constexpr std::size_t max_columns = 3;

PlottedCurve curve_against_time(const RunRecord& run, const SeriesQuantity& quantity) {
  PlottedCurve plotted;
  double last = 0;
  for (const auto& point : run.result.series) {
    const double y = quantity.of(point);
    if (!std::isfinite(y) || std::abs(y) > off_scale_above) {
      // The rest of the curve is off the scale, which is marked by one cross.
      plotted.points.push_back({point.t, std::isnan(y) ? std::copysign(1.0, last) : y, 0, Mark::edge});
      return plotted;
    }
    plotted.points.push_back({point.t, y, 0, Mark::value});
    last = y;
  }
  if (ended_early(run)) plotted.points.push_back({run.result.t_reached, std::copysign(1.0, last), 0, Mark::edge});
  return plotted;
}

/// The steps (or tolerances) of a block, largest first.
std::vector<double> steps_of(const Block& block, bool adaptive) {
  std::set<double, std::greater<>> steps;
  for (const auto* curve : block.curves) {
    if (curve->adaptive != adaptive) continue;
    for (const auto* run : curve->runs) {
      if (abscissa(*run)) steps.insert(*abscissa(*run));
    }
  }
  return {steps.begin(), steps.end()};
}

const RunRecord* run_with(const Curve& curve, double step) {
  const auto found =
      std::find_if(curve.runs.begin(), curve.runs.end(), [&](const auto* r) { return abscissa(*r) == step; });
  return found == curve.runs.end() ? nullptr : *found;
}

/// Panel of the step at a fraction (0 to 1) of the list of steps from the largest to the smallest.
Panel panel_of(const Block& block, const SeriesQuantity& quantity, const Selection& selection, double fraction) {
  Panel panel{.title = block.title, .x_column = "t_s", .y_column = quantity.column};
  double t_end = 0;
  for (const bool adaptive : {false, true}) {
    const auto steps = steps_of(block, adaptive);
    if (steps.empty()) continue;
    const double step = steps[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(steps.size() - 1)))];
    const RunRecord* shown = nullptr;
    for (const auto* curve : block.curves) {
      const auto* run = curve->adaptive == adaptive ? run_with(*curve, step) : nullptr;
      if (run == nullptr || run->result.series.empty()) continue;
      auto plotted = curve_against_time(*run, quantity);
      plotted.label = selection.label(*curve) + ", " + step_label(*run);
      plotted.method = curve->method_index;
      plotted.variant = selection.dash_of(*curve);
      panel.curves.push_back(std::move(plotted));
      t_end = std::max(t_end, run->config.t_end);
      shown = run;
    }
    if (shown != nullptr) panel.title.push_back(step_label(*shown));
  }
  panel.x = time_axis(t_end > 0 ? t_end : 1);
  return panel;
}

Axis y_axis(const std::vector<Panel>& row, const SeriesQuantity& quantity) {
  double lowest = 0, highest = 0, smallest_curve = std::numeric_limits<double>::infinity();
  for (const auto& panel : row) {
    for (const auto& curve : panel.curves) {
      double largest = 0;
      for (const auto& point : curve.points) {
        if (point.mark != Mark::value) continue;
        lowest = std::min(lowest, point.value);
        highest = std::max(highest, point.value);
        largest = std::max(largest, std::abs(point.value));
      }
      if (largest > 0) smallest_curve = std::min(smallest_curve, largest);
    }
  }
  return symlog_axis(quantity.axis, lowest, highest, std::isfinite(smallest_curve) ? smallest_curve : 0);
}

std::size_t columns_of(const Block& block) {
  return std::clamp<std::size_t>(std::max(steps_of(block, false).size(), steps_of(block, true).size()), 1, max_columns);
}

}  // namespace

bool has_series(const Curve& curve) {
  return std::any_of(curve.runs.begin(), curve.runs.end(), [](const auto* run) { return !run->result.series.empty(); });
}

std::vector<std::vector<Panel>> panels_against_time(const Selection& selection, const SeriesQuantity& quantity) {
  const auto blocks = selection.blocks([](const Curve&) { return true; });
  std::vector<std::vector<Panel>> rows;
  for (const auto& block : blocks) {
    const std::size_t columns = columns_of(block);  // a block of fewer steps than the others shows none twice
    std::vector<Panel> row;
    for (std::size_t c = 0; c < columns; ++c) {
      const double fraction = columns == 1 ? 0 : static_cast<double>(c) / static_cast<double>(columns - 1);
      auto panel = panel_of(block, quantity, selection, fraction);
      if (!panel.curves.empty()) row.push_back(std::move(panel));
    }
    share_y_axis(row, y_axis(row, quantity));
    if (!row.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace polhode::study::report::figures
