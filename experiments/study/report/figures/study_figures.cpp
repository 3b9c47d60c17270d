// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/figures/study_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "experiments/study/curves/reference_words.hpp"
#include "experiments/study/curves/selection.hpp"
#include "experiments/study/plot/draw_figures.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/report/figures/step_panels.hpp"
#include "experiments/study/report/figures/time_panels.hpp"
#include "experiments/study/report/figures/work_figure.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline figures {

namespace {

constexpr double panel_height_of_the_answer = 170;  // pixels: text, table and figure fit on a screen

/// Adds rows of panels to the figure; if each row has a single panel, two are put side by side.
void add_time_rows(Figure& figure, std::vector<std::vector<Panel>> rows) {
  if (rows.empty()) return;
  if (std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.size() > 1; })) {
    for (auto& row : rows) {
      const auto columns = row.size();
      add_rows(figure, std::move(row), columns);
    }
    return;
  }
  std::vector<Panel> singles;
  for (auto& row : rows) singles.push_back(std::move(row.front()));
  const std::size_t first = figure.panels.size();
  add_rows(figure, std::move(singles), 2);
  for (std::size_t i = first; i < figure.panels.size(); ++i)
    figure.panels[i].y.labelled = true;  // each has its own axis
}

std::string time_caption(const Figure& figure) {
  std::string text =
      " Each point stands for a stretch of the run and holds the largest value in it. The axis is logarithmic on both "
      "sides of zero and linear about it.";
  if (figure.columns == 2) text += " The larger step (looser tolerance) stands on the left.";
  if (figure.columns == 3) {
    text +=
        " Left to right: the largest, the middle and the smallest step (tolerance); others of the study are left out.";
  }
  return text;
}

class Figures {
 public:
  Figures(const StudyView& study, const Grouping& grouping) : study_(study), grouping_(grouping) {
    several_steps_ = std::any_of(grouping.curves.begin(), grouping.curves.end(), has_several_steps);
  }

  FigureSet all() && {
    drift_against_time();
    drift_against_step();
    momentum();
    orientation_defect();
    invariants();
    error_against_step();
    error_against_cost();
    choose_figures(study_.figure_choice, set_.figures);
    if (const auto& names = study_.figure_choice.names; !names.empty()) {
      std::erase_if(set_.absent,
                    [&](const auto& a) { return std::find(names.begin(), names.end(), a.name) == names.end(); });
    }
    return std::move(set_);
  }

 private:
  bool defined(const Quantity& quantity) const {
    return std::any_of(grouping_.curves.begin(), grouping_.curves.end(),
                       [&](const auto& curve) { return has_value(curve, quantity); });
  }

  std::vector<Quantity> defined(std::vector<Quantity> quantities) const {
    std::erase_if(quantities, [&](const auto& quantity) { return !defined(quantity); });
    return quantities;
  }

  void absent(const Figure& figure, std::string reason) {
    set_.absent.push_back({figure.name, figure.title, std::move(reason)});
  }

  void finish(Figure figure, const Selection& selection) {
    figure.methods = grouping_.methods;
    figure.variants = selection.dashed_variants();
    note_marks(figure);
    figure.caption += marks_caption(figure) + selection.omissions();
    set_.figures.push_back(std::move(figure));
  }

  /// Adds a figure of quantities against the step; each quantity begins a new row.
  void against_step(Figure figure, const std::vector<Quantity>& quantities, bool guides) {
    const auto shown = [&](const Curve& curve) {
      return std::any_of(quantities.begin(), quantities.end(), [&](const auto& q) { return has_mark(curve, q); });
    };
    const Selection selection(grouping_, shown, {.rows = 4, .variants_in_panel = 2});
    bool adaptive = false;
    for (const auto& quantity : quantities) {
      auto panels = panels_against_step(selection, quantity, guides);
      for (const auto& panel : panels) adaptive = adaptive || panel.x_column == "tolerance";
      add_rows(figure, std::move(panels), 2);
    }
    if (adaptive) figure.caption += " Adaptive methods stand against their tolerance.";
    if (guides) figure.caption += " Gray lines show slopes.";
    finish(std::move(figure), selection);
  }

  void against_time(Figure figure, const std::vector<SeriesQuantity>& quantities) {
    const Selection selection(grouping_, has_series, {.rows = 6, .variants_in_panel = 1});
    if (selection.empty()) return absent(figure, "no run left a time series");
    for (const auto& quantity : quantities) add_time_rows(figure, panels_against_time(selection, quantity));
    figure.caption += time_caption(figure);
    finish(std::move(figure), selection);
  }

  void drift_against_time() {
    against_time(
        {.name = "drift_against_time",
         .title = "Energy drift against time",
         .caption = "Energy drift, relative and with its sign, against time."},
        {{"energy_drift_rel", "energy drift (relative)", [](const SeriesPoint& p) { return p.energy_drift_rel; }}});
  }

  void drift_against_step() {
    Figure figure{.name = "drift_against_step",
                  .title = "Energy drift against the step",
                  .caption = "The largest relative energy drift of each run against its step."};
    if (!defined(quantity::energy_drift())) return absent(figure, "no run has an energy drift");
    if (!several_steps_) return absent(figure, "the study has one step size only");
    against_step(std::move(figure), {quantity::energy_drift()}, true);
  }

  /// The quantities without those that are at round-off in all runs, which the caption mentions; all quantities if that
  /// is true of each.
  std::vector<Quantity> without_quiet_ones(Figure& figure, const std::vector<Quantity>& quantities) const {
    std::vector<Quantity> kept;
    std::string note;
    for (const auto& quantity : quantities) {
      if (const auto most = largest_if_round_off(quantity)) {
        note += fmt::format(" The {} is at round-off in all runs ({} at most) and not drawn.", quantity.words,
                            number(*most));
      } else {
        kept.push_back(quantity);
      }
    }
    if (kept.empty()) return quantities;
    figure.caption += note;
    return kept;
  }

  /// The quantities without those that are exactly zero in all runs; all of them if that is true of each.
  std::vector<Quantity> without_zeros(const std::vector<Quantity>& quantities) const {
    std::vector<Quantity> kept;
    std::copy_if(quantities.begin(), quantities.end(), std::back_inserter(kept), [&](const Quantity& quantity) {
      return std::any_of(study_.runs.begin(), study_.runs.end(),
                         [&](const RunRecord& run) { return value(run, quantity).value_or(0) != 0; });
    });
    return kept.empty() ? quantities : kept;
  }

  std::optional<double> largest_if_round_off(const Quantity& quantity) const {
    double most = 0;
    for (const auto& curve : grouping_.curves) {
      for (const auto* run : curve.runs) {
        const auto found = value(*run, quantity).value_or(0);
        if (found > round_off_level(*run, quantity)) return std::nullopt;
        most = std::max(most, found);
      }
    }
    return most;
  }

  void momentum() {
    Figure figure{.name = "momentum", .title = "Drift of the momenta"};
    const auto angular = quantity::angular_momentum_drift(), linear = quantity::linear_momentum_drift();
    const auto quantities = defined({angular, linear});
    if (quantities.empty()) return absent(figure, "the forces conserve neither the linear nor the angular momentum");
    figure.caption =
        fmt::format("The largest drift of a momentum, relative, against {}.", several_steps_ ? "the step" : "time");
    for (const auto& quantity : {angular, linear}) {
      if (defined(quantity)) continue;
      figure.caption +=
          fmt::format(" No {} is drawn: the forces, or the pivot, do not conserve that momentum.", quantity.words);
    }
    if (several_steps_) return against_step(std::move(figure), without_quiet_ones(figure, quantities), false);
    std::vector<SeriesQuantity> series;
    if (defined(angular)) {
      series.push_back({"angular_momentum_drift_rel", angular.axis,
                        [](const SeriesPoint& p) { return p.angular_momentum_drift_rel; }});
    }
    if (defined(linear)) {
      series.push_back(
          {"linear_momentum_drift_rel", linear.axis, [](const SeriesPoint& p) { return p.linear_momentum_drift_rel; }});
    }
    against_time(std::move(figure), series);
  }

  void orientation_defect() {
    const auto defect = quantity::orientation_defect();
    Figure figure{.name = "orientation_defect",
                  .title = "Orientation defect",
                  .caption =
                      "How far the stored orientation is from a rotation: ||q| − 1| of a quaternion, the "
                      "Frobenius norm of RᵀR − 1 of a matrix."};
    if (!defined(defect)) return absent(figure, "no run has an orientation defect");
    if (several_steps_) return against_step(std::move(figure), {defect}, false);
    against_time(std::move(figure),
                 {{"orientation_defect", defect.axis, [](const SeriesPoint& p) { return p.orientation_defect; }}});
  }

  void invariants() {
    if (study_.invariants.empty()) return;
    std::vector<Quantity> quantities;
    for (const auto& name : study_.invariants) quantities.push_back(quantity::invariant_drift(name));
    Figure figure{
        .name = "invariants",
        .title = "Further invariants",
        .caption = fmt::format("The largest relative drift of {} against the step.", words(study_.invariants))};
    if (defined(quantities).empty()) return absent(figure, "no run has a value for them");
    if (!several_steps_) return absent(figure, "the study has one step size only; the table of runs has the values");
    against_step(std::move(figure), defined(quantities), false);
  }

  void error_against_step() {
    const auto quantities = without_zeros(defined({quantity::attitude_error(), quantity::position_error(),
                                                   quantity::velocity_error(), quantity::reaction_error()}));
    const bool by_reference = std::any_of(study_.runs.begin(), study_.runs.end(), used_reference);
    Figure figure{
        .name = "error_against_step",
        .title = "Error against the step",
        .caption = fmt::format("The largest distance of each run from the exact motion{}, against its step; a motion "
                               "without any error of one kind has no panel for it.",
                               by_reference ? " or, where none is known, from the reference" : "")};
    if (quantities.empty()) {
      return absent(figure, by_reference ? "no exact solution is known for these motions, and their reference proves "
                                           "too few digits"
                                         : "no exact solution is known for these motions");
    }
    if (!several_steps_) return absent(figure, "the study has one step size only; the table of runs has the errors");
    against_step(std::move(figure), quantities, true);
  }

  /// The figure beside the answer; an experiment with an analysis has its own.
  void error_against_cost() {
    if (study_.analysis) return;
    const RunCost cost = cost_in_right_hand_sides();
    auto motions = work_of_motions(grouping_, cost);
    std::erase_if(motions, [](const MotionWork& motion) { return motion.envelope.empty(); });
    Figure figure{.name = figure_of_the_answer,
                  .title = "Error against cost",
                  .caption =
                      "The error of each run against the right-hand sides that it evaluated. Lower left is "
                      "better. The broad pale line is the lower envelope: the least cost that reaches an error, "
                      "with the name of the method where another one takes over. A name in the colour of its "
                      "curve is that of a method that comes next there.",
                  .look = study_.figure_choice.look,
                  .panel_height = panel_height_of_the_answer};
    if (motions.empty()) return;
    if (motions.size() > 1) figure.caption += fmt::format(" The first of {} motions.", motions.size());
    motions.resize(1);
    set_.figures.push_back(work_figure(grouping_, motions, cost, std::move(figure)));
  }

  const StudyView& study_;
  const Grouping& grouping_;
  bool several_steps_ = false;
  FigureSet set_;
};

/// A sentence about chosen figures that the study does not have.
std::string words_of_missing(const StudyView& study, const FigureSet& set, const FigureSet& timed) {
  std::string said;
  for (const std::string& name : study.figure_choice.names) {
    const auto is_it = [&](const auto& figure) { return figure.name == name; };
    if (std::any_of(set.figures.begin(), set.figures.end(), is_it)) continue;
    if (std::any_of(timed.figures.begin(), timed.figures.end(), is_it)) continue;
    const auto absent = std::find_if(set.absent.begin(), set.absent.end(), is_it);
    said += fmt::format("{}--figure: this study has no figure '{}'{}", said.empty() ? "" : "; ", name,
                        absent == set.absent.end() ? "" : ": " + absent->reason);
  }
  return said;
}

}  // namespace

FigureSet figures_of(const StudyView& study, const Grouping& grouping) {
  auto set = Figures(study, grouping).all();
  if (study.analysis) {
    set.figures.insert(set.figures.begin(), study.analysis->figures.begin(), study.analysis->figures.end());
  }
  return set;
}

std::string write_figures(const StudyView& study) {
  const bool alone = study.analysis && study.analysis->alone;
  const auto grouping = group(study);
  const FigureSet set = alone ? FigureSet{study.analysis->figures, {}} : figures_of(study, grouping);
  const FigureSet timed{study.analysis ? study.analysis->timed.figures : std::vector<Figure>(), {}};
  auto said = draw_figures(set, study.folder, "figures");
  if (study.analysis) {
    const auto said_of_timed = draw_figures(timed, study.folder, timings_folder);
    if (said.empty()) said = said_of_timed;
  }
  const auto missing = words_of_missing(study, set, timed);
  return said + (said.empty() || missing.empty() ? "" : "; ") + missing;
}

RedrawnFigures redraw_figures(const StudyView& study) {
  const FigureSet set = figures_of(study, group(study));
  RedrawnFigures redrawn;
  for (const Figure& figure : set.figures) redrawn.names.push_back(figure.name);
  redrawn.said = draw_figures(set, study.folder, "figures", Others::keep) + words_of_missing(study, set, {});
  if (!study.figure_choice.names.empty()) return redrawn;
  for (std::string& name : figures_in(study.folder / "figures")) {
    if (std::find(redrawn.names.begin(), redrawn.names.end(), name) == redrawn.names.end())
      redrawn.others.push_back(std::move(name));
  }
  return redrawn;
}

}  // namespace polhode::study::report::figures
