// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/report/findings/drift_words.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::judge {
namespace {

using Kind = Column::Kind;
using Value = std::optional<double>;

std::string printed(const Value& x) { return x && std::isfinite(*x) ? number(*x) : ""; }

Table table_of(const StudyView& study, const std::vector<Judged>& judged) {
  std::vector<const Metric*> metrics = in_table_order(study.metrics);
  std::erase_if(metrics, [](const Metric* metric) { return metric->judge_label.empty(); });
  Table table{.caption = "Each trajectory beside the exact motion, or the reference",
              .columns = {{"trajectory", "", Kind::name},
                          {"instants"},
                          {"status", "", Kind::text},
                          {"diagnosis", "", Kind::text}},
              .rows = {}};
  for (const Metric* metric : metrics) {
    table.columns.push_back({metric->judge_label, metric->unit, is_text(*metric) ? Kind::text : Kind::number});
  }
  table.columns.push_back({"its own energy differs", "relative"});
  for (const Judged& one : judged) {
    const TrajectoryScore& s = one.score;
    const RunResult& r = s.record.result;
    auto& row = table.rows.emplace_back();
    row = {s.record.config.integrator, std::to_string(s.instants), r.status, one.diagnosis.name};
    for (const Metric* metric : metrics) {
      const bool is_exponent = metric->column == "drift_exponent" && r.drift_exponent;  // digits as in its interval
      row.push_back(is_exponent ? fmt::format("{:.3f}", *r.drift_exponent) : table_cell(*metric, r));
    }
    row.push_back(printed(s.energy_column_difference_max_rel));
  }
  return without_empty_columns(std::move(table));
}

std::string csv_of(const StudyView& study, const std::vector<Judged>& judged) {
  std::vector<const Metric*> measured, references;
  for (const Metric& metric : study.metrics) {
    if (!metric.in_scores || metric.runs == Metric::Runs::with_contact) continue;
    (metric.runs == Metric::Runs::with_reference ? references : measured).push_back(&metric);
  }
  const auto add = [](std::vector<std::string>& row, const std::vector<std::string>& cells) {
    row.insert(row.end(), cells.begin(), cells.end());
  };
  std::vector<std::string> header = {"trajectory", "scenario",         "status",           "message",
                                     "instants",   "t_first_s",        "t_last_s",         "spacing_max_s",
                                     "diagnosis",  "diagnosis_factor", "diagnosis_margin", "polhode_pace"};
  for (const Metric* metric : measured) add(header, csv_columns(*metric, study.invariants));
  header.emplace_back("energy_column_difference_max_rel");
  for (const Metric* metric : references) add(header, csv_columns(*metric, study.invariants));
  header.emplace_back("notes");
  std::string text = csv_row(header);
  for (const Judged& one : judged) {
    const TrajectoryScore& s = one.score;
    const RunResult& r = s.record.result;
    CsvRow row(text);
    for (const std::string& cell :
         {s.record.config.integrator, s.record.config.scenario, r.status, r.message, std::to_string(s.instants),
          exact(s.t_first), exact(s.record.config.t_end), csv_cell(s.record.config.dt), one.diagnosis.name,
          csv_cell(one.diagnosis.factor), csv_cell(one.diagnosis.margin), polhode_pace(s)})
      row.add(cell);
    for (const Metric* metric : measured) add_csv_cells(row, *metric, r, study.invariants);
    row.add(s.energy_column_difference_max_rel);
    for (const Metric* metric : references) add_csv_cells(row, *metric, r, study.invariants);
    row.add(fmt::format("{}", fmt::join(s.notes, "; ")));
    row.end();
  }
  return text;
}

struct ErrorQuantity {
  const char *column, *axis;
  Value ErrorPoint::*member;
};

/// One panel for each kind of error that was measured.
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

/// "the attitude is off by at most 0.02 rad and the position by at most 1e-3 m"; empty without an error.
std::string errors_of(const RunResult& r) {
  std::vector<std::string> parts;
  for (const auto& [error, what, unit] :
       {std::tuple(r.attitude_error_max, "attitude", "rad"), std::tuple(r.position_error_max, "position", "m")}) {
    if (error && std::isfinite(*error))
      parts.push_back(
          fmt::format("the {} {}by at most {} {}", what, parts.empty() ? "is off " : "", number(*error), unit));
  }
  return words(parts);
}

/// The cause that explains a trajectory best, in words.
std::string likeness(const Diagnosis& d) {
  if (d.name.empty())
    return "what it is like the rows do not tell" + (d.untried.empty() ? std::string() : ": " + d.untried);
  if (d.name == "none") return "it follows the scenario’s equations: no wrong equation or convention was found";
  if (d.name == "unexplained") return "no cause that was tried explains it";
  return fmt::format("most like it: {}", d.words);
}

/// The distances of the trajectories from the exact motion, the nearest trajectory, and the likeness of each.
Answer answer_of(const std::vector<Judged>& judged) {
  Answer answer;
  const std::string scenario = judged.front().score.record.config.scenario;
  const auto result = [](const Judged& one) -> const RunResult& { return one.score.record.result; };
  const auto error = [&](const Judged& one) -> Value {
    const Value& e = result(one).attitude_error_max ? result(one).attitude_error_max : result(one).position_error_max;
    return e && std::isfinite(*e) ? e : std::nullopt;
  };
  std::vector<const Judged*> order;
  for (const Judged& one : judged) {
    if (error(one)) order.push_back(&one);
  }
  // Errors of attitude and position have no order between them.
  const bool comparable = std::all_of(order.begin(), order.end(), [&](const Judged* one) {
    return result(*one).attitude_error_max.has_value() == result(*order.front()).attitude_error_max.has_value();
  });
  std::stable_sort(order.begin(), order.end(), [&](auto* a, auto* b) { return comparable && *error(*a) < *error(*b); });
  const auto name = [](const Judged& one) { return one.score.record.config.integrator; };
  const auto told = [&](const Judged& one) {
    return fmt::format("over {} s {}", rounded(one.score.record.config.t_end), errors_of(result(one)));
  };
  const bool reference = judged.front().score.record.config.reference;
  if (order.empty()) {
    answer.sentences.push_back(
        fmt::format("These rows do not tell how far {} from the motion of {}: {}.",
                    judged.size() == 1 ? name(judged.front()) + " is" : "the trajectories are", scenario,
                    reference ? "the reference proves too few digits"
                              : "no exact motion of it is known, and --reference makes one to compare with"));
  } else if (judged.size() == 1) {
    answer.sentences.push_back(fmt::format("{} on {}: {}.", name(*order[0]), scenario, told(*order[0])));
  } else if (comparable && order.size() > 1) {
    const std::string ratio =
        *error(*order[0]) > 0 ? fmt::format(" ({} times as far)", number(*error(*order[1]) / *error(*order[0]))) : "";
    answer.sentences.push_back(fmt::format("Of {} trajectories of {} the nearest is {}: {}; next is {}{}.",
                                           judged.size(), scenario, name(*order[0]), told(*order[0]), name(*order[1]),
                                           ratio));
  } else {
    answer.sentences.push_back(fmt::format("Of {} trajectories of {} only some can be compared; of {}: {}.",
                                           judged.size(), scenario, name(*order[0]), told(*order[0])));
  }
  std::vector<std::string> likenesses;
  for (const Judged& one : judged)
    likenesses.push_back(judged.size() == 1 ? likeness(one.diagnosis)
                                            : fmt::format("{}: {}", name(one), likeness(one.diagnosis)));
  std::string text = fmt::format("{}", fmt::join(first_items(likenesses, 3), "; "));
  if (judged.size() == 1 && text.front() >= 'a' && text.front() <= 'z') text.front() = char(text.front() - 'a' + 'A');
  answer.sentences.push_back(text + ".");
  if (const auto& drift = result(judged.front()).energy_drift_max_rel; judged.size() == 1 && drift)
    answer.sentences.push_back(fmt::format("Its energy drifts by up to {} of its scale.", number(*drift)));
  answer.depends = {
      "Errors are measured at the instants of the rows, against the motion that starts as the scenario says.",
      "A cause is named if the motion that it gives fits ten times better than the scenario’s own; causes "
      "that were not tried are not named."};
  return answer;
}

}  // namespace

Analysis judgement(const StudyView& study, const std::vector<Judged>& judged) {
  Analysis analysis{.answer = answer_of(judged),
                    .heading = "Scores",
                    .sentences = sentences_of(judged),
                    .method = {"Energy, momenta and invariants are computed from the states in the file with the "
                               "scenario's inertia and forces; drifts are against the first row, errors against the "
                               "motion that starts as the scenario says. What is called dt on this page is the largest "
                               "spacing of the rows."},
                    .tables = {{"scores", table_of(study, judged)}},
                    .files = {{"scores.csv", csv_of(study, judged)}}};
  if (Figure figure = errors_against_time(study, judged); !figure.panels.empty()) {
    analysis.figures.push_back(std::move(figure));
  }
  return analysis;
}

}  // namespace polhode::study::judge
