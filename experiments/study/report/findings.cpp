// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "experiments/study/report/extremes.hpp"
#include "experiments/study/report/gyroscopic.hpp"
#include "experiments/study/report/method_table.hpp"
#include "experiments/study/report/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::report {

namespace {

constexpr std::size_t few_runs = 3;              // each is described in a sentence of its own
constexpr std::size_t most_troubled_runs = 100;  // rows of the table of runs that did not finish

void append(std::vector<std::string>& all, std::vector<std::string> more) {
  for (auto& sentence : more) all.push_back(std::move(sentence));
}

std::string outcome(const StudyView& study) {
  std::map<std::string, std::size_t> counts;
  for (const auto& run : study.runs) ++counts[run.result.status];
  std::vector<std::string> parts;
  for (const auto& [status, text] : {std::pair("ok", "completed"), std::pair("diverged", "diverged"), std::pair("failed", "failed"),
                                     std::pair("refused", "refused")}) {
    if (counts[status] > 0) parts.push_back(fmt::format("{} {}", counts[status], text));
  }
  if (study.runs.size() > 1 && counts["ok"] == study.runs.size()) return fmt::format("{} runs, all completed.", study.runs.size());
  return fmt::format("{}: {}.", count(study.runs.size(), "run"), parts.empty() ? "none completed" : words(parts));
}

std::string drift_phrase(const RunRecord& run) {
  const auto drift = value(run, quantity::energy_drift());
  if (!drift) return "no energy drift was measured";
  std::string text = fmt::format("the largest energy drift is {}", number(*drift));
  if (run.result.energy_initial) text += fmt::format(" (of an initial energy of {} J)", number(*run.result.energy_initial, 6));
  const auto trend = energy_trend(run);
  if (trend == "gains" || trend == "loses") text += fmt::format("; the run {} energy", trend);
  if (trend == "comes back") text += "; at the end the drift is back below a tenth of that";
  if (trend == "round-off") text += ", which is round-off";
  if (!run.result.drift_class.empty() && trend != "round-off") text += fmt::format(", and the drift's growth is {}", run.result.drift_class);
  return text;
}

/// A run in one sentence, for studies of a few.
std::string run_sentence(const Grouping& grouping, const Curve& curve, const RunRecord& run) {
  const auto label = run_label(grouping, curve, run);
  if (!completed(run)) return fmt::format("{}: {}.", label, run.result.message.empty() ? run.result.status : run.result.message);
  std::vector<std::string> parts = {drift_phrase(run)};
  for (const auto& quantity : {quantity::angular_momentum_drift(), quantity::linear_momentum_drift(), quantity::orientation_defect()}) {
    if (const auto found = value(run, quantity)) parts.push_back(fmt::format("the {} is {}", quantity.words, number(*found)));
  }
  if (const auto found = value(run, quantity::attitude_error())) {
    parts.push_back(fmt::format("the attitude is off the exact one by up to {} rad", number(*found)));
  }
  if (const auto found = value(run, quantity::position_error())) {
    parts.push_back(fmt::format("the position by up to {} m", number(*found)));
  }
  parts.push_back(fmt::format("it took {} steps and {} evaluations of the right-hand side", run.result.steps, run.result.evaluations));
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

/// "Energy is gained by a and b, lost by c."
std::vector<std::string> trends(const Grouping& grouping) {
  std::map<std::string, std::vector<const Curve*>> by_trend;
  for (const auto& curve : grouping.curves) {
    if (auto trend = energy_trend(curve); !trend.empty()) by_trend[trend].push_back(&curve);
  }
  std::vector<std::string> parts;
  const auto tell = [&](const char* trend, const char* words_before) {
    const auto at = by_trend.find(trend);
    if (at != by_trend.end()) parts.push_back(fmt::format("{} {}", words_before, method_names(grouping, at->second)));
  };
  tell("gains", "gained by");
  tell("loses", "lost by");
  tell("gains or loses", "gained or lost, depending on the step, by");
  tell("comes back", "neither gained nor lost for good (the drift comes back below a tenth of its largest value) by");
  tell("round-off", "kept to round-off by");
  if (parts.empty()) return {};
  return {fmt::format("Energy at the end of the runs: {}.", fmt::join(parts, "; "))};
}

/// Methods whose quantity falls more slowly than their order, or a sentence that there is none.
std::vector<std::string> slope_sentences(const Grouping& grouping, const Quantity& quantity) {
  std::vector<std::string> slower;
  std::size_t compared = 0;
  for (const auto& curve : grouping.curves) {
    const auto slope = observed_slope(curve, quantity);
    const auto* entry = find_integrator(grouping.methods[curve.method_index]);
    // Without the gyroscopic term another equation is solved: its distance from this one has no order.
    const bool same_equation = curve.runs.front()->config.formulation.gyroscopic;
    if (!slope || slope->points < 3 || curve.adaptive || !same_equation || entry == nullptr || entry->declaration.order == 0) continue;
    ++compared;
    if (slope->p < entry->declaration.order - 0.25) {
      slower.push_back(fmt::format("{} ({:.2f} over {} points, declared order {})", grouping.label(curve), slope->p, slope->points,
                                   entry->declaration.order));
    }
  }
  if (compared == 0) return {};
  if (slower.empty()) {
    return {fmt::format("Against the step, the {} falls at least as fast as the declared order wherever a slope can be seen ({}).",
                        quantity.words, count(compared, "curve"))};
  }
  constexpr std::size_t most = 8;
  const std::size_t rest = slower.size() > most ? slower.size() - most : 0;
  if (rest > 0) slower.resize(most), slower.push_back(fmt::format("{} more", rest));
  return {fmt::format("Against the step, the {} falls more slowly than the declared order for {}.", quantity.words, words(slower))};
}

Topic energy(const StudyView& study, const Grouping& grouping) {
  Topic topic{.heading = "Energy", .sentences = run_sentences(study, grouping)};
  if (study.runs.size() > 1) {
    append(topic.sentences, extremes(grouping, quantity::energy_drift()));
    append(topic.sentences, trends(grouping));
    append(topic.sentences, slope_sentences(grouping, quantity::energy_drift()));
  }
  return topic;
}

std::string force_kinds(const Scenario& scenario) {
  std::set<std::string> kinds;
  for (const auto& force : scenario.problem.forces) kinds.insert(force.kind);
  return words({kinds.begin(), kinds.end()});
}

/// Scenarios in which no run has a value of the quantity though some completed.
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
    const auto at = std::find_if(study.scenarios.begin(), study.scenarios.end(), [&](const auto& s) { return s.name == name; });
    const auto forces = at == study.scenarios.end() ? std::string() : force_kinds(*at);
    sentences.push_back(fmt::format("In {} the {} is no invariant: {} not conserve it, so it has no drift.", name, momentum,
                                    forces.empty() ? "the forces or the pivot do" : fmt::format("the forces ({}) do", forces)));
  }
  return sentences;
}

void kept_sentence(std::vector<std::string>& sentences, const Grouping& grouping, const Quantity& quantity) {
  const auto found = at_round_off(grouping, quantity);
  if (found.kept.empty()) return;
  sentences.push_back(found.not_kept.empty()
                          ? fmt::format("The {} is at round-off in all runs.", quantity.words)
                          : fmt::format("The {} is at round-off at every step for {}.", quantity.words, method_names(grouping, found.kept)));
}

Topic momenta(const StudyView& study, const Grouping& grouping) {
  Topic topic{.heading = "Momenta", .sentences = {}};
  for (const auto& [quantity, momentum] : {std::pair(quantity::angular_momentum_drift(), "angular momentum"),
                                           std::pair(quantity::linear_momentum_drift(), "linear momentum")}) {
    kept_sentence(topic.sentences, grouping, quantity);
    if (!at_round_off(grouping, quantity).not_kept.empty() && study.runs.size() > 1) {
      append(topic.sentences, extremes(grouping, quantity));
    }
    append(topic.sentences, not_conserved(study, quantity, momentum));
  }
  for (const auto& name : study.invariants) {
    const auto quantity = quantity::invariant_drift(name);
    kept_sentence(topic.sentences, grouping, quantity);
    if (!at_round_off(grouping, quantity).not_kept.empty()) append(topic.sentences, extremes(grouping, quantity));
  }
  return topic;
}

Topic orientation(const StudyView& study, const Grouping& grouping) {
  Topic topic{.heading = "Orientation", .sentences = {}};
  kept_sentence(topic.sentences, grouping, quantity::orientation_defect());
  if (!at_round_off(grouping, quantity::orientation_defect()).not_kept.empty() && study.runs.size() > 1) {
    append(topic.sentences, extremes(grouping, quantity::orientation_defect()));
  }
  return topic;
}

Topic errors(const StudyView& study, const Grouping& grouping) {
  Topic topic{.heading = "Distance from the exact motion", .sentences = {}};
  for (const auto& quantity : {quantity::attitude_error(), quantity::position_error()}) {
    if (study.runs.size() > 1) append(topic.sentences, extremes(grouping, quantity));
    append(topic.sentences, slope_sentences(grouping, quantity));
  }
  std::vector<std::string> without;
  const auto no_position = undefined_in(study, quantity::position_error());
  for (const auto& name : undefined_in(study, quantity::attitude_error())) {
    if (std::find(no_position.begin(), no_position.end(), name) != no_position.end()) without.push_back(name);
  }
  if (!without.empty()) {
    topic.sentences.push_back(fmt::format("No exact solution is known for {}, so {} runs have no errors against it.", words(without),
                                          without.size() == 1 ? "its" : "their"));
  }
  return topic;
}

Topic gyroscopic_term(const Grouping& grouping) {
  Topic topic{.heading = "With and without the gyroscopic term", .sentences = {}};
  auto table = gyroscopic_comparison(grouping);
  if (!table) return topic;
  topic.sentences.push_back(
      "Without the gyroscopic term another equation is solved, so its distance from the exact motion need not vanish with the step. "
      "The table sets the same runs side by side.");
  topic.tables.push_back(std::move(*table));
  return topic;
}

/// A curve's runs that diverged: how many, and from which step on.
std::string divergence_sentence(const Grouping& grouping, const Curve& curve) {
  std::vector<const RunRecord*> diverged;
  for (const auto* run : curve.runs) {
    if (run->result.status == "diverged") diverged.push_back(run);
  }
  if (diverged.empty()) return "";
  const auto first = *std::min_element(diverged.begin(), diverged.end(),
                                       [](const auto* a, const auto* b) { return a->result.t_reached < b->result.t_reached; });
  std::string label = grouping.label(curve);
  if (grouping.cases.size() > 1) label += " on " + grouping.cases[curve.case_index].label();
  return fmt::format("{} diverged in {} of {}; {}, at {}, at t = {} s.", label, diverged.size(), count(curve.runs.size(), "run"),
                     diverged.size() == 1 ? "it did so" : "the first to do so", step_label(*first), number(first->result.t_reached));
}

Topic troubles(const Grouping& grouping) {
  using Kind = Column::Kind;
  Topic topic{.heading = "Runs that did not finish", .sentences = {}};
  Table table{.caption = "Diverged, failed and refused runs, with the reason",
              .columns = {{"method", "", Kind::name},
                          {"motion", "", Kind::text},
                          {"formulation", "", Kind::text},
                          {"step", "", Kind::text},
                          {"status", "", Kind::text},
                          {"reached", "s"},
                          {"reason", "", Kind::text}},
              .rows = {}};
  std::size_t all = 0;
  for (const auto& curve : grouping.curves) {
    if (auto sentence = divergence_sentence(grouping, curve); !sentence.empty() && topic.sentences.size() < 10) {
      topic.sentences.push_back(std::move(sentence));
    }
    for (const auto* run : curve.runs) {
      if (completed(*run) || ++all > most_troubled_runs) continue;
      table.rows.push_back({grouping.methods[curve.method_index], grouping.cases[curve.case_index].label(),
                            grouping.variants[curve.variant_index], step_label(*run), run->result.status,
                            ended_early(*run) ? number(run->result.t_reached) : "", run->result.message});
    }
  }
  if (all > most_troubled_runs) {
    topic.sentences.push_back(fmt::format("The table shows {} of {}; runs.csv has them all.", most_troubled_runs, count(all, "such run")));
  }
  if (!table.rows.empty()) topic.tables.push_back(without_empty_columns(std::move(table)));
  return topic;
}

}  // namespace

Findings findings_of(const StudyView& study, const Grouping& grouping) {
  Findings found{.outcome = outcome(study), .cautions = cautions(grouping), .topics = {}};
  for (auto& topic : std::array{energy(study, grouping), momenta(study, grouping), orientation(study, grouping), errors(study, grouping),
                                gyroscopic_term(grouping), troubles(grouping)}) {
    if (!topic.sentences.empty() || !topic.tables.empty()) found.topics.push_back(std::move(topic));
  }
  return found;
}

}  // namespace polhode::study::report
