// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/figures/work_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline figures {
namespace {

constexpr std::size_t most_coloured = 10;
constexpr std::size_t most_panels = 6;

class WorkFigure {
 public:
  WorkFigure(const Grouping& grouping, const std::vector<MotionWork>& motions, const RunCost& cost)
      : grouping_(grouping), motions_(motions), cost_(cost) {}

  Figure figure(Figure figure) const {
    std::set<std::size_t> all, on_envelope, with_next;
    for (const MotionWork& motion : motions_) {
      for (const auto* curve : drawn_of(motion)) all.insert(curve->method_index);
      for (const auto& p : motion.envelope) {
        on_envelope.insert(motion.curves[p.curve]->method_index);
        if (p.next) with_next.insert(motion.curves[*p.next]->method_index);
      }
    }
    with_next.insert(on_envelope.begin(), on_envelope.end());
    const auto& coloured = all.size() <= most_coloured         ? all
                           : with_next.size() <= most_coloured ? with_next
                                                               : on_envelope;
    std::vector<Panel> panels;
    for (const MotionWork& motion : motions_) {
      if (panels.size() < most_panels) panels.push_back(panel(motion, coloured, figure.look));
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

  Panel panel(const MotionWork& motion, const std::set<std::size_t>& coloured, const FigureLook& look) const {
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
    name_the_next(panel, motion, coloured);
    make_room_for_names(panel, costs, look);
    panel.x = step_axis(cost_.axis, costs);
    return panel;
  }

  /// Writes the name of each method that is the next after the cheapest at some error and the cheapest at none, where
  /// it is the next.
  void name_the_next(Panel& panel, const MotionWork& motion, const std::set<std::size_t>& coloured) const {
    std::map<std::size_t, std::vector<const EnvelopePoint*>> next;  // points of each curve
    for (const auto& p : motion.envelope) {
      if (p.next) next[*p.next].push_back(&p);
    }
    for (const auto& p : motion.envelope) next.erase(p.curve);
    for (const auto& [curve, points] : next) {
      const std::size_t method = motion.curves[curve]->method_index;
      if (!coloured.contains(method)) continue;
      const EnvelopePoint& p = *points[points.size() / 2];
      panel.names.push_back(
          {p.next_cost, std::pow(10.0, p.decade), grouping_.label(*motion.curves[curve]), method, false, true});
    }
  }

  /// Adds the ends of a cost axis on which the names, left of the envelope and right of other curves, are inside the
  /// panel.
  static void make_room_for_names(const Panel& panel, std::vector<double>& costs, const FigureLook& look) {
    const double scale = look.font_size / style::font_size;
    const double panel_width = look.width() - (style::left_margin + style::right_margin) * scale;
    const auto share = [&](const std::string& name) {
      return std::min(0.5, (static_cast<double>(length(name)) + 2) * style::character_width * scale / panel_width);
    };
    const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
    double low = std::log10(*least), high = std::log10(*most);
    for (const auto& mark : panel.names)
      high = std::max(high, (std::log10(mark.x) - share(mark.name) * low) / (1 - share(mark.name)));
    for (const auto& mark : panel.envelope) {
      if (mark.label.empty()) continue;
      low = std::min(low, (std::log10(mark.x) - share(mark.label) * high) / (1 - share(mark.label)));
    }
    costs.push_back(std::pow(10.0, low));
    costs.push_back(std::pow(10.0, high));
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
