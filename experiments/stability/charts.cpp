// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::stability {
namespace {

constexpr std::size_t most_chart_rows = 40;  // methods in one chart
constexpr std::size_t most_charts = 6;       // number of figures
constexpr std::size_t maps_in_figure = 9;
constexpr std::size_t most_map_figures = 4;
constexpr double row_height = 17;        // pixels
constexpr double logarithmic_from = 30;  // smallest range, largest over smallest value, of a logarithmic axis

/// Colours in the order of Verdict, which differ in lightness as well as in hue: blue without growth of the energy,
/// yellow for a slow gain, orange and brown for growth. The last one marks the limit of the motion.
std::vector<Shade> shades() {
  return {{"stable", "3B8FC4"},  {"damped", "BFE0F2"},   {"gaining slowly", "FBEFA5"},
          {"gaining", "F5A431"}, {"blown up", "7B2D12"}, {"motion followed up to here", "000000"}};
}
constexpr std::size_t limit_shade = 5;
constexpr double limit_width = 0.006;  // width of a mark over that of the axis

struct Interval {
  double low, high;
};

/// Cells about the values that reach half way to their neighbours, in the logarithm on a logarithmic axis.
std::vector<Interval> cells_about(const std::vector<double>& values, bool logarithmic) {
  std::vector<double> at;
  for (const double v : values) at.push_back(logarithmic ? std::log(v) : v);
  const auto back = [&](double x) { return logarithmic ? std::exp(x) : x; };
  // The outer cells are as wide as the widest gap, since a bisection may have narrowed the gap beside them.
  double widest = at.size() > 1 ? 0 : 0.1;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) widest = std::max(widest, at[i + 1] - at[i]);
  std::vector<Interval> cells;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double below = i > 0 ? at[i] - at[i - 1] : widest;
    const double above = i + 1 < at.size() ? at[i + 1] - at[i] : widest;
    cells.push_back({back(at[i] - below / 2), back(at[i] + above / 2)});
  }
  return cells;
}

/// A range of steps, h|ω| or s, with the same verdict.
struct Band {
  Interval step;
  Verdict verdict;
};

std::vector<Band> bands(const StabilityFinding& f) {
  std::vector<double> steps;
  std::vector<Verdict> verdicts;
  for (const auto& step : f.ladder.steps) {
    if (step.verdict == Verdict::none) continue;
    steps.push_back(step.dt * f.rate.value_or(1));
    verdicts.push_back(step.verdict);
  }
  const auto about = cells_about(steps, true);
  std::vector<Band> all;
  for (std::size_t i = 0; i < about.size(); ++i) {
    const Verdict v = verdicts[i];
    if (!all.empty() && all.back().verdict == v) all.back().step.high = about[i].high;
    else all.push_back({about[i], v});
  }
  return all;
}

/// Mark at the largest step, h|ω| or s, at which the motion is followed; at an end of the axis if it is followed at no
/// step or at all. Absent if no run was measured against a known motion.
std::optional<Interval> motion_limit(const StabilityFinding& f, const Axis& axis) {
  if (!f.ladder.measured) return std::nullopt;
  const double half = std::pow(axis.high / axis.low, limit_width / 2);
  const double at = f.motion.kind == CriticalStep::Kind::from_start ? axis.low
                    : f.motion.kind == CriticalStep::Kind::none     ? axis.high
                                                                    : f.motion.holds * f.rate.value_or(1);
  const double middle = std::clamp(at, axis.low * half, axis.high / half);
  return Interval{middle / half, middle * half};
}

Axis axis_of_steps(const std::vector<const StabilityFinding*>& found) {
  const bool rates = std::all_of(found.begin(), found.end(), [](const auto* f) { return f->rate.has_value(); });
  double low = INFINITY, high = 0;
  for (const auto* f : found) {
    for (const auto& band : bands(*f)) {
      low = std::min(low, band.step.low);
      high = std::max(high, band.step.high);
    }
  }
  Axis axis = step_axis(rates ? "h |ω|" : "step h = dt (s)", {low, high});
  axis.low = low;
  axis.high = high;
  return axis;
}

std::string step_column(const Axis& axis) { return axis.label == "h |ω|" ? "h_omega" : "dt_s"; }

/// An axis with the names of the methods from top to bottom, one unit for each.
Axis axis_of_methods(const Grouping& grouping, const std::vector<std::size_t>& methods) {
  Axis axis{.low = 0, .high = static_cast<double>(methods.size()), .named = true};
  for (std::size_t i = 0; i < methods.size(); ++i) {
    axis.ticks.push_back({axis.high - static_cast<double>(i) - 0.5, grouping.methods[methods[i]]});
  }
  return axis;
}

Panel chart_panel(const Grouping& grouping, const std::vector<const StabilityFinding*>& found,
                  const std::vector<std::size_t>& methods) {
  Panel panel{.x = axis_of_steps(found), .y = axis_of_methods(grouping, methods), .y_column = "row"};
  panel.x_column = step_column(panel.x);
  const Curve& curve = *found.front()->ladder.curve;
  panel.title = {grouping.cases[curve.case_index].scenario};
  if (grouping.variants.size() > 1) panel.title.push_back(grouping.variants[curve.variant_index]);
  for (const auto* f : found) {
    const auto at = std::find(methods.begin(), methods.end(), f->ladder.curve->method_index);
    if (at == methods.end()) continue;
    const double top = panel.y.high - static_cast<double>(at - methods.begin());
    for (const auto& band : bands(*f)) {
      panel.cells.push_back(
          {band.step.low, band.step.high, top - 0.92, top - 0.08, static_cast<std::size_t>(band.verdict)});
    }
    if (const auto limit = motion_limit(*f, panel.x)) {
      panel.cells.push_back({limit->low, limit->high, top - 1, top, limit_shade});
    }
  }
  return panel;
}

std::optional<double> number_of(const RunConfig& config, const std::string& key) {
  for (const Override& o : config.varied) {
    if (o.key != key) continue;
    double x = 0;
    const auto [end, error] = std::from_chars(o.value.data(), o.value.data() + o.value.size(), x);
    if (error == std::errc() && end == o.value.data() + o.value.size()) return x;
  }
  return std::nullopt;
}

/// The findings of one method by the value of the key.
using Columns = std::map<double, const StabilityFinding*>;

Axis axis_of_key(const std::string& key, const std::vector<double>& values, bool logarithmic) {
  const auto about = cells_about(values, logarithmic);
  Axis axis = logarithmic ? step_axis(key, values) : linear_axis(key, about.front().low, about.back().high);
  axis.low = about.front().low;
  axis.high = about.back().high;
  return axis;
}

Panel map_panel(const Grouping& grouping, const Columns& columns, const std::string& key, const Axis& steps) {
  std::vector<double> values;
  for (const auto& [value, f] : columns) values.push_back(value);
  const bool logarithmic = values.front() > 0 && values.back() / values.front() >= logarithmic_from;
  Panel panel{.x = axis_of_key(key, values, logarithmic), .y = steps, .x_column = key, .y_column = step_column(steps)};
  const auto about = cells_about(values, logarithmic);
  panel.title = {grouping.label(*columns.begin()->second->ladder.curve)};
  std::size_t i = 0;
  for (const auto& [value, f] : columns) {
    for (const auto& band : bands(*f)) {
      panel.cells.push_back(
          {about[i].low, about[i].high, band.step.low, band.step.high, static_cast<std::size_t>(band.verdict)});
    }
    if (const auto limit = motion_limit(*f, steps)) {
      panel.cells.push_back({about[i].low, about[i].high, limit->low, limit->high, limit_shade});
    }
    ++i;
  }
  return panel;
}

}  // namespace

std::vector<Figure> stability_charts(const Grouping& grouping, const std::vector<StabilityFinding>& found) {
  // Findings by motion and variant, in the order of the runs.
  std::map<std::pair<std::size_t, std::size_t>, std::vector<const StabilityFinding*>> panels;
  for (const auto& f : found) {
    const Curve& curve = *f.ladder.curve;
    if (grouping.cases[curve.case_index].details.empty()) {
      panels[{curve.case_index, curve.variant_index}].push_back(&f);
    }
  }
  std::vector<Figure> figures;
  for (const auto& [place, all] : panels) {
    if (figures.size() == most_charts) break;
    std::set<std::size_t> used;
    for (const auto* f : all) used.insert(f->ladder.curve->method_index);
    std::vector<std::size_t> methods(used.begin(), used.end());
    if (methods.size() > most_chart_rows) methods.resize(most_chart_rows);
    const std::string which = panels.size() > 1 ? fmt::format("_{}", figures.size() + 1) : "";
    Figure figure{
        .name = "stability_chart" + which,
        .title = fmt::format("Stability on {}", grouping.cases[place.first].scenario),
        .caption =
            "What becomes of the energy against the step; blown up: or the method failed. Right of its mark a "
            "method no longer follows the motion, whatever the energy does."};
    if (methods.size() < used.size()) {
      figure.caption += fmt::format(" {} methods are left out.", used.size() - methods.size());
    }
    figure.shades = shades();
    figure.panel_height = row_height * static_cast<double>(methods.size());
    add_rows(figure, {chart_panel(grouping, all, methods)}, 1);
    figures.push_back(std::move(figure));
  }
  return figures;
}

std::vector<Figure> stability_maps(const Grouping& grouping, const std::vector<StabilityFinding>& found,
                                   const std::string& key) {
  // Findings by scenario, then by variant and method.
  std::map<std::string, std::map<std::pair<std::size_t, std::size_t>, Columns>> maps;
  for (const auto& f : found) {
    const Curve& curve = *f.ladder.curve;
    const RunConfig& config = f.ladder.steps.front().longest().config;
    if (const auto x = number_of(config, key)) {
      maps[config.scenario][{curve.variant_index, curve.method_index}][*x] = &f;
    }
  }
  std::vector<Figure> figures;
  for (auto& [scenario, panels] : maps) {
    std::erase_if(panels, [](const auto& p) { return p.second.size() < 2; });
    std::vector<const StabilityFinding*> all;
    for (const auto& [place, columns] : panels) {
      for (const auto& [value, f] : columns) all.push_back(f);
    }
    if (all.empty()) continue;
    const Axis steps = axis_of_steps(all);
    std::vector<Panel> drawn;
    for (const auto& [place, columns] : panels) drawn.push_back(map_panel(grouping, columns, key, steps));
    for (std::size_t first = 0; first < drawn.size() && first / maps_in_figure < most_map_figures;
         first += maps_in_figure) {
      const std::size_t last = std::min(drawn.size(), first + maps_in_figure);
      Figure figure{
          .name = fmt::format("stability_map_{}", figures.size() + 1),
          .title = fmt::format("Stability of {} over {}", scenario, key),
          .caption = fmt::format("What becomes of the energy over {} (SI units) and the step, one panel for each "
                                 "method; blown up: or the method failed. Above its mark a method no longer "
                                 "follows the motion, whatever the energy does.",
                                 key)};
      if (drawn.size() > maps_in_figure) {
        figure.caption += fmt::format(" Methods {} to {} of {}.", first + 1, last, drawn.size());
      }
      figure.shades = shades();
      add_rows(figure,
               {drawn.begin() + static_cast<std::ptrdiff_t>(first), drawn.begin() + static_cast<std::ptrdiff_t>(last)},
               std::min<std::size_t>(3, drawn.size()));
      figures.push_back(std::move(figure));
    }
  }
  return figures;
}

}  // namespace polhode::study::stability
