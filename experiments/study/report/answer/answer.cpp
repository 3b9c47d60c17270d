// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/answer/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "experiments/study/curves/work.hpp"
#include "experiments/study/report/findings/method_table.hpp"
#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline report::inline answer {
namespace {

constexpr std::size_t most_rows = 5;  // number of rows with which text, table and figure fit on a screen
constexpr double tie = 1.2;           // largest ratio of two costs that count as equal
constexpr double far_off = 10;        // an error so many times the target is far from it
/// Decades of the error for which an answer is given, the most usual first.
constexpr std::array decades = {-3, -2, -4, -1, -5, -6, -7, -8, -9, -10};

/// A curve that reaches the target.
struct Candidate {
  const Curve* curve = nullptr;
  const RunRecord* run = nullptr;  ///< its cheapest run with an error not above the target
  double cost = 0;                 ///< cost of the target, interpolated between two runs
  bool at_most = false;            ///< larger steps may reach the target too: the cost is that of the run
};

/// The curves of a motion that reach the target, the cheapest first.
struct Ranked {
  const MotionWork* motion = nullptr;
  std::vector<Candidate> candidates;
  /// The costs for the target are known. If not, some method may reach it with larger steps at any lower cost: the
  /// order is that of the runs.
  bool decided = false;
};

std::optional<Candidate> candidate_of(const Curve& curve, const Quantity& quantity,
                                      const std::vector<WorkPoint>& points, double target) {
  Candidate candidate{&curve, nullptr, 0, true};
  double least = std::numeric_limits<double>::infinity();  // least cost of its runs that follow the motion
  for (const WorkPoint& point : points) {
    least = std::min(least, point.cost);
    // The error as measured: a point is not better than its rounding, which a run may be by chance.
    if (!(value(*point.run, quantity) <= target) || (candidate.run && candidate.cost <= point.cost)) continue;
    candidate.run = point.run;
    candidate.cost = point.cost;
  }
  if (!candidate.run) return std::nullopt;
  const auto between = cost_to_reach(target, points);
  if (between && *between < candidate.cost && candidate.cost > least) {
    candidate.cost = *between;
    candidate.at_most = false;
  }
  return candidate;
}

Ranked ranked(const MotionWork& motion, double target) {
  Ranked found{&motion, {}, true};
  for (std::size_t i = 0; i < motion.curves.size(); ++i) {
    const auto candidate = candidate_of(*motion.curves[i], motion.quantity, motion.points[i], target);
    if (!candidate) continue;
    found.candidates.push_back(*candidate);
    found.decided = found.decided && !candidate->at_most;
  }
  found.decided = found.decided && !found.candidates.empty();
  std::stable_sort(found.candidates.begin(), found.candidates.end(), [&](const Candidate& a, const Candidate& b) {
    return found.decided ? a.cost < b.cost : a.run->result.evaluations < b.run->result.evaluations;
  });
  return found;
}

/// The decade at which the most motions are decided; of several the one that the most motions reach, of these the most
/// usual one. Absent if none is reached.
std::optional<int> best_decade(const std::vector<MotionWork>& motions) {
  std::optional<int> best;
  std::pair<std::size_t, std::size_t> most{};  // decided, reached
  for (const int decade : decades) {
    std::pair<std::size_t, std::size_t> found{};
    for (const MotionWork& motion : motions) {
      const Ranked at = ranked(motion, std::pow(10.0, decade));
      found.first += at.decided;
      found.second += !at.candidates.empty();
    }
    if (found > most) most = found, best = decade;
  }
  return best;
}

class General {
 public:
  General(const StudyView& study, const Grouping& grouping)
      : study_(study), grouping_(grouping), motions_(work_of_motions(grouping, cost_)) {}

  Answer answer() {
    if (study_.size() == 1) return one_run();
    if (std::none_of(study_.runs.begin(), study_.runs.end(), [](const auto& run) { return completed(run); })) {
      answer_.sentences.push_back("No run came to its end, so that the study recommends no method.");
      return std::move(answer_);
    }
    if (motions_.empty()) return without_errors();
    if (const auto decade = best_decade(motions_)) {
      target_ = std::pow(10.0, *decade);
      target_text_ = fmt::format("1e{}", *decade);
      for (const MotionWork& motion : motions_) ranked_.push_back(ranked(motion, target_));
      if (motions_.size() == 1) one_motion();
      else several_motions();
    } else {
      none_reaches();
    }
    dependencies();
    return std::move(answer_);
  }

 private:
  std::string error_words(const MotionWork& motion) const {
    return fmt::format("{} of at most {}{}", motion.quantity.unit == " rad" ? "an attitude error" : "a position error",
                       target_text_, motion.quantity.unit);
  }

  /// A count to three digits: "1100".
  static std::string rounded_count(double n) {
    const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(n)) - 2));
    return fmt::format("{:.0f}", std::round(n / unit) * unit);
  }

  std::string label(const Curve& curve) const { return grouping_.label(curve); }
  std::string motion_label(const MotionWork& motion) const { return grouping_.cases[motion.case_index].label(); }

  std::string error_of(const RunRecord& run, const MotionWork& motion) const {
    return printed(run, motion.quantity) + motion.quantity.unit;
  }

  /// True if the printed ratio of two costs is at most `tie`.
  static bool ties(const Candidate& first, const Candidate& next) {
    return std::round(100 * next.cost / first.cost) <= std::round(100 * tie);
  }

  /// "1.4 times as many": how much dearer the next one is.
  std::string times(const Candidate& first, const Candidate& next) const {
    return fmt::format("{} times as many", number(next.cost / first.cost));
  }

  /// One run is no comparison: the answer is how far it is off.
  Answer one_run() {
    const RunRecord& run = study_.runs.front();
    const Curve& curve = grouping_.curves.front();
    const std::string label = run_label(grouping_, curve, run);
    if (!completed(run)) {
      answer_.sentences.push_back(fmt::format("{} did not come to its end: {}.", label, one_line(run.result.message)));
      return std::move(answer_);
    }
    std::vector<std::string> errors;
    for (const auto& [quantity, what] :
         {std::pair(quantity::attitude_error(), "attitude"), std::pair(quantity::position_error(), "position")}) {
      if (const auto error = value(run, quantity))
        errors.push_back(fmt::format("the {} {}by at most {}{}", what, errors.empty() ? "is off " : "", number(*error),
                                     quantity.unit));
    }
    const std::string where = fmt::format("On {} over {} s", run.config.scenario, exact_number(run.config.t_end));
    if (!errors.empty()) answer_.sentences.push_back(fmt::format("{} {} with {}.", where, words(errors), label));
    else
      answer_.sentences.push_back(
          fmt::format("{} these data do not tell how far {} is off: no exact motion is known{}.", where, label,
                      run.config.contact || run.config.reference ? "" : "; --reference makes one to compare with"));
    if (const auto drift = value(run, quantity::energy_drift()))
      answer_.sentences.push_back(*drift <= round_off_level(run, quantity::energy_drift())
                                      ? fmt::format("The energy is kept to round-off (a drift of {}).", number(*drift))
                                      : fmt::format("The energy drifts by up to {} of its scale.", number(*drift)));
    answer_.sentences.push_back(fmt::format(
        "Which method is the cheapest, several runs tell: ./run energy_drift --scenario {}.", run.config.scenario));
    return std::move(answer_);
  }

  Answer without_errors() {
    const bool measured = std::any_of(grouping_.curves.begin(), grouping_.curves.end(), [](const Curve& curve) {
      return is_measured(curve, quantity::attitude_error()) || is_measured(curve, quantity::position_error());
    });
    if (measured) {
      answer_.sentences.emplace_back(
          "These runs do not rank the methods: each has errors of rounding alone, or evaluates no right-hand sides.");
      return std::move(answer_);
    }
    const std::string names = words(first_items(names_of_scenarios(), 3));
    answer_.sentences.push_back(
        fmt::format("These runs do not tell which method is right: no exact motion of {} is known.", names));
    const bool contact = std::any_of(study_.runs.begin(), study_.runs.end(),
                                     [](const RunRecord& run) { return run.config.contact.has_value(); });
    const bool asked =
        std::any_of(study_.runs.begin(), study_.runs.end(), [](const RunRecord& run) { return run.config.reference; });
    if (contact)
      answer_.sentences.push_back("With contact no reference motion can be made: what becomes of the energy is below.");
    else if (asked)
      answer_.sentences.push_back(
          "The reference that --reference made proves too few digits for an error to be measured.");
    else
      answer_.sentences.push_back("The same command with --reference measures the errors against a reference motion.");
    return std::move(answer_);
  }

  std::vector<std::string> names_of_scenarios() const {
    std::vector<std::string> names;
    for (const Scenario& scenario : study_.scenarios) names.push_back(scenario.name);
    return names;
  }

  void none_reaches() {
    const bool one = motions_.size() == 1;
    answer_.sentences.push_back(
        fmt::format("No run follows {} well enough to be recommended: none has an error of at most 0.1{}.",
                    one ? motion_label(motions_.front()) : "any of the motions",
                    one ? motions_.front().quantity.unit : " rad (or m, where no attitude is compared)"));
    answer_.sentences.push_back("Smaller steps or tolerances would decide.");
  }

  void one_motion() {
    const MotionWork& motion = motions_.front();
    const Ranked& of = ranked_.front();
    const Candidate& first = of.candidates.front();
    const RunRecord& run = *first.run;
    const std::string target = fmt::format("For {} over {} s", error_words(motion), exact_number(run.config.t_end));
    if (of.decided)
      answer_.sentences.push_back(
          fmt::format("{}, {} needs the fewest right-hand sides, about {}; {} has an error of {}.", target,
                      label(*first.curve), rounded_count(first.cost), step_label(run), error_of(run, motion)));
    else
      answer_.sentences.push_back(
          fmt::format("{}, the cheapest of these runs is {} at {}, with {} right-hand sides and an error of {}.",
                      target, label(*first.curve), step_label(run), run.result.evaluations, error_of(run, motion)));
    answer_.sentences.push_back(of.decided ? runner_up(of.candidates) : what_would_decide(of.candidates));
    if (auto text = exact_methods(motion); !text.empty()) answer_.sentences.push_back(std::move(text));
    else if (text = energy_alone(motion); !text.empty()) answer_.sentences.push_back(std::move(text));
    table_of_methods(of);
  }

  std::string runner_up(const std::vector<Candidate>& candidates) const {
    if (candidates.size() == 1) {
      return grouping_.curves.size() == 1 ? "It is the only method of the study."
                                          : "No other method that is compared comes as near.";
    }
    const Candidate &first = candidates[0], &next = candidates[1];
    if (ties(first, next)) return fmt::format("{} ties with it: {}.", label(*next.curve), times(first, next));
    return fmt::format("Next is {} with {}.", label(*next.curve), times(first, next));
  }

  /// The runs that would decide: those of methods whose cheapest run is better than the target.
  std::string what_would_decide(const std::vector<Candidate>& candidates) const {
    std::vector<std::string> names;
    bool fixed = false, adaptive = false;
    for (const Candidate& c : candidates) {
      if (!c.at_most) continue;
      names.push_back(label(*c.curve));
      (c.curve->adaptive ? adaptive : fixed) = true;
    }
    const char* runs = fixed && adaptive ? "Larger steps or looser tolerances"
                       : fixed           ? "Larger steps"
                                         : "Looser tolerances";
    return fmt::format(
        "{} of {} would decide which method is the cheapest: the largest {} follow{} the motion {} better "
        "than asked for.",
        runs, words(first_items(names, 4)), names.size() == 1 ? "that" : "ones that", names.size() == 1 ? "s" : "",
        names.size() == 1 ? "is" : "are");
  }

  /// The methods whose error is that of rounding: no approximation competes with them.
  std::string exact_methods(const MotionWork& motion) const {
    std::vector<std::string> names;
    for (const Curve* curve : motion.exact) names.push_back(label(*curve));
    if (names.empty()) return {};
    return fmt::format("Not among them: with {} the {} is exact up to rounding, at every step.",
                       words(first_items(names, 3)), motion.quantity.unit == " rad" ? "attitude" : "position");
  }

  /// A method that keeps the energy to round-off at all its steps, and whose error is far above the target.
  std::string energy_alone(const MotionWork& motion) const {
    const Quantity energy = quantity::energy_drift();
    const Curve* most = nullptr;
    double error = far_off * target_;
    for (const Curve& curve : grouping_.curves) {
      if (curve.case_index != motion.case_index || !curve.runs.front()->config.formulation.gyroscopic) continue;
      double largest = 0;
      const bool kept = std::all_of(curve.runs.begin(), curve.runs.end(), [&](const RunRecord* run) {
        const auto drift = value(*run, energy);
        largest = std::max(largest, value(*run, motion.quantity).value_or(0));
        return drift && *drift <= round_off_level(*run, energy);
      });
      if (kept && largest > error) error = largest, most = &curve;
    }
    if (!most) return {};
    return fmt::format(
        "{} keeps the energy to round-off, but its {} error is up to {}{}: a small drift does not show a "
        "right motion.",
        label(*most), motion.quantity.unit == " rad" ? "attitude" : "position", number(error), motion.quantity.unit);
  }

  void several_motions() {
    std::map<std::string, std::size_t> wins;
    std::size_t decided = 0, undecided = 0, tied = 0;
    for (const Ranked& of : ranked_) {
      undecided += !of.decided && !of.candidates.empty();
      if (!of.decided) continue;
      ++decided;
      ++wins[label(*of.candidates.front().curve)];
      tied += of.candidates.size() > 1 && ties(of.candidates[0], of.candidates[1]);
    }
    std::vector<std::pair<std::string, std::size_t>> order(wins.begin(), wins.end());
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    std::vector<std::string> parts;
    for (const auto& [method, n] : order) parts.push_back(fmt::format("{} on {}", method, n));
    const std::string target =
        fmt::format("For an error of at most {} (rad, or m where no attitude is compared)", target_text_);
    if (decided > 0)
      answer_.sentences.push_back(fmt::format("{}, the method with the fewest right-hand sides is {} of {} motions.",
                                              target, words(first_items(parts, 4)), ranked_.size()));
    std::vector<std::string> rest;
    if (tied > 0) rest.push_back(fmt::format("on {} of these the next method ties within 20 %", tied));
    if (undecided > 0)
      rest.push_back(
          fmt::format("on {} the cheapest runs are better than asked for, and larger steps or looser "
                      "tolerances would decide",
                      undecided));
    if (const std::size_t lost = ranked_.size() - decided - undecided; lost > 0)
      rest.push_back(fmt::format("on {} no run comes as near", lost));
    exact_of_several();
    if (rest.empty()) return table_of_motions();
    std::string text = fmt::format("{}", fmt::join(rest, "; "));
    if (decided > 0) text.front() = 'O';
    else text = target + ", " + text;
    answer_.sentences.push_back(text + ".");
    table_of_motions();
  }

  void exact_of_several() {
    std::map<std::string, std::size_t> exact;
    for (const MotionWork& motion : motions_) {
      for (const Curve* curve : motion.exact) ++exact[label(*curve)];
    }
    std::vector<std::string> parts;
    for (const auto& [method, n] : exact) parts.push_back(fmt::format("{} on {}", method, n));
    if (!parts.empty())
      answer_.depends.push_back(
          fmt::format("Not compared, since exact up to rounding at every step: {}.", words(first_items(parts, 4))));
  }

  static std::string conserved(const RunRecord& run) {
    const IntegratorEntry* entry = find_integrator(run.config.integrator);
    if (!entry) return {};
    const Declaration& d = entry->declaration;
    std::vector<std::string> all;
    if (d.conserves_energy) all.emplace_back("energy");
    if (d.conserves_momentum) all.emplace_back("momentum");
    if (d.conserves_casimir) all.emplace_back("Casimir");
    if (d.symplectic) all.emplace_back("symplectic");
    return fmt::format("{}", fmt::join(all, ", "));
  }

  void table_of_methods(const Ranked& of) {
    using Kind = Column::Kind;
    const MotionWork& motion = *of.motion;
    Table table{
        .caption = fmt::format("The cheapest run of each method with an error of at most {}{}, and its right-hand "
                               "sides for just that error, read between two runs",
                               target_text_, motion.quantity.unit),
        .columns = {{"method", "", Kind::name},
                    {"step or tolerance", "", Kind::text},
                    {"error", std::string(motion.quantity.unit.substr(1))},
                    {"right-hand sides"},
                    {"for that error"},
                    {"times as many"},
                    {"energy drift"},
                    {"energy", "", Kind::text},
                    {"conserves, for a free body", "", Kind::text}},
        .rows = {}};
    for (const Candidate& c : of.candidates) {
      if (table.rows.size() == most_rows) break;
      table.rows.push_back({label(*c.curve), step_label(*c.run), printed(*c.run, motion.quantity),
                            std::to_string(c.run->result.evaluations), (c.at_most ? "≤ " : "") + rounded_count(c.cost),
                            of.decided ? number(c.cost / of.candidates.front().cost) : std::string(),
                            printed(*c.run, quantity::energy_drift()), energy_trend(*c.run), conserved(*c.run)});
    }
    if (of.candidates.size() > most_rows)
      table.caption += fmt::format(". Not shown: {}", count(of.candidates.size() - most_rows, "method"));
    answer_.table = without_empty_columns(std::move(table));
  }

  void table_of_motions() {
    using Kind = Column::Kind;
    Table table{
        .caption = fmt::format("For each motion the cheapest run of the cheapest method with an error of at most {}",
                               target_text_),
        .columns = {{"motion", "", Kind::name},
                    {"method", "", Kind::text},
                    {"step or tolerance", "", Kind::text},
                    {"error", "rad or m"},
                    {"right-hand sides"},
                    {"energy drift"},
                    {"next", "", Kind::text},
                    {"times as many"}},
        .rows = {}};
    std::size_t reached = 0;
    for (const Ranked& of : ranked_) {
      if (of.candidates.empty()) continue;
      if (++reached > most_rows) continue;
      const Candidate& first = of.candidates.front();
      const bool next = of.candidates.size() > 1;
      table.rows.push_back({motion_label(*of.motion), label(*first.curve), step_label(*first.run),
                            printed(*first.run, of.motion->quantity), std::to_string(first.run->result.evaluations),
                            printed(*first.run, quantity::energy_drift()), next ? label(*of.candidates[1].curve) : "",
                            next && of.decided ? number(of.candidates[1].cost / first.cost) : ""});
    }
    if (reached > most_rows) table.caption += fmt::format("; the first {} of {} motions", most_rows, reached);
    answer_.table = without_empty_columns(std::move(table));
  }

  /// Largest ratio of neighbouring steps of a curve.
  double coarsest_ladder() const {
    double most = 1;
    for (const MotionWork& motion : motions_) {
      for (const Curve* curve : motion.curves) {
        for (std::size_t k = 1; k < curve->runs.size() && !curve->adaptive; ++k) {
          const auto larger = abscissa(*curve->runs[k - 1]), smaller = abscissa(*curve->runs[k]);
          if (larger && smaller && *smaller > 0) most = std::max(most, *larger / *smaller);
        }
      }
    }
    return most;
  }

  void dependencies() {
    answer_.depends.emplace_back("It holds for the scenario, the duration and the formulation of these runs.");
    const bool both = std::any_of(motions_.begin(), motions_.end(), [&](const MotionWork& motion) {
      return motion.quantity.unit == " rad" &&
             std::any_of(motion.curves.begin(), motion.curves.end(),
                         [](const auto* c) { return is_measured(*c, quantity::position_error()); });
    });
    if (both)
      answer_.depends.emplace_back("The error is that of the attitude; the figures show that of the position too.");
    answer_.depends.push_back(
        "The cost counts evaluations of the right-hand side, not the equations that an implicit "
        "method solves in a step, and not time.");
    if (const double ladder = coarsest_ladder(); ladder > 1)
      answer_.depends.push_back(
          fmt::format("Neighbouring steps of these runs are up to {} times apart.", number(ladder, 2)));
    std::set<std::string> without;
    for (const MotionWork& motion : motions_) {
      for (const Curve* curve : motion.without) without.insert(grouping_.methods[curve->method_index]);
    }
    if (!without.empty())
      answer_.depends.push_back(fmt::format(
          "{} {} no right-hand sides and {} not among the compared.", words({without.begin(), without.end()}),
          without.size() == 1 ? "evaluates" : "evaluate", without.size() == 1 ? "is" : "are"));
  }

  const StudyView& study_;
  const Grouping& grouping_;
  RunCost cost_ = cost_in_right_hand_sides();
  std::vector<MotionWork> motions_;
  double target_ = 0;
  std::string target_text_;
  std::vector<Ranked> ranked_;
  Answer answer_;
};

}  // namespace

Answer answer_of(const StudyView& study, const Grouping& grouping) { return General(study, grouping).answer(); }

}  // namespace polhode::study::report::answer
