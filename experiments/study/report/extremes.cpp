// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "experiments/study/report/notation.hpp"

namespace polhode::study::report {

namespace {

constexpr std::size_t most_groups_told_one_by_one = 6;

/// Curves that may be compared: one motion, one formulation, all fixed steps or all tolerances.
struct Group {
  std::size_t case_index, variant_index;
  bool adaptive;
  std::vector<const Curve*> curves;
};

std::vector<Group> groups_of(const Grouping& grouping, const Quantity& quantity) {
  std::vector<Group> groups;
  for (const auto& curve : grouping.curves) {
    const bool defined = std::any_of(curve.runs.begin(), curve.runs.end(),
                                     [&](const auto* run) { return quantity.of(run->result) || ended_early(*run); });
    if (!defined) continue;
    auto at = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return g.case_index == curve.case_index && g.variant_index == curve.variant_index && g.adaptive == curve.adaptive;
    });
    if (at == groups.end()) {
      groups.push_back({curve.case_index, curve.variant_index, curve.adaptive, {}});
      at = groups.end() - 1;
    }
    at->curves.push_back(&curve);
  }
  std::erase_if(groups, [&](const Group& g) {
    return std::none_of(g.curves.begin(), g.curves.end(), [&](const auto* curve) {
      return std::any_of(curve->runs.begin(), curve->runs.end(), [&](const auto* run) { return value(*run, quantity).has_value(); });
    });
  });
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return std::tie(a.case_index, a.variant_index, a.adaptive) < std::tie(b.case_index, b.variant_index, b.adaptive);
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

/// The methods of a group at one step.
struct Ranking {
  struct Entry {
    std::string method;
    double value;
  };
  std::vector<Entry> above;             ///< above round-off, least first
  std::vector<std::string> at_round_off;
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
      if (*measured > round_off_level(*run, quantity)) {
        found.above.push_back({method, *measured});
      } else {
        found.at_round_off.push_back(method);
        found.largest_round_off = std::max(found.largest_round_off, *measured);
      }
    }
  }
  std::stable_sort(found.above.begin(), found.above.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  return found;
}

std::string least_and_most(const Ranking& r, const Quantity& quantity) {
  const auto& least = r.above.front();
  const auto& most = r.above.back();
  if (most.value <= 1.01 * least.value) {
    std::vector<std::string> methods;
    for (const auto& entry : r.above) methods.push_back(entry.method);
    return fmt::format("the {} of {} is {}", quantity.words, words(methods), number(most.value) + quantity.unit);
  }
  if (!r.at_round_off.empty()) return fmt::format("{} has the most ({})", most.method, number(most.value) + quantity.unit);
  return fmt::format("{} has the least {} ({}) and {} the most ({})", least.method, quantity.words, number(least.value) + quantity.unit, most.method,
                     number(most.value) + quantity.unit + quantity.unit);
}

std::string described(const Ranking& r, const Quantity& quantity) {
  std::vector<std::string> parts;
  if (!r.at_round_off.empty()) {
    parts.push_back(fmt::format("the {} of {} is at round-off ({}{})", quantity.words, words(r.at_round_off),
                                r.largest_round_off > 0 ? "at most " : "", number(r.largest_round_off) + quantity.unit));
  }
  if (!r.above.empty()) parts.push_back(least_and_most(r, quantity));
  if (!r.ended_early.empty()) {
    parts.push_back(fmt::format("{} did not reach the end", words(r.ended_early)));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string prefix(const Grouping& grouping, const Group& group) {
  std::vector<std::string> parts;
  if (grouping.cases.size() > 1) parts.push_back(grouping.cases[group.case_index].label());
  if (!grouping.variants[group.variant_index].empty()) parts.push_back(grouping.variants[group.variant_index]);
  return parts.empty() ? "" : fmt::format("{}: ", fmt::join(parts, ", "));
}

const char* end_name(bool adaptive, bool largest) {
  if (adaptive) return largest ? "the loosest" : "the tightest";
  return largest ? "the largest step" : "the smallest step";
}

void tell_one_by_one(const Grouping& grouping, const Group& group, const Quantity& quantity, std::vector<std::string>& sentences) {
  const auto steps = steps_of(group);
  const auto tell = [&](double step, const std::string& which) {
    const auto r = ranking(grouping, group, quantity, step);
    if (r.above.empty() && r.at_round_off.empty() && r.ended_early.empty()) return;
    const auto about = prefix(grouping, group);
    sentences.push_back(fmt::format("{}{} {}{}: {}.", about, about.empty() ? "At" : "at", r.step, which, described(r, quantity)));
  };
  if (steps.empty()) return;
  if (steps.size() == 1) return tell(*steps.begin(), "");
  tell(*steps.rbegin(), fmt::format(", {}", end_name(group.adaptive, true)));
  tell(*steps.begin(), fmt::format(", {}", end_name(group.adaptive, false)));
}

/// "rk4 in 12 of 20 and dmv in 8 of 20".
std::string counted(const std::map<std::string, std::size_t>& counts, std::size_t total) {
  std::vector<std::pair<std::string, std::size_t>> order(counts.begin(), counts.end());
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> parts;
  for (const auto& [method, n] : order) parts.push_back(n == total ? fmt::format("{} in all {}", method, n) : fmt::format("{} in {} of {}", method, n, total));
  return words(parts);
}

void tell_counts(const Grouping& grouping, const std::vector<Group>& groups, const Quantity& quantity, bool adaptive, bool largest,
                 std::vector<std::string>& sentences) {
  std::map<std::string, std::size_t> best, worst;
  std::size_t total = 0;
  for (const auto& group : groups) {
    const auto steps = steps_of(group);
    if (group.adaptive != adaptive || steps.empty()) continue;
    const auto r = ranking(grouping, group, quantity, largest ? *steps.rbegin() : *steps.begin());
    if (r.above.empty() && r.at_round_off.empty()) continue;
    ++total;
    for (const auto& method : r.at_round_off) ++best[method];
    if (r.at_round_off.empty()) ++best[r.above.front().method];
    if (!r.above.empty()) ++worst[r.above.back().method];
  }
  if (total == 0) return;
  std::string text = fmt::format("Over {} motions and formulations, each at its {}: the {} is least, or at round-off, for {}", total,
                                 adaptive ? (largest ? "loosest tolerance" : "tightest tolerance") : (largest ? "largest step" : "smallest step"),
                                 quantity.words, counted(best, total));
  if (!worst.empty()) text += fmt::format("; it is largest for {}", counted(worst, total));
  sentences.push_back(text + ".");
}

}  // namespace

std::vector<std::string> extremes(const Grouping& grouping, const Quantity& quantity) {
  const auto groups = groups_of(grouping, quantity);
  std::vector<std::string> sentences;
  if (groups.size() <= most_groups_told_one_by_one) {
    for (const auto& group : groups) tell_one_by_one(grouping, group, quantity, sentences);
  } else {
    for (const bool adaptive : {false, true}) {
      for (const bool largest : {true, false}) tell_counts(grouping, groups, quantity, adaptive, largest, sentences);
    }
  }
  return sentences;
}

RoundOff at_round_off(const Grouping& grouping, const Quantity& quantity) {
  RoundOff found;
  for (const auto& curve : grouping.curves) {
    std::size_t below = 0, defined = 0;
    for (const auto* run : curve.runs) {
      const auto measured = value(*run, quantity);
      defined += measured.has_value();
      below += measured && *measured <= round_off_level(*run, quantity);
    }
    if (defined > 0) (below == defined ? found.kept : found.not_kept).push_back(&curve);
  }
  return found;
}

std::string method_names(const Grouping& grouping, const std::vector<const Curve*>& curves) {
  std::map<std::size_t, std::set<std::size_t>> variants, all_variants;
  for (const auto* curve : curves) variants[curve->method_index].insert(curve->variant_index);
  for (const auto& curve : grouping.curves) all_variants[curve.method_index].insert(curve.variant_index);
  std::vector<std::string> names;
  for (const auto& [method, in] : variants) {
    if (in == all_variants[method]) {
      names.push_back(grouping.methods[method]);
      continue;
    }
    for (const auto variant : in) names.push_back(fmt::format("{} ({})", grouping.methods[method], grouping.variants[variant]));
  }
  return words(names);
}

}  // namespace polhode::study::report
