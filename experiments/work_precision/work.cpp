// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/work_precision/work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/curves/work.hpp"
#include "experiments/study/report/answer/answer.hpp"
#include "experiments/study/report/figures/work_figure.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::work_precision {
namespace {

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
  Work(const Grouping& grouping, const RunCost& cost)
      : grouping_(grouping), cost_(cost), motions_(work_of_motions(grouping, cost)) {}

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
    return work_figure(grouping_, motions_, cost_, {.name = name, .title = title, .caption = caption});
  }

 private:
  std::string label(const MotionWork& motion, std::size_t i) const { return grouping_.label(*motion.curves[i]); }

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
  const Work by_evaluations(grouping, cost_in_right_hand_sides()), by_time(grouping, cost_in_time());
  found.answer = answer_of(study, grouping);
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
