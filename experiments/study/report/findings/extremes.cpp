// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/findings/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline findings {

namespace {

// Limits of the numbers of motions and formulations described in sentences and in a table alone; more are also counted.
constexpr std::size_t told_in_sentences = 1;
constexpr std::size_t told_in_table = 3;
constexpr std::size_t most_table_rows = 60;

/// Comparable curves: of one motion and one formulation, all with fixed steps or all with tolerances.
struct Group {
  std::size_t case_index, variant_index;
  bool adaptive;
  std::vector<const Curve*> curves;
};

std::vector<Group> groups_of(const Grouping& grouping, const Quantity& quantity) {
  std::map<std::tuple<std::size_t, std::size_t, bool>, Group> found;
  for (const auto& curve : grouping.curves) {
    const bool defined = std::any_of(curve.runs.begin(), curve.runs.end(),
                                     [&](const auto* run) { return quantity.of(run->result) || ended_early(*run); });
    if (!defined) continue;
    const std::tuple key(curve.case_index, curve.variant_index, curve.adaptive);
    const auto at = found.try_emplace(key, Group{curve.case_index, curve.variant_index, curve.adaptive, {}}).first;
    at->second.curves.push_back(&curve);
  }
  std::vector<Group> groups;
  for (auto& entry : found) groups.push_back(std::move(entry.second));
  std::erase_if(groups, [&](const Group& g) {
    return std::none_of(g.curves.begin(), g.curves.end(), [&](const auto* curve) {
      return std::any_of(curve->runs.begin(), curve->runs.end(),
                         [&](const auto* run) { return value(*run, quantity).has_value(); });
    });
  });
  return groups;
}

std::set<double> steps_of(const Group& group) {
  std::set<double> steps;
  for (const auto* curve : group.curves) {
    for (const auto* run : curve->runs) {
      if (abscissa(*run)) steps.insert(*abscissa(*run));
    }
  }
  return steps;
}

/// Ranking of the methods of a group at one step.
struct Ranking {
  struct Entry {
    std::string method;
    double value;
    bool off_the_motion;
  };
  std::vector<Entry> above;  ///< methods above round-off that are not lost, least first
  std::vector<Entry> lost;   ///< methods from lost_level() on, least first
  std::vector<Entry> at_round_off;
  double largest_round_off = 0;
  std::vector<std::string> ended_early;
  std::string step;  ///< "dt = 0.1 s"
};

Ranking ranking(const Grouping& grouping, const Group& group, const Quantity& quantity, double step) {
  Ranking found;
  for (const auto* curve : group.curves) {
    for (const auto* run : curve->runs) {
      if (abscissa(*run) != step) continue;
      const auto& method = grouping.methods[curve->method_index];
      found.step = step_label(*run);
      if (ended_early(*run)) found.ended_early.push_back(method);
      const auto measured = value(*run, quantity);
      if (!measured) continue;
      const Ranking::Entry entry{method, *measured, off_the_motion(*run, *curve)};
      if (*measured <= round_off_level(*run, quantity)) {
        found.at_round_off.push_back(entry);
        found.largest_round_off = std::max(found.largest_round_off, *measured);
      } else {
        (follows(*run, *curve, quantity) ? found.above : found.lost).push_back(entry);
      }
    }
  }
  for (auto* entries : {&found.above, &found.lost}) {
    std::stable_sort(entries->begin(), entries->end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  }
  return found;
}

bool is_error(const Quantity& quantity) { return !quantity.unit.empty(); }

std::string methods_in(const std::vector<Ranking::Entry>& entries) {
  std::vector<std::string> methods;
  for (const auto& entry : entries) methods.push_back(entry.method);
  return words(methods);
}

/// Description of a lost value: "off by more than a radian". The value itself is not given, since angles are wrapped
/// and the largest one is accidental.
std::string lost_words(const Quantity& quantity) {
  if (quantity.unit == " rad") return "off by more than a radian";
  return quantity.bounded ? "1 or more" : "off by more than the motion goes";
}

/// True if all values differ by at most 1 %.
bool alike(const Ranking& r) { return r.above.back().value <= 1.01 * r.above.front().value; }

/// The entry with the largest comparable value; lost errors are not comparable. There must be at least one such entry.
const Ranking::Entry& most_of(const Ranking& r, const Quantity& quantity) {
  return r.lost.empty() || is_error(quantity) ? r.above.back() : r.lost.back();
}

std::string least_and_most(const Ranking& r, const Quantity& quantity) {
  const auto& least = r.above.front();
  const auto& most = most_of(r, quantity);
  if (&most == &r.above.back() && alike(r)) {
    return fmt::format("the {} of {} is {}", quantity.words, methods_in(r.above), number(most.value) + quantity.unit);
  }
  if (!r.at_round_off.empty())
    return fmt::format("{} has the most ({})", most.method, number(most.value) + quantity.unit);
  return fmt::format("{} has the least {} ({}{}) and {} the most ({})", least.method, quantity.words,
                     number(least.value) + quantity.unit,
                     least.off_the_motion ? ", but does not follow the motion" : "", most.method,
                     number(most.value) + quantity.unit);
}

/// Clause about lost runs: "no run follows the motion: the attitude of rk4 and heun is off by more than a radian".
std::string lost_ones(const Ranking& r, const Quantity& quantity) {
  const bool none_left = r.above.empty() && r.at_round_off.empty();
  if (!is_error(quantity)) {
    if (!none_left) return "";  // the method with the largest value is named elsewhere
    return fmt::format(
        "no run keeps it: the {} of {} is {}{}", quantity.words, methods_in(r.lost), lost_words(quantity),
        r.lost.size() > 1 ? fmt::format(", of {} the most ({})", r.lost.back().method, number(r.lost.back().value))
                          : fmt::format(" ({})", number(r.lost.back().value)));
  }
  return fmt::format("{}the {} of {} is {}", none_left ? "no run follows the motion: " : "",
                     quantity.unit == " rad" ? "attitude" : "position", methods_in(r.lost), lost_words(quantity));
}

std::string described(const Ranking& r, const Quantity& quantity) {
  std::vector<std::string> parts;
  if (!r.at_round_off.empty()) {
    parts.push_back(fmt::format("the {} of {} is at round-off ({}{})", quantity.words, methods_in(r.at_round_off),
                                r.largest_round_off > 0 ? "at most " : "",
                                number(r.largest_round_off) + quantity.unit));
  }
  if (!r.above.empty()) {
    parts.push_back(least_and_most(r, quantity));
  } else if (!r.lost.empty() && !r.at_round_off.empty() && !is_error(quantity)) {
    parts.push_back(fmt::format("{} has the most ({})", r.lost.back().method, number(r.lost.back().value)));
  }
  if (!r.lost.empty()) {
    if (auto text = lost_ones(r, quantity); !text.empty()) parts.push_back(std::move(text));
  }
  if (!r.ended_early.empty()) {
    parts.push_back(fmt::format("{} did not reach the end", words(r.ended_early)));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string end_name(bool adaptive, bool largest) {
  if (adaptive) return largest ? "the loosest" : "the tightest";
  return largest ? "the largest step" : "the smallest step";
}

/// Name of a group before its sentences: "heavy_top, matrix: "; without parts of which the study has only one.
std::string prefix(const Grouping& grouping, const Group& group) {
  std::vector<std::string> parts;
  if (grouping.cases.size() > 1) parts.push_back(grouping.cases[group.case_index].label());
  if (!grouping.variants[group.variant_index].empty()) parts.push_back(grouping.variants[group.variant_index]);
  return parts.empty() ? "" : fmt::format("{}: ", fmt::join(parts, ", "));
}

/// Adds the sentences about one motion and formulation.
void tell(const Grouping& grouping, const Group& group, const Quantity& quantity, std::vector<std::string>& sentences) {
  const auto steps = steps_of(group);
  for (const bool largest : {true, false}) {
    if (steps.empty() || (!largest && steps.size() == 1)) continue;
    const auto r = ranking(grouping, group, quantity, largest ? *steps.rbegin() : *steps.begin());
    if (r.above.empty() && r.lost.empty() && r.at_round_off.empty() && r.ended_early.empty()) continue;
    const auto which = steps.size() == 1 ? std::string() : fmt::format(", {}", end_name(group.adaptive, largest));
    const auto about = prefix(grouping, group);
    sentences.push_back(
        fmt::format("{}{} {}{}: {}.", about, about.empty() ? "At" : "at", r.step, which, described(r, quantity)));
  }
}

/// Methods with their counts: "rk4 (12 of 20) and dmv (8 of 20)".
std::string counted(const std::map<std::string, std::size_t>& counts, std::size_t total) {
  std::vector<std::pair<std::string, std::size_t>> order(counts.begin(), counts.end());
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> parts;
  for (const auto& [method, n] : order) {
    parts.push_back(n == total ? fmt::format("{} (all {})", method, n)
                               : fmt::format("{} ({} of {})", method, n, total));
  }
  return words(parts);
}

/// Methods with the least and the largest value at one end of the steps, counted over the groups.
struct Count {
  std::string least, most;
};
Count count_end(const Grouping& grouping, const std::vector<Group>& groups, const Quantity& quantity, bool adaptive,
                bool largest) {
  std::map<std::string, std::size_t> least, most;
  std::size_t total = 0;
  for (const auto& group : groups) {
    const auto steps = steps_of(group);
    if (group.adaptive != adaptive || steps.empty()) continue;
    const auto r = ranking(grouping, group, quantity, largest ? *steps.rbegin() : *steps.begin());
    const std::size_t kept = r.above.size() + r.at_round_off.size(), lost = is_error(quantity) ? 0 : r.lost.size();
    if (kept == 0 || kept + lost < 2) continue;  // nothing to compare
    ++total;
    for (const auto& entry : r.at_round_off) ++least[entry.method];
    if (r.at_round_off.empty()) ++least[r.above.front().method];
    if (!r.above.empty() || lost > 0) ++most[most_of(r, quantity).method];
  }
  if (total == 0) return {};
  const auto where = fmt::format("at {}{} ", end_name(adaptive, largest), adaptive ? " tolerance" : "");
  return {where + counted(least, total), most.empty() ? "" : where + counted(most, total)};
}

std::vector<std::string> counts(const Grouping& grouping, const std::vector<Group>& groups, const Quantity& quantity) {
  std::vector<std::string> least, most;
  for (const bool adaptive : {false, true}) {
    for (const bool largest : {true, false}) {
      auto found = count_end(grouping, groups, quantity, adaptive, largest);
      if (!found.least.empty()) least.push_back(std::move(found.least));
      if (!found.most.empty()) most.push_back(std::move(found.most));
    }
  }
  std::vector<std::string> sentences;
  if (!least.empty()) {
    sentences.push_back(fmt::format("Least {}, or at round-off, counted over motions and formulations: {}.",
                                    quantity.words, fmt::join(least, "; ")));
  }
  if (!most.empty()) sentences.push_back(fmt::format("Most {}: {}.", quantity.words, fmt::join(most, "; ")));
  return sentences;
}

std::vector<std::string> table_row(const Grouping& grouping, const Group& group, const Quantity& quantity,
                                   const Ranking& r) {
  const auto entry = [](const Ranking::Entry& e) { return fmt::format("{} ({})", e.method, number(e.value)); };
  const bool compares = !is_error(quantity) && !r.lost.empty();  // lost values are included in the comparison
  const bool several = r.above.size() + r.at_round_off.size() + (compares ? r.lost.size() : 0) > 1;
  std::string least = r.above.empty() ? "" : entry(r.above.front());
  if (!r.above.empty() && r.above.front().off_the_motion && !is_error(quantity)) {
    least = fmt::format("{} ({}, off the motion)", r.above.front().method, number(r.above.front().value));
  }
  std::string most;
  if (compares) most = entry(r.lost.back());
  else if (!r.above.empty() && several) most = entry(r.above.back());
  if (!r.at_round_off.empty()) {
    least = fmt::format("{} (round-off)", methods_in(r.at_round_off));
  } else if (several && !compares && alike(r)) {
    least = most = fmt::format("all alike ({})", number(r.above.back().value));
  } else if (r.above.empty() && !r.lost.empty()) {
    least = "none: all lost";
  }
  return {grouping.cases[group.case_index].label(),
          grouping.variants[group.variant_index],
          r.step,
          least,
          most,
          is_error(quantity) ? methods_in(r.lost) : "",
          words(r.ended_early)};
}

Table table_of(const Grouping& grouping, const std::vector<Group>& groups, const Quantity& quantity) {
  using Kind = Column::Kind;
  Table table{.caption = fmt::format("Least and most {}{}", quantity.words,
                                     quantity.unit.empty() ? "" : fmt::format(" ({})", quantity.unit.substr(1))),
              .columns = {{"motion", "", Kind::text},
                          {"formulation", "", Kind::text},
                          {"at", "", Kind::text},
                          {"least", "", Kind::text},
                          {"most", "", Kind::text},
                          {lost_words(quantity), "", Kind::text},
                          {"did not reach the end", "", Kind::text}},
              .rows = {}};
  for (const auto& group : groups) {
    const auto steps = steps_of(group);
    for (const bool largest : {true, false}) {
      if (steps.empty() || (!largest && steps.size() == 1)) continue;
      if (table.rows.size() == most_table_rows) {
        table.caption += fmt::format("; the first {} rows", most_table_rows);
        return without_empty_columns(std::move(table));
      }
      table.rows.push_back(table_row(grouping, group, quantity,
                                     ranking(grouping, group, quantity, largest ? *steps.rbegin() : *steps.begin())));
    }
  }
  return without_empty_columns(std::move(table));
}

/// Curves for which the quantity is defined in some completed run (`all`), and those of them at round-off in every such
/// run (`kept`).
struct RoundOff {
  std::vector<const Curve*> kept, all;
};
RoundOff at_round_off(const Grouping& grouping, const Quantity& quantity) {
  RoundOff found;
  for (const auto& curve : grouping.curves) {
    std::size_t below = 0, defined = 0;
    for (const auto* run : curve.runs) {
      const auto measured = value(*run, quantity);
      defined += measured.has_value();
      below += measured && *measured <= round_off_level(*run, quantity);
    }
    if (defined > 0) found.all.push_back(&curve);
    if (defined > 0 && below == defined) found.kept.push_back(&curve);
  }
  return found;
}

std::size_t motions_and_formulations(const std::vector<Group>& groups) {
  std::set<std::pair<std::size_t, std::size_t>> all;
  for (const auto& group : groups) all.emplace(group.case_index, group.variant_index);
  return all.size();
}

/// Description of a part of a method's curves: "matrix", "heavy_top", "matrix, 3 of 20 motions".
std::string part_of(const Grouping& grouping, const std::vector<const Curve*>& some,
                    const std::vector<const Curve*>& all) {
  std::map<std::size_t, std::set<std::size_t>> in, of;  // cases by variant
  for (const auto* curve : some) in[curve->variant_index].insert(curve->case_index);
  for (const auto* curve : all) of[curve->variant_index].insert(curve->case_index);
  const bool alike = in.size() == of.size() && std::all_of(in.begin(), in.end(), [&](const auto& entry) {
                       return entry.second == in.begin()->second && of[entry.first] == of.begin()->second;
                     });
  if (alike) return case_names(grouping, in.begin()->second);
  std::vector<std::string> parts;
  for (const auto& [variant, cases] : in) {
    std::vector<std::string> part;
    if (!grouping.variants[variant].empty()) part.push_back(grouping.variants[variant]);
    if (cases != of[variant]) part.push_back(case_names(grouping, cases));
    parts.push_back(fmt::format("{}", fmt::join(part, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

std::set<std::size_t> quiet_cases(const std::vector<const Curve*>& kept, const std::vector<const Curve*>& all) {
  std::set<std::size_t> cases;
  for (const auto* curve : all) cases.insert(curve->case_index);
  const std::set<const Curve*> quiet(kept.begin(), kept.end());
  for (const auto* curve : all) {
    if (!quiet.contains(curve)) cases.erase(curve->case_index);
  }
  return cases;
}

Extremes extremes(const Grouping& grouping, const Quantity& quantity) {
  Extremes found;
  auto round_off = at_round_off(grouping, quantity);
  if (round_off.all.empty()) return found;
  if (round_off.kept.size() == round_off.all.size()) {
    found.sentences.push_back(fmt::format("The {} is at round-off in all runs that have one.", quantity.words));
    return found;
  }
  auto groups = groups_of(grouping, quantity);
  if (const auto quiet = quiet_cases(round_off.kept, round_off.all); !quiet.empty()) {
    found.sentences.push_back(
        fmt::format("The {} is at round-off in all runs of {}.", quantity.words, case_names(grouping, quiet)));
    const auto is_quiet = [&](const auto* curve) { return quiet.contains(curve->case_index); };
    std::erase_if(round_off.kept, is_quiet);
    std::erase_if(round_off.all, is_quiet);
    std::erase_if(groups, [&](const Group& group) { return quiet.contains(group.case_index); });
  }
  if (motions_and_formulations(groups) <= told_in_sentences) {
    for (const auto& group : groups) tell(grouping, group, quantity, found.sentences);
    return found;
  }
  if (!round_off.kept.empty()) {
    found.sentences.push_back(fmt::format("The {} is at round-off at every step for {}.", quantity.words,
                                          method_names(grouping, round_off.kept, round_off.all)));
  }
  if (motions_and_formulations(groups) > told_in_table) {
    for (auto& sentence : counts(grouping, groups, quantity)) found.sentences.push_back(std::move(sentence));
  }
  found.table = table_of(grouping, groups, quantity);
  return found;
}

std::string case_names(const Grouping& grouping, const std::set<std::size_t>& cases) {
  if (cases.size() > 4) return fmt::format("{} of {} motions", cases.size(), grouping.cases.size());
  std::vector<std::string> names;
  for (const auto c : cases) names.push_back(grouping.cases[c].label());
  return words(names);
}

std::string method_names(const Grouping& grouping, const std::vector<const Curve*>& some,
                         const std::vector<const Curve*>& all) {
  std::map<std::size_t, std::vector<const Curve*>> in, of;
  for (const auto* curve : some) in[curve->method_index].push_back(curve);
  for (const auto* curve : all) of[curve->method_index].push_back(curve);
  std::vector<std::string> names;
  for (const auto& [method, curves] : in) {
    const auto& name = grouping.methods[method];
    names.push_back(curves.size() == of[method].size()
                        ? name
                        : fmt::format("{} ({})", name, part_of(grouping, curves, of[method])));
  }
  return words(names);
}

}  // namespace polhode::study::report::findings
