// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/precision/rounding_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"

namespace polhode::study::precision {
namespace {

using precision::Family;
using precision::RoundingProblem;
using precision::Rung;

constexpr std::size_t most_problems = 3;  // largest number of panels in a row
constexpr Precision precisions[] = {Precision::single_precision, Precision::double_precision,
                                    Precision::extended_precision};

PlottedCurve curve_of(const Family& family) {
  return {.label = family.arithmetic(),
          .method = static_cast<std::size_t>(family.precision),
          .variant = family.compensated};
}

/// One axis for all panels of a row; headroom: factor between its end and the largest value, for guides.
Axis shared_axis(const std::string& label, const std::vector<Panel>& panels, double headroom = 1) {
  std::vector<double> values;
  for (const auto& panel : panels) {
    for (const auto& curve : panel.curves) {
      for (const auto& point : curve.points) {
        if (point.mark == Mark::value) values.push_back(point.value);
      }
    }
  }
  if (!values.empty()) values.push_back(headroom * *std::max_element(values.begin(), values.end()));
  return log_axis(label, values, needs_of(panels));
}

/// A line of slope `power` from the point (x, y) to the abscissa `to`.
Guide guide_through(double x, double y, double to, double power, std::string label) {
  const double end = y * std::pow(to / x, power);
  return {x, y, to, end, std::move(label), end};
}

/// The curve of a variant with the largest last value, among those of at least three points; null if there is none.
const PlottedCurve* highest(const Panel& panel, std::size_t variant) {
  const PlottedCurve* best = nullptr;
  for (const auto& curve : panel.curves) {
    if (curve.variant != variant || curve.points.size() < 3) continue;
    if (best == nullptr || curve.points.back().value > best->points.back().value) best = &curve;
  }
  return best;
}

std::vector<Panel> ladder_panels(const std::vector<const RoundingProblem*>& problems, const Quantity& quantity) {
  std::vector<Panel> panels;
  bool any = false;
  for (const RoundingProblem* problem : problems) {
    const bool adaptive = problem->families.front().adaptive();
    Panel panel{.title = {problem->label()}, .x_column = adaptive ? "tolerance" : "dt_s", .y_column = quantity.column};
    std::vector<double> steps;
    for (const Family& family : problem->families) {
      auto curve = curve_of(family);
      for (const Rung& rung : family.rungs) {
        const auto error = error_of(rung, quantity);
        if (!error) continue;
        curve.points.push_back({rung.step, *error, 0,
                                !std::isfinite(*error) || *error > off_scale_above ? Mark::edge
                                : *error > 0                                       ? Mark::value
                                                                                   : Mark::zero});
        steps.push_back(rung.step);
      }
      if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
    }
    if (steps.empty()) continue;
    any = true;
    panel.x = step_axis(adaptive ? "tolerance" : "step h = dt (s)", steps);
    panels.push_back(std::move(panel));
  }
  if (any) share_y_axis(panels, shared_axis(quantity.axis, panels));
  return panels;
}

/// Adds the line of slope −1/2 above the end of the highest curve of plain summation: the sum of n = T/h independent
/// rounding errors grows as √n.
void add_step_guides(std::vector<Panel>& panels) {
  for (Panel& panel : panels) {
    const auto* curve = panel.x_column == "dt_s" ? highest(panel, 0) : nullptr;
    if (curve == nullptr) continue;
    const auto& end = curve->points.back();
    panel.guides.push_back(guide_through(end.x, 30 * end.value, 6 * end.x, -0.5, "h^{−1/2}"));
  }
}

/// The rung of the largest step at which rounding dominates in all runs: the rounding errors of its steps are the least
/// correlated.
const Rung* largest_in_rounding(const Family& family, bool (*is_rounding)(const Rung::Run&)) {
  const auto rung = std::find_if(family.rungs.begin(), family.rungs.end(),
                                 [&](const Rung& r) { return std::all_of(r.runs.begin(), r.runs.end(), is_rounding); });
  return rung == family.rungs.end() ? nullptr : &*rung;
}

using Path = std::vector<PathPoint>;

/// Root mean square over the starts, at times a factor √2 apart. Empty if the runs were observed at different numbers
/// of times.
std::vector<Point> spread(const Rung& rung, Path (*path_of)(const RunRecord&)) {
  std::vector<Path> paths;
  for (const auto& run : rung.runs) paths.push_back(path_of(*run.run));
  std::vector<Point> points;
  const std::size_t n = paths.front().size();
  for (const auto& path : paths) {
    if (path.size() != n) return {};
  }
  double next = 0;
  for (std::size_t i = 1; i < n; ++i) {
    const double t = paths.front()[i].t;
    if (!(t >= next)) continue;
    double square = 0;
    for (const auto& path : paths) square += path[i].value * path[i].value / static_cast<double>(paths.size());
    if (square > 0) points.push_back({t, std::sqrt(square), 0, Mark::value});
    next = t * std::sqrt(2.0) * (1 - 1e-9);
  }
  return points;
}

std::vector<Panel> growth_panels(const std::vector<const RoundingProblem*>& problems, const std::string& axis,
                                 const std::string& column, Path (*path_of)(const RunRecord&),
                                 bool (*is_rounding)(const Rung::Run&)) {
  std::vector<Panel> panels;
  for (const RoundingProblem* problem : problems) {
    Panel panel{.title = {problem->label()}, .x_column = "t_s", .y_column = column};
    std::vector<double> times;
    for (const Family& family : problem->families) {
      const Rung* rung = largest_in_rounding(family, is_rounding);
      if (rung == nullptr) continue;
      auto curve = curve_of(family);
      curve.points = spread(*rung, path_of);
      for (const auto& point : curve.points) times.push_back(point.x);
      if (curve.points.size() > 2) panel.curves.push_back(std::move(curve));
    }
    if (panel.curves.empty()) continue;
    panel.x = step_axis("time (s)", times);
    panels.push_back(std::move(panel));
  }
  if (!panels.empty()) share_y_axis(panels, shared_axis(axis, panels, 5));
  return panels;
}

void add_time_guides(std::vector<Panel>& panels, double power, const std::string& label) {
  for (Panel& panel : panels) {
    const auto* curve = highest(panel, 0);
    if (curve == nullptr) continue;
    const auto& end = curve->points.back();
    const double from = end.x / 40, to = end.x / 4;
    panel.guides.push_back(guide_through(from, 4 * end.value * std::pow(from / end.x, power), to, power, label));
  }
}

/// Sets the legends: precisions stand in place of methods, with a colour and a marker each.
void finish(Figure& figure, const std::vector<const RoundingProblem*>& problems, std::size_t all) {
  for (const Precision p : precisions) figure.methods.emplace_back(name(p));
  bool compensated = false, plain = false;
  for (const RoundingProblem* problem : problems) {
    for (const Family& family : problem->families) (family.compensated ? compensated : plain) = true;
  }
  figure.variants = {""};
  if (compensated) figure.variants = {"plain", "compensated"};
  note_marks(figure);
  if (problems.size() < all) figure.caption += fmt::format(" The first {} of {} problems.", problems.size(), all);
}

}  // namespace

std::vector<Figure> rounding_figures(const std::vector<RoundingProblem>& problems) {
  std::vector<const RoundingProblem*> shown;
  for (const RoundingProblem& problem : problems) {
    if (shown.size() < most_problems) shown.push_back(&problem);
  }
  std::vector<Figure> figures;
  Figure ladder{.name = "error_against_step_by_precision",
                .title = "Truncation and rounding",
                .caption =
                    "Root mean square over the starts. To the right truncation: the precisions agree, on a line of the "
                    "method’s order. To the left rounding: with plain summation the error grows again as the steps "
                    "become more, as the square root of their number; the dashed lines are compensated."};
  for (const auto& quantity : {quantity::attitude_error(), quantity::energy_drift()}) {
    auto panels = ladder_panels(shown, quantity);
    add_step_guides(panels);
    if (!panels.empty()) add_rows(ladder, std::move(panels), most_problems);
  }
  if (!ladder.panels.empty()) {
    finish(ladder, shown, problems.size());
    figures.push_back(std::move(ladder));
  }
  Figure growth{.name = "rounding_against_time",
                .title = "How rounding grows",
                .caption =
                    "Root mean square over the starts, at the largest step at which the error of every run is "
                    "rounding. A random walk of the energy is parallel to √t, and the attitude that follows from it to "
                    "t to the 3/2."};
  auto energy =
      growth_panels(shown, "energy drift (relative)", "energy_drift_rel", energy_path, precision::is_rounding);
  add_time_guides(energy, 0.5, "t^{1/2}");
  auto attitude = growth_panels(shown, "attitude error (rad)", "attitude_error_rad", attitude_path,
                                precision::is_rounding_in_attitude);
  add_time_guides(attitude, 1.5, "t^{3/2}");
  if (!energy.empty()) add_rows(growth, std::move(energy), most_problems);
  if (!attitude.empty()) add_rows(growth, std::move(attitude), most_problems);
  if (!growth.panels.empty()) {
    finish(growth, shown, problems.size());
    figures.push_back(std::move(growth));
  }
  return figures;
}

}  // namespace polhode::study::precision
