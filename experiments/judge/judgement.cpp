// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/report/findings/drift_words.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study {
namespace {

using namespace report;
using Kind = Column::Kind;
using Value = std::optional<double>;

std::string printed(const Value& x) { return x && std::isfinite(*x) ? number(*x) : ""; }

Table table_of(const std::vector<Judged>& judged) {
  Table table{.caption = "Each trajectory beside the exact motion, or the reference",
              .columns = {{"trajectory", "", Kind::name},
                          {"instants"},
                          {"status", "", Kind::text},
                          {"diagnosis", "", Kind::text},
                          {"energy drift", "relative"},
                          {"drift rate", "W"},
                          {"±", "W"},
                          {"its class", "", Kind::text},
                          {"p"},
                          {"95 %", "", Kind::text},
                          {"linear momentum", "relative"},
                          {"angular momentum", "relative"},
                          {"orientation defect", "1"},
                          {"position error", "m"},
                          {"attitude error", "rad"},
                          {"angular velocity error", "relative"},
                          {"along the polhode", "s"},
                          {"off it", "relative"},
                          {"its own energy differs", "relative"}},
              .rows = {}};
  for (const Judged& one : judged) {
    const TrajectoryScore& s = one.score;
    const RunResult& r = s.record.result;
    table.rows.push_back(
        {s.record.config.integrator, std::to_string(s.instants), r.status, one.diagnosis.name,
         printed(r.energy_drift_max_rel), printed(r.energy_drift_rate), printed(r.energy_drift_rate_ci), r.drift_class,
         r.drift_exponent ? fmt::format("{:.3f}", *r.drift_exponent) : "", exponent_interval(r),
         printed(r.linear_momentum_drift_max_rel), printed(r.angular_momentum_drift_max_rel),
         printed(r.orientation_defect_max), printed(r.position_error_max), printed(r.attitude_error_max),
         printed(r.angular_velocity_error_max_rel), printed(r.polhode_phase_error_max),
         printed(r.polhode_off_error_max_rel), printed(s.energy_column_difference_max_rel)});
  }
  return without_empty_columns(std::move(table));
}

std::string csv_of(const StudyView& study, const std::vector<Judged>& judged) {
  std::vector<std::string> header = {"trajectory",
                                     "scenario",
                                     "status",
                                     "message",
                                     "instants",
                                     "t_first_s",
                                     "t_last_s",
                                     "spacing_max_s",
                                     "diagnosis",
                                     "diagnosis_factor",
                                     "diagnosis_margin",
                                     "polhode_pace",
                                     "energy_initial_J",
                                     "energy_drift_max_rel",
                                     "energy_drift_final_rel",
                                     "energy_drift_rate_W",
                                     "drift_class",
                                     "energy_drift_rate_ci_W",
                                     "drift_exponent",
                                     "drift_exponent_low",
                                     "drift_exponent_high",
                                     "linear_momentum_drift_max_rel",
                                     "angular_momentum_drift_max_rel"};
  for (const std::string& invariant : study.invariants) header.push_back(invariant + "_drift_max_rel");
  for (const char* c : {"orientation_defect_max", "position_error_max_m", "attitude_error_max_rad",
                        "angular_velocity_error_max_rel", "polhode_phase_error_max_s", "polhode_phase_error_max_rad",
                        "polhode_off_error_max_rel", "energy_column_difference_max_rel", "position_reference_m",
                        "attitude_reference_rad", "angular_velocity_reference_rel", "notes"}) {
    header.emplace_back(c);
  }
  std::string text = csv_row(header);
  for (const Judged& one : judged) {
    const TrajectoryScore& s = one.score;
    const RunResult& r = s.record.result;
    std::vector<std::string> row = {s.record.config.integrator,
                                    s.record.config.scenario,
                                    r.status,
                                    r.message,
                                    std::to_string(s.instants),
                                    study::exact(s.t_first),
                                    study::exact(s.record.config.t_end),
                                    csv_cell(s.record.config.dt),
                                    one.diagnosis.name,
                                    csv_cell(one.diagnosis.factor),
                                    csv_cell(one.diagnosis.margin),
                                    polhode_pace(s),
                                    csv_cell(r.energy_initial),
                                    csv_cell(r.energy_drift_max_rel),
                                    csv_cell(r.energy_drift_final_rel),
                                    csv_cell(r.energy_drift_rate),
                                    r.drift_class,
                                    csv_cell(r.energy_drift_rate_ci),
                                    csv_cell(r.drift_exponent),
                                    csv_cell(r.drift_exponent_low),
                                    csv_cell(r.drift_exponent_high),
                                    csv_cell(r.linear_momentum_drift_max_rel),
                                    csv_cell(r.angular_momentum_drift_max_rel)};
    for (const std::string& invariant : study.invariants) {
      const auto found = r.invariant_drift_max_rel.find(invariant);
      row.push_back(found == r.invariant_drift_max_rel.end() ? "" : study::exact(found->second));
    }
    for (const Value& x : {r.orientation_defect_max, r.position_error_max, r.attitude_error_max,
                           r.angular_velocity_error_max_rel, r.polhode_phase_error_max, r.polhode_phase_error_max_rad,
                           r.polhode_off_error_max_rel, s.energy_column_difference_max_rel, r.position_reference,
                           r.attitude_reference, r.angular_velocity_reference_rel}) {
      row.push_back(x && std::isfinite(*x) ? study::exact(*x) : "");
    }
    row.push_back(fmt::format("{}", fmt::join(s.notes, "; ")));
    text += csv_row(row);
  }
  return text;
}

struct ErrorQuantity {
  const char *column, *axis;
  Value ErrorPoint::*member;
};

/// One panel for each kind of error that is known, signed where it has a sign.
Figure errors_against_time(const StudyView& study, const std::vector<Judged>& judged) {
  Figure figure{.name = "errors_against_time",
                .title = "Errors against time",
                .caption =
                    "The distance of each trajectory from the exact motion, or the reference, at up to 257 of its "
                    "instants. The axes are logarithmic on both sides of zero and linear about it."};
  std::vector<Panel> panels;
  for (const ErrorQuantity& q :
       {ErrorQuantity{"attitude_error_rad", "attitude error (rad)", &ErrorPoint::attitude},
        ErrorQuantity{"position_error_m", "position error (m)", &ErrorPoint::position},
        ErrorQuantity{"angular_velocity_error_rel", "angular velocity error (relative)", &ErrorPoint::angular_velocity},
        ErrorQuantity{"polhode_phase_s", "ahead along the polhode (s)", &ErrorPoint::phase},
        ErrorQuantity{"polhode_off_rel", "off the polhode (relative)", &ErrorPoint::off}}) {
    Panel panel{.x_column = "t_s", .y_column = q.column};
    double low = 0, high = 0, quietest = std::numeric_limits<double>::infinity(), end = 0;
    for (std::size_t i = 0; i < judged.size(); ++i) {
      PlottedCurve curve{.label = judged[i].score.record.config.integrator, .method = i};
      double largest = 0;
      for (const ErrorPoint& p : judged[i].score.errors) {
        const Value& y = p.*q.member;
        if (!y || !std::isfinite(*y)) continue;
        curve.points.push_back({p.t, *y, 0, Mark::value});
        low = std::min(low, *y);
        high = std::max(high, *y);
        largest = std::max(largest, std::abs(*y));
        end = std::max(end, p.t);
      }
      if (largest > 0) quietest = std::min(quietest, largest);
      if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
    }
    if (panel.curves.empty() || (low == 0 && high == 0)) continue;
    panel.x = time_axis(end);
    std::vector<Panel> alone = {std::move(panel)};
    share_y_axis(alone, symlog_axis(q.axis, low, high, std::isfinite(quietest) ? quietest : 0));
    panels.push_back(std::move(alone.front()));
  }
  add_rows(figure, std::move(panels), 2);
  for (Panel& panel : figure.panels) panel.y.labelled = true;  // each has its own axis
  for (const RunRecord& run : study.runs) figure.methods.push_back(run.config.integrator);
  figure.variants = {""};
  note_marks(figure);
  figure.caption += marks_caption(figure);
  return figure;
}

std::vector<std::string> sentences_of(const std::vector<Judged>& judged) {
  std::vector<std::string> sentences;
  constexpr double same = 1e-9;
  for (const Judged& one : judged) sentences.push_back(first_line(one));
  for (const Judged& one : judged) {
    const TrajectoryScore& s = one.score;
    const RunResult& r = s.record.result;
    const std::string& name = s.record.config.integrator;
    if (!r.message.empty()) sentences.push_back(fmt::format("{}: {}.", name, r.message));
    if (!r.drift_class.empty()) sentences.push_back(fmt::format("{}: the energy drift is {}.", name, growth_words(r)));
    if (s.energy_column_difference_max_rel > same) {
      sentences.push_back(
          fmt::format("{}: its own energy differs from that of its states by up to {} of the energy; the "
                      "scores are those of its states.",
                      name, number(*s.energy_column_difference_max_rel)));
    }
    for (const std::string& note : s.notes) sentences.push_back(fmt::format("{}: {}.", name, note));
  }
  return sentences;
}

}  // namespace

Analysis judgement(const StudyView& study, const std::vector<Judged>& judged) {
  Analysis analysis{.heading = "Scores",
                    .sentences = sentences_of(judged),
                    .method = {"Energy, momenta and invariants are computed from the states in the file with the "
                               "scenario's inertia and forces; drifts are against the first row, errors against the "
                               "motion that starts as the scenario says. What is called dt on this page is the largest "
                               "spacing of the rows."},
                    .tables = {{"scores", table_of(judged)}},
                    .files = {{"scores.csv", csv_of(study, judged)}}};
  if (Figure figure = errors_against_time(study, judged); !figure.panels.empty()) {
    analysis.figures.push_back(std::move(figure));
  }
  return analysis;
}

}  // namespace polhode::study
