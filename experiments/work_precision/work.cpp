// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/work_precision/work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/curves/work.hpp"
#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::work_precision {
namespace {

constexpr std::size_t most_coloured = 8;  ///< if there are more methods, those off the envelope are grey
constexpr std::size_t most_panels = 6;

std::string error_text(int decade) { return fmt::format("1e{}", decade); }

/// Consecutive decades of error in which one curve is the cheapest.
struct Reign {
  std::size_t curve;
  int from, to;  ///< decades of the largest and the smallest error
};
std::vector<Reign> reigns(const std::vector<EnvelopePoint>& envelope) {
  std::vector<Reign> all;
  for (const auto& point : envelope) {
    if (!all.empty() && all.back().curve == point.curve) all.back().to = point.decade;
    else all.push_back({point.curve, point.decade, point.decade});
  }
  return all;
}

/// The analysis for one measure of cost:
/// 1. work_of_motions(): for each motion the curves that compete, and their lower envelope.
/// 2. sentences(), outside(): the cheapest methods down to each error; methods that do not compete.
/// 3. table(), figure(), csv(): the envelope at each decade of error.
class Work {
 public:
  Work(const StudyView& study, const Grouping& grouping, const RunCost& cost)
      : grouping_(grouping), cost_(cost), motions_(work_of_motions(study, grouping, cost)) {}

  bool empty() const { return motions_.empty(); }

  std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    for (const MotionWork& motion : motions_) {
      if (auto text = sentence(motion); !text.empty()) all.push_back(std::move(text));
    }
    return all;
  }

  /// Sentences about methods that do not compete, with the motions.
  std::vector<std::string> outside() const {
    std::vector<std::string> all;
    std::map<std::vector<std::string>, std::vector<std::string>> exact;
    std::set<std::string> without;
    for (const MotionWork& motion : motions_) {
      std::vector<std::string> labels;
      for (const auto* curve : motion.exact) labels.push_back(grouping_.label(*curve));
      if (!labels.empty()) exact[labels].push_back(grouping_.cases[motion.case_index].label());
      for (const auto* curve : motion.without) without.insert(grouping_.methods[curve->method_index]);
    }
    for (const auto& [labels, cases] : exact) {
      all.push_back(fmt::format("{} {} exact on {}: no approximation competes, so the envelope is that of the others.",
                                words(labels), labels.size() == 1 ? "is" : "are", words(cases)));
    }
    if (!without.empty()) {
      all.push_back(fmt::format("{} count no {} and do not stand against them.",
                                words({without.begin(), without.end()}), cost_.words));
    }
    return all;
  }

  Table table() const {
    using Kind = Column::Kind;
    Table table{.caption = fmt::format(
                    "The cheapest method at each decade of error, by {}; bound: its cheapest run is better than that",
                    cost_.words),
                .columns = {{"motion", "", Kind::name},
                            {"error at most", "rad or m"},
                            {"cheapest", "", Kind::text},
                            {cost_.axis},
                            {"bound", "", Kind::text},
                            {"next", "", Kind::text},
                            {"times as much"}},
                .rows = {}};
    for (const MotionWork& motion : motions_) {
      for (const auto& p : motion.envelope) {
        table.rows.push_back({grouping_.cases[motion.case_index].label(), error_text(p.decade), label(motion, p.curve),
                              number(p.cost), p.at_most ? "at most" : "", p.next ? label(motion, *p.next) : "",
                              p.next ? number(p.next_cost / p.cost) : ""});
      }
    }
    return without_empty_columns(std::move(table));
  }

  std::string csv() const {
    std::string text =
        csv_row({"scenario", "motion", "error_of", "error_at_most_rad", "error_at_most_m", "method", "formulation",
                 cost_.column, "is_upper_bound", "next_method", "next_formulation", "next_" + cost_.column});
    for (const MotionWork& motion : motions_) {
      const Case& of = grouping_.cases[motion.case_index];
      const bool rad = motion.quantity.unit == " rad";
      for (const auto& p : motion.envelope) {
        const auto method = [&](std::size_t i) { return grouping_.methods[motion.curves[i]->method_index]; };
        const auto variant = [&](std::size_t i) { return grouping_.variants[motion.curves[i]->variant_index]; };
        text += csv_row({of.scenario, of.label(), motion.quantity.column, rad ? error_text(p.decade) : "",
                         rad ? "" : error_text(p.decade), method(p.curve), variant(p.curve), exact(p.cost),
                         p.at_most ? "yes" : "no", p.next ? method(*p.next) : "", p.next ? variant(*p.next) : "",
                         p.next ? exact(p.next_cost) : ""});
      }
    }
    return text;
  }

  Figure figure(const std::string& name, const std::string& title, const std::string& caption) const {
    Figure figure{.name = name, .title = title, .caption = caption};
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
  std::string label(const MotionWork& motion, std::size_t i) const { return grouping_.label(*motion.curves[i]); }

  static std::vector<const Curve*> drawn_of(const MotionWork& motion) {
    auto all = motion.curves;
    all.insert(all.end(), motion.exact.begin(), motion.exact.end());
    return all;
  }

  /// "On hairer_vilmart: explicit_midpoint down to 1e-2 rad, then rk4 to 1e-10 rad (1230 right-hand sides at 1e-6 …)".
  std::string sentence(const MotionWork& motion) const {
    if (motion.envelope.empty()) {
      return fmt::format("No run follows {}: {} at every step and tolerance, or the run did not end.",
                         grouping_.cases[motion.case_index].label(),
                         motion.quantity.unit == " rad" ? "the attitude is off by more than a radian"
                                                        : "the position is off by more than the motion goes");
    }
    std::vector<std::string> parts;
    for (const Reign& reign : reigns(motion.envelope)) {
      const auto at = std::find_if(motion.envelope.begin(), motion.envelope.end(),
                                   [&](const auto& p) { return p.decade == reign.to; });
      const auto range = reign.from == reign.to ? error_text(reign.to)
                                                : fmt::format("{} to {}", error_text(reign.from), error_text(reign.to));
      parts.push_back(fmt::format("{} at {}{} ({}{}{} there)", label(motion, reign.curve), range, motion.quantity.unit,
                                  at->at_most ? "at most " : "", number(at->cost), cost_.unit));
    }
    return fmt::format("Cheapest by {} on {}, from the largest error down: {}.", cost_.words,
                       grouping_.cases[motion.case_index].label(), fmt::format("{}", fmt::join(parts, "; then ")));
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
      panel.envelope.push_back({p.cost, std::pow(10.0, p.decade), p.curve == before ? "" : label(motion, p.curve)});
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
  RunCost cost_;
  std::vector<MotionWork> motions_;
};

constexpr const char* reading =
    "Lower left is better. The broad pale line is the lower envelope: at each decade of error the least cost that "
    "reaches "
    "it, with the name of the method where another one takes over.";

}  // namespace

Analysis work_against_error(const StudyView& study) {
  const Grouping grouping = group(study);
  Analysis found{.heading = "The cheapest method for an error"};
  const Work by_evaluations(study, grouping, cost_in_right_hand_sides()), by_time(study, grouping, cost_in_time());
  found.sentences = by_evaluations.sentences();
  for (auto& text : by_evaluations.outside()) found.sentences.push_back(std::move(text));
  found.files.push_back({"envelope.csv", by_evaluations.csv()});
  if (by_evaluations.empty() && by_time.empty()) {
    found.sentences.emplace_back(
        "No error was measured: no exact solution is known for these motions, or no run ended.");
    return found;
  }
  found.method = {
      "The error is the largest one that was seen (with samples = 1 the one at the end). Between two runs of a method "
      "its cost "
      "for an error is read off the straight line of the logarithms; nothing is extrapolated: a cost marked “at most” "
      "is that "
      "of "
      "the method’s cheapest run, which is better than asked for. A run whose attitude is off by a radian (whose "
      "position by "
      "more than the motion goes), and those of larger steps, count for nothing; and no run is better than its "
      "rounding, "
      "16 ε √steps or the floor at which its method’s errors no longer fall."};
  if (!by_evaluations.empty()) {
    found.tables.push_back({"envelope", by_evaluations.table()});
    found.figures.push_back(
        by_evaluations.figure("error_against_evaluations", "Error against right-hand sides",
                              fmt::format("The error of each run against the right-hand sides that it "
                                          "evaluated. {}",
                                          reading)));
  }
  if (!by_time.empty()) {
    found.timed.sentences = by_time.sentences();
    found.timed.figures.push_back(
        by_time.figure("error_against_time", "Error against time",
                       fmt::format("The error of each run against its wall time. {}", reading)));
    found.timed.files.push_back({"envelope_time.csv", by_time.csv()});
  }
  return found;
}

}  // namespace polhode::study::work_precision
