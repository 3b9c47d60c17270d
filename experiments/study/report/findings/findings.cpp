// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/findings/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "experiments/study/curves/declared_order.hpp"
#include "experiments/study/curves/error_ladder.hpp"
#include "experiments/study/curves/reference_words.hpp"
#include "experiments/study/report/findings/drift_words.hpp"
#include "experiments/study/report/findings/extremes.hpp"
#include "experiments/study/report/findings/gyroscopic.hpp"
#include "experiments/study/report/findings/method_table.hpp"
#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline report::inline findings {

namespace {

constexpr std::size_t few_runs = 3;              // largest number of runs described in a sentence each
constexpr std::size_t most_characters = 500;     // largest length of a sentence that names methods
constexpr std::size_t most_troubled_rows = 100;  // largest number of rows in the table of runs that did not finish

void append(std::vector<std::string>& all, std::vector<std::string> more) {
  for (auto& sentence : more) all.push_back(std::move(sentence));
}

std::string outcome(const StudyView& study) {
  std::map<std::string, std::size_t> counts = study.all_runs;
  if (counts.empty()) {
    for (const auto& run : study.runs) ++counts[run.result.status];
  }
  std::vector<std::string> parts;
  for (const auto& [status, text] : {std::pair("ok", "completed"), std::pair("diverged", "diverged"),
                                     std::pair("failed", "failed"), std::pair("refused", "refused")}) {
    if (counts[status] > 0) parts.push_back(fmt::format("{} {}", counts[status], text));
  }
  if (study.size() > 1 && counts["ok"] == study.size()) return fmt::format("{} runs, all completed.", study.size());
  return fmt::format("{}: {}.", count(study.size(), "run"), parts.empty() ? "none completed" : words(parts));
}

std::string drift_phrase(const RunRecord& run) {
  const auto drift = value(run, quantity::energy_drift());
  if (!drift) return "no energy drift was measured";
  std::string text = fmt::format("the largest energy drift is {}", number(*drift));
  if (run.result.energy_initial)
    text += fmt::format(" (of an initial energy of {} J)", number(*run.result.energy_initial, 6));
  const auto trend = energy_trend(run);
  if (trend == "gains" || trend == "loses") text += fmt::format("; the run {} energy", trend);
  if (trend == "comes back" && run.result.drift_class != "bounded")
    text += "; at the end the drift is back below a tenth of that";
  if (trend == "round-off") text += ", which is round-off";
  if (!run.result.drift_class.empty() && trend != "round-off")
    text += fmt::format("; the drift's class is {}", growth_words(run.result));
  return text;
}

/// Sentence about one run, for studies with few runs.
std::string run_sentence(const Grouping& grouping, const Curve& curve, const RunRecord& run) {
  const auto label = run_label(grouping, curve, run);
  if (!completed(run))
    return fmt::format("{}: {}.", label, run.result.message.empty() ? run.result.status : run.result.message);
  std::vector<std::string> parts = {drift_phrase(run)};
  for (const auto& quantity :
       {quantity::angular_momentum_drift(), quantity::linear_momentum_drift(), quantity::orientation_defect()}) {
    if (const auto found = value(run, quantity))
      parts.push_back(fmt::format("the {} is {}", quantity.words, number(*found)));
  }
  if (const auto found = value(run, quantity::attitude_error())) {
    parts.push_back(fmt::format(
        "the attitude is off the {} one by up to {} rad{}", run.result.attitude_reference ? "reference" : "exact",
        number(*found), follows(run, curve, quantity::attitude_error()) ? "" : ": the run does not follow the motion"));
  }
  if (const auto found = value(run, quantity::position_error())) {
    parts.push_back(fmt::format("the position by up to {} m", number(*found)));
  }
  parts.push_back(fmt::format("it took {} steps and {} evaluations of the right-hand side", run.result.steps,
                              run.result.evaluations));
  return fmt::format("{}: {}.", label, fmt::join(parts, "; "));
}

std::vector<std::string> run_sentences(const StudyView& study, const Grouping& grouping) {
  std::vector<std::string> sentences;
  if (study.runs.size() > few_runs) return sentences;
  for (const auto& curve : grouping.curves) {
    for (const auto* run : curve.runs) sentences.push_back(run_sentence(grouping, curve, *run));
  }
  return sentences;
}

constexpr std::array<std::pair<const char*, const char*>, 6> trend_words = {
    {{"gains", "gained"},
     {"loses", "lost"},
     {"gains or loses", "gained or lost, depending on the step,"},
     {"comes back",
      "neither gained nor lost for good (the drift is bounded, or back below a tenth of its largest value)"},
     {"undecided", "not told from an oscillation"},
     {"round-off", "kept to round-off"}}};

/// Trends of the energy: "Energy over the runs: gained by a and b; lost by c."; for many motions and formulations with
/// numbers of curves.
std::vector<std::string> trends(const Grouping& grouping) {
  std::map<std::string, std::vector<const Curve*>> by_trend;
  std::vector<const Curve*> all;
  for (const auto& curve : grouping.curves) {
    const auto trend = energy_trend(curve);
    if (trend.empty()) continue;
    by_trend[trend].push_back(&curve);
    all.push_back(&curve);
  }
  // Motions without any drift are described elsewhere.
  const auto quiet = quiet_cases(by_trend["round-off"], all);
  const auto is_quiet = [&](const auto* curve) { return quiet.contains(curve->case_index); };
  std::erase_if(all, is_quiet);
  std::vector<std::string> by_name, by_number;
  for (const auto& [trend, text] : trend_words) {
    auto curves = by_trend[trend];
    std::erase_if(curves, is_quiet);
    if (curves.empty()) continue;
    by_name.push_back(fmt::format("{} by {}", text, method_names(grouping, curves, all)));
    by_number.push_back(fmt::format("{} in {}", text, curves.size()));
  }
  if (by_name.empty()) return {};
  auto sentence = fmt::format("Energy over the runs: {}.", fmt::join(by_name, "; "));
  if (sentence.size() <= most_characters) return {sentence};
  return {fmt::format("Energy over the runs, of {}: {}. The table method by method says which.",
                      count(all.size(), "curve"), fmt::join(by_number, "; "))};
}

/// Name of a curve: "rk4 (matrix) on heavy_top".
std::string curve_label(const Grouping& grouping, const Curve& curve) {
  const auto label = grouping.label(curve);
  return grouping.cases.size() > 1 ? fmt::format("{} on {}", label, grouping.cases[curve.case_index].label()) : label;
}

/// The first few items, and the number of those left out.
std::string first_few(std::vector<std::string> items) {
  constexpr std::size_t most = 8;
  return words(first_items(std::move(items), most));
}

/// Sentences about methods whose quantity decreases more slowly than their order (or that there is none), and about
/// methods whose order the data do not determine.
std::vector<std::string> slope_sentences(const Grouping& grouping, const Quantity& quantity) {
  constexpr std::size_t wanted_runs = 3;
  std::vector<std::string> slower, sentences;
  std::map<std::string, std::vector<std::string>> not_told;  // curves by reason
  std::size_t compared = 0;
  for (const auto& curve : grouping.curves) {
    const auto& config = curve.runs.front()->config;
    const auto* entry = find_integrator(grouping.methods[curve.method_index]);
    // Without the gyroscopic term another equation is solved, and the error does not decrease with the step.
    if (curve.runs.size() < wanted_runs || curve.adaptive || !config.formulation.gyroscopic || entry == nullptr ||
        entry->declaration.order == 0 || !is_measured(curve, quantity))
      continue;
    const auto estimate = observed_order(curve, quantity);
    if (estimate.exact) continue;  // described elsewhere
    const auto line = told_line(estimate);
    if (!line) {
      not_told[why_not_told(curve, quantity, estimate)].push_back(curve_label(grouping, curve));
      continue;
    }
    const auto declared = declared_order(entry->declaration, *curve.runs.front(), quantity.unit == " rad");
    const auto verdict = order_verdict(estimate, declared);
    compared += verdict != OrderVerdict::scattered;
    if (verdict != OrderVerdict::lower) continue;
    slower.push_back(fmt::format("{} ({:.2f} over {} points, {})", curve_label(grouping, curve), line->order,
                                 estimate.points,
                                 declared ? fmt::format("declared order {}", number(*declared)) : "declared exact"));
  }
  if (!slower.empty()) {
    sentences.push_back(fmt::format("Against the step, the {} falls more slowly than the declared order for {}.",
                                    quantity.words, first_few(slower)));
  } else if (compared > 0) {
    sentences.push_back(fmt::format(
        "Against the step, the {} falls at least as fast as the declared order wherever a slope can be seen ({}).",
        quantity.words, count(compared, "curve")));
  }
  for (const auto& [reason, labels] : not_told) {
    sentences.push_back(
        fmt::format("The data do not tell the order of the {} of {}: {}.", quantity.words, first_few(labels), reason));
  }
  return sentences;
}

void add_extremes(Topic& topic, const Grouping& grouping, const Quantity& quantity) {
  auto found = extremes(grouping, quantity);
  append(topic.sentences, std::move(found.sentences));
  if (found.table) topic.tables.push_back(std::move(*found.table));
}

Topic energy(const StudyView& study, const Grouping& grouping) {
  Topic topic{.heading = "Energy", .sentences = run_sentences(study, grouping)};
  if (study.runs.size() > 1) {
    add_extremes(topic, grouping, quantity::energy_drift());
    append(topic.sentences, trends(grouping));
    append(topic.sentences, growth_sentences(study));
    append(topic.sentences, slope_sentences(grouping, quantity::energy_drift()));
  }
  return topic;
}

std::string force_kinds(const Scenario& scenario) {
  std::set<std::string> kinds;
  for (const auto& force : scenario.problem.forces) kinds.insert(force.kind);
  return words({kinds.begin(), kinds.end()});
}

/// Scenarios with completed runs none of which has a value of the quantity.
std::vector<std::string> undefined_in(const StudyView& study, const Quantity& quantity) {
  std::map<std::string, bool> defined;
  for (const auto& run : study.runs) {
    if (!completed(run)) continue;
    auto& seen = defined[run.config.scenario];
    seen = seen || value(run, quantity).has_value();
  }
  std::vector<std::string> names;
  for (const auto& [scenario, seen] : defined) {
    if (!seen) names.push_back(scenario);
  }
  return names;
}

std::vector<std::string> not_conserved(const StudyView& study, const Quantity& quantity, std::string_view momentum) {
  std::vector<std::string> sentences;
  for (const auto& name : undefined_in(study, quantity)) {
    const auto at =
        std::find_if(study.scenarios.begin(), study.scenarios.end(), [&](const auto& s) { return s.name == name; });
    const auto forces = at == study.scenarios.end() ? std::string() : force_kinds(*at);
    sentences.push_back(
        fmt::format("In {} the {} is no invariant: {} not conserve it, so it has no drift.", name, momentum,
                    forces.empty() ? "the forces or the pivot do" : fmt::format("the forces ({}) do", forces)));
  }
  return sentences;
}

Topic momenta(const StudyView& study, const Grouping& grouping) {
  Topic topic{.heading = study.invariants.empty() ? "Momenta" : "Momenta and further invariants", .sentences = {}};
  const auto angular = quantity::angular_momentum_drift(), linear = quantity::linear_momentum_drift();
  if (study.runs.size() > 1) add_extremes(topic, grouping, angular);
  append(topic.sentences, not_conserved(study, angular, "angular momentum"));
  if (study.runs.size() > 1) add_extremes(topic, grouping, linear);
  append(topic.sentences, not_conserved(study, linear, "linear momentum"));
  for (const auto& name : study.invariants) add_extremes(topic, grouping, quantity::invariant_drift(name));
  return topic;
}

Topic orientation(const StudyView& study, const Grouping& grouping) {
  Topic topic{.heading = "Orientation", .sentences = {}};
  if (study.runs.size() > 1) add_extremes(topic, grouping, quantity::orientation_defect());
  return topic;
}

Topic errors(const StudyView& study, const Grouping& grouping) {
  Topic topic{.heading = "Distance from the exact motion", .sentences = {}};
  for (const auto& quantity : {quantity::attitude_error(), quantity::position_error()}) {
    if (study.runs.size() > 1) add_extremes(topic, grouping, quantity);
    append(topic.sentences, slope_sentences(grouping, quantity));
  }
  append(topic.sentences, polhode_sentences(study));
  append(topic.sentences, reference_sentences(study));
  std::vector<std::string> without;
  const auto by_reference = [&](const std::string& name) {
    return std::any_of(study.runs.begin(), study.runs.end(),
                       [&](const RunRecord& run) { return run.config.scenario == name && used_reference(run); });
  };
  const auto no_position = undefined_in(study, quantity::position_error());
  for (const auto& name : undefined_in(study, quantity::attitude_error())) {
    if (by_reference(name)) continue;
    if (std::find(no_position.begin(), no_position.end(), name) != no_position.end()) without.push_back(name);
  }
  if (!without.empty()) {
    topic.sentences.push_back(fmt::format("No exact solution is known for {}, so {} runs have no errors against it.",
                                          words(without), without.size() == 1 ? "its" : "their"));
  }
  return topic;
}

Topic gyroscopic_term(const Grouping& grouping) {
  Topic topic{.heading = "With and without the gyroscopic term", .sentences = {}};
  auto comparison = gyroscopic_comparison(grouping);
  if (!comparison) return topic;
  topic.sentences.push_back(comparison->differs
                                ? "Without the gyroscopic term another equation is solved, so its distance from the "
                                  "exact motion need not vanish with the "
                                  "step. The table sets the same runs side by side."
                                : "In these runs the gyroscopic term makes no difference to the digits shown.");
  topic.tables.push_back(std::move(comparison->table));
  return topic;
}

/// Sentence about the diverged runs of a curve: their number, and the run that diverged at the earliest time.
std::string divergence_sentence(const Grouping& grouping, const Curve& curve) {
  std::vector<const RunRecord*> diverged;
  for (const auto* run : curve.runs) {
    if (run->result.status == "diverged") diverged.push_back(run);
  }
  if (diverged.empty()) return "";
  const auto first = *std::min_element(diverged.begin(), diverged.end(), [](const auto* a, const auto* b) {
    return a->result.t_reached < b->result.t_reached;
  });
  return fmt::format("{} diverged in {} of {}; {}, at {}, at t = {} s.", curve_label(grouping, curve), diverged.size(),
                     count(curve.runs.size(), "run"), diverged.size() == 1 ? "it did so" : "the first to do so",
                     step_label(*first), number(first->result.t_reached));
}

/// Runs that did not finish for the same reason; refusals are the same for many methods.
struct Trouble {
  std::vector<std::string> methods;
  const Curve* curve;
  std::vector<const RunRecord*> runs;
};

std::vector<Trouble> troubles_of(const Grouping& grouping) {
  std::vector<Trouble> found;
  std::map<std::tuple<std::size_t, std::size_t, std::string, std::string, std::string>, std::size_t> places;
  for (const auto& curve : grouping.curves) {
    for (const auto* run : curve.runs) {
      if (completed(*run)) continue;
      const auto& method = grouping.methods[curve.method_index];
      const bool refused = run->result.status == "refused";
      const std::tuple key(curve.case_index, curve.variant_index, run->result.status, run->result.message,
                           refused ? "" : method);
      const auto [at, added] = places.emplace(key, found.size());
      if (added) found.push_back({{}, &curve, {}});
      auto& trouble = found[at->second];
      if (trouble.methods.empty() || trouble.methods.back() != method) trouble.methods.push_back(method);
      trouble.runs.push_back(run);
    }
  }
  return found;
}

std::vector<std::string> trouble_row(const Grouping& grouping, const Trouble& trouble) {
  const auto& first = *trouble.runs.front();
  const auto steps = trouble.runs.size() == 1 ? step_label(first) : count(trouble.runs.size(), "run");
  return {words(trouble.methods),
          grouping.cases[trouble.curve->case_index].label(),
          grouping.variants[trouble.curve->variant_index],
          steps,
          first.result.status,
          ended_early(first) && trouble.runs.size() == 1 ? number(first.result.t_reached) : "",
          first.result.message};
}

Topic troubles(const Grouping& grouping) {
  using Kind = Column::Kind;
  Topic topic{.heading = "Runs that did not finish", .sentences = {}};
  constexpr std::size_t most_sentences = 10;
  std::size_t sentences = 0;
  for (const auto& curve : grouping.curves) {
    auto sentence = divergence_sentence(grouping, curve);
    if (sentence.empty() || ++sentences > most_sentences) continue;
    topic.sentences.push_back(std::move(sentence));
  }
  if (sentences > most_sentences)
    topic.sentences.push_back(fmt::format("{} more curves diverged.", sentences - most_sentences));

  Table table{.caption = "Diverged, failed and refused runs, with the reason",
              .columns = {{"method", "", Kind::text},
                          {"motion", "", Kind::text},
                          {"formulation", "", Kind::text},
                          {"step", "", Kind::text},
                          {"status", "", Kind::text},
                          {"reached", "s"},
                          {"reason", "", Kind::text}},
              .rows = {}};
  const auto all = troubles_of(grouping);
  for (const auto& trouble : all) {
    if (table.rows.size() < most_troubled_rows) table.rows.push_back(trouble_row(grouping, trouble));
  }
  if (all.size() > most_troubled_rows)
    table.caption += fmt::format("; the first {} of {} rows", most_troubled_rows, all.size());
  if (!table.rows.empty()) topic.tables.push_back(without_empty_columns(std::move(table)));
  return topic;
}

/// Warnings about motions that no completed run follows; small drifts of such runs are no merit.
std::vector<std::string> unfollowed(const Grouping& grouping) {
  // Numbers of runs with an error, and of those that are off, by case.
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> cases;
  for (const auto& curve : grouping.curves) {
    if (!curve.runs.front()->config.formulation.gyroscopic) continue;  // solves another equation
    for (const auto* run : curve.runs) {
      if (!value(*run, quantity::attitude_error()) && !value(*run, quantity::position_error())) continue;
      auto& [all, off] = cases[curve.case_index];
      ++all;
      off += off_the_motion(*run, curve);
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [index, counts] : cases) {
    const auto [all, off] = counts;
    if (off < all) continue;
    sentences.push_back(fmt::format(
        "No run follows the motion of {}: {} off by more than a radian, or by more than the motion goes. Which of them "
        "is "
        "nearest is chance, and what they keep is kept of another motion.",
        grouping.cases[index].label(), all == 1 ? "the one that ended is" : fmt::format("all {} that ended are", all)));
  }
  return sentences;
}

}  // namespace

Findings findings_of(const StudyView& study, const Grouping& grouping) {
  Findings found{.outcome = outcome(study), .cautions = cautions(grouping), .topics = {}};
  append(found.cautions, unfollowed(grouping));
  for (auto& topic : std::array{energy(study, grouping), momenta(study, grouping), orientation(study, grouping),
                                errors(study, grouping), gyroscopic_term(grouping), troubles(grouping)}) {
    if (!topic.sentences.empty() || !topic.tables.empty()) found.topics.push_back(std::move(topic));
  }
  return found;
}

}  // namespace polhode::study::report::findings
