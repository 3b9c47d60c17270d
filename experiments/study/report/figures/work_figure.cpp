// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/figures/work_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline figures {
namespace {

constexpr std::size_t most_coloured = 8;
constexpr std::size_t most_panels = 6;

class WorkFigure {
 public:
  WorkFigure(const Grouping& grouping, const std::vector<MotionWork>& motions, const RunCost& cost)
      : grouping_(grouping), motions_(motions), cost_(cost) {}

  Figure figure(Figure figure) const {
    std::set<std::size_t> all, on_envelope;
    for (const MotionWork& motion : motions_) {
      for (const auto* curve : drawn_of(motion)) all.insert(curve->method_index);
      for (const auto& p : motion.envelope) on_envelope.insert(motion.curves[p.curve]->method_index);
    }
    const auto& coloured = all.size() <= most_coloured ? all : on_envelope;
    std::vector<Panel> panels;
    for (const MotionWork& motion : motions_) {
      if (panels.size() < most_panels) panels.push_back(panel(motion, coloured));
    }
    share_y_axis(panels, y_axis(panels));
    add_rows(figure, std::move(panels), 1);  // names along the envelope require the whole width
    figure.methods = grouping_.methods;
    figure.variants = {""};
    note_marks(figure);
    if (motions_.size() > most_panels) {
      figure.caption += fmt::format(" The first {} of {} motions.", most_panels, motions_.size());
    }
    return figure;
  }

 private:
  static std::vector<const Curve*> drawn_of(const MotionWork& motion) {
    auto all = motion.curves;
    all.insert(all.end(), motion.exact.begin(), motion.exact.end());
    return all;
  }

  Panel panel(const MotionWork& motion, const std::set<std::size_t>& coloured) const {
    Panel panel{.title = {grouping_.cases[motion.case_index].label()},
                .x_column = cost_.column,
                .y_column = motion.quantity.column};
    std::vector<double> costs;
    for (const auto* curve : drawn_of(motion)) {
      PlottedCurve plotted{.label = grouping_.label(*curve),
                           .method = curve->method_index,
                           .variant = 0,
                           .muted = !coloured.contains(curve->method_index)};
      for (const auto* run : curve->runs) {
        const double cost = cost_.of(run->result), error = value(*run, motion.quantity).value_or(0);
        if (!(cost > 0) || !(error > 0)) continue;
        plotted.points.push_back({cost, error, 0, Mark::value});
        costs.push_back(cost);
      }
      if (!plotted.points.empty()) panel.curves.push_back(std::move(plotted));
    }
    // Grey curves are drawn first, below the others.
    std::stable_partition(panel.curves.begin(), panel.curves.end(), [](const auto& c) { return c.muted; });
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (const auto& p : motion.envelope) {
      panel.envelope.push_back(
          {p.cost, std::pow(10.0, p.decade), p.curve == before ? "" : grouping_.label(*motion.curves[p.curve])});
      before = p.curve;
    }
    costs.push_back(room_for_names(panel, costs));
    panel.x = step_axis(cost_.axis, costs);
    return panel;
  }

  /// Lower end of the cost axis for which the names to the left of the envelope are inside the panel.
  static double room_for_names(const Panel& panel, const std::vector<double>& costs) {
    constexpr double panel_width = style::figure_width - style::left_margin - style::right_margin;
    const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
    double low = std::log10(*least);
    const double high = std::log10(*most);
    for (const auto& mark : panel.envelope) {
      const double share =
          std::min(0.6, (static_cast<double>(length(mark.label)) + 2) * style::character_width / panel_width);
      if (!mark.label.empty()) low = std::min(low, (std::log10(mark.x) - share * high) / (1 - share));
    }
    return std::pow(10.0, low);
  }

  Axis y_axis(const std::vector<Panel>& panels) const {
    std::vector<double> errors;
    std::set<std::string> labels;
    for (const auto& panel : panels) {
      for (const auto& curve : panel.curves) {
        for (const auto& point : curve.points) errors.push_back(point.value);
      }
    }
    for (const MotionWork& motion : motions_) {
      labels.insert(motion.quantity.unit == " rad" ? "attitude error (rad)" : "position error (m)");
    }
    return log_axis(fmt::format("{}", fmt::join(labels, " or ")), errors, {});
  }

  const Grouping& grouping_;
  const std::vector<MotionWork>& motions_;
  const RunCost& cost_;
};

}  // namespace

Figure work_figure(const Grouping& grouping, const std::vector<MotionWork>& motions, const RunCost& cost,
                   Figure figure) {
  return WorkFigure(grouping, motions, cost).figure(std::move(figure));
}

}  // namespace polhode::study::report::figures
