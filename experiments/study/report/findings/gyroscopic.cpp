// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/findings/gyroscopic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/report/findings/extremes.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline findings {

namespace {

constexpr double perfect_energy = 1e-10;
constexpr double lost_momentum = 1e-6;

bool leaves_gyroscopic_out(const Curve& curve) { return !curve.runs.front()->config.formulation.gyroscopic; }

/// Runs of one motion and formulation that conserve the energy but not the angular momentum.
struct Deceived {
  std::vector<const Curve*> curves;
  std::size_t runs = 0;
  std::set<double> steps;
  double energy = 0;
  double momentum_low = std::numeric_limits<double>::infinity(), momentum_high = 0;

  void add(const Curve& curve, const RunRecord& run, double energy_drift, double momentum_drift) {
    if (curves.empty() || curves.back() != &curve) curves.push_back(&curve);
    ++runs;
    if (abscissa(run)) steps.insert(*abscissa(run));
    energy = std::max(energy, energy_drift);
    momentum_low = std::min(momentum_low, momentum_drift);
    momentum_high = std::max(momentum_high, momentum_drift);
  }
};

std::string where(const Grouping& grouping, const Curve& curve) {
  const auto& variant = grouping.variants[curve.variant_index];
  std::string text = grouping.cases[curve.case_index].label();
  if (!variant.empty()) text += ", " + variant;
  const bool said = variant.find("gyroscopic") != std::string::npos;
  return leaves_gyroscopic_out(curve) && !said ? text + ", gyroscopic off" : text;
}

/// Clause "at every step size", if the runs have several step sizes.
std::string every_step(const Deceived& d) {
  if (d.steps.size() < 2) return "";
  const auto adaptive =
      std::count_if(d.curves.begin(), d.curves.end(), [](const auto* curve) { return curve->adaptive; });
  if (adaptive == 0) return " at every step size";
  return static_cast<std::size_t>(adaptive) == d.curves.size() ? " at every tolerance"
                                                               : " at every step size and tolerance";
}

std::string momentum_words(const Deceived& d) {
  if (d.momentum_high - d.momentum_low <= 0.01 * d.momentum_high) {
    return fmt::format("drifts by {}{}", number(d.momentum_high), every_step(d));
  }
  return fmt::format("drifts by {} to {}", number(d.momentum_low), number(d.momentum_high));
}

std::string caution(const Grouping& grouping, const Deceived& d) {
  const auto& first = *d.curves.front();
  std::set<std::size_t> methods;
  for (const auto* curve : d.curves) methods.insert(curve->method_index);
  std::vector<std::string> names;
  for (const auto m : methods) names.push_back(grouping.methods[m]);
  const auto kept =
      d.energy > 0 ? fmt::format("drifts by no more than {}", number(d.energy)) : std::string("does not drift at all");
  return fmt::format("{}: energy alone would call {} perfect ({} of {}), since it {}; but the angular momentum {}. {}",
                     where(grouping, first), d.runs == 1 ? "this run" : "these runs", count(d.runs, "run"),
                     words(names), kept, momentum_words(d),
                     leaves_gyroscopic_out(first) ? "That is the missing gyroscopic term, which the energy cannot show."
                                                  : "A method can keep one invariant and lose another: look at both.");
}

/// Runs without the gyroscopic term and without a measured angular momentum, by scenario.
std::map<std::string, std::vector<const RunRecord*>> unchecked_runs(const Grouping& grouping) {
  std::map<std::string, std::vector<const RunRecord*>> found;
  for (const auto& curve : grouping.curves) {
    if (!leaves_gyroscopic_out(curve)) continue;
    for (const auto* run : curve.runs) {
      const bool measured = value(*run, quantity::angular_momentum_drift()).has_value();
      if (completed(*run) && !measured) found[run->config.scenario].push_back(run);
    }
  }
  return found;
}

/// Quantities that are large in all of the runs, however small the step: "the p_phi drift (at least 0.02)".
std::vector<std::string> what_shows_it(const std::vector<const RunRecord*>& runs) {
  std::vector<Quantity> candidates = {quantity::attitude_error()};
  for (const auto& [name, drift] : runs.front()->result.invariant_drift_max_rel) {
    candidates.push_back(quantity::invariant_drift(name));
  }
  std::vector<std::string> found;
  for (const auto& quantity : candidates) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto* run : runs) least = std::min(least, value(*run, quantity).value_or(0));
    if (least > lost_momentum)
      found.push_back(fmt::format("the {} (at least {}{})", quantity.words, number(least), quantity.unit));
  }
  return found;
}

std::vector<std::string> gyroscopic_not_checked(const Grouping& grouping) {
  std::vector<std::string> sentences;
  for (const auto& [scenario, runs] : unchecked_runs(grouping)) {
    const auto shown_by = what_shows_it(runs);
    sentences.push_back(
        fmt::format("{}: {} the gyroscopic term out, and the forces do not conserve the angular momentum that would "
                    "show it. A small "
                    "energy drift says nothing about it here. {}",
                    scenario, runs.size() == 1 ? "1 run leaves" : fmt::format("{} runs leave", runs.size()),
                    shown_by.empty() ? "No other number of this study shows it in every run."
                                     : fmt::format("What shows it, in every one of these runs: {}.", words(shown_by))));
  }
  return sentences;
}

/// Key of curves that are comparable: everything except the gyroscopic term.
using ComparisonKey = std::tuple<std::size_t, std::size_t, bool, Orientation, AngularState, RotationFrom, bool,
                                 Precision, std::vector<std::string>>;
ComparisonKey comparison_key(const Curve& curve) {
  const auto& c = curve.runs.front()->config;
  std::vector<std::string> on_demand;
  for (const RunOption& option : run_options()) {
    if (option.on_demand) on_demand.push_back(label_of(option, c));
  }
  return {curve.case_index,
          curve.method_index,
          curve.adaptive,
          c.formulation.orientation,
          c.formulation.angular_state,
          c.formulation.rotation_from,
          c.normalize,
          c.precision,
          on_demand};
}

/// Runs of both curves at the smallest step that both completed.
std::pair<const RunRecord*, const RunRecord*> smallest_common(const Curve& with, const Curve& without) {
  for (auto a = with.runs.rbegin(); a != with.runs.rend(); ++a) {
    for (const auto* b : without.runs) {
      if (completed(**a) && completed(*b) && abscissa(**a) == abscissa(*b)) return {*a, b};
    }
  }
  return {nullptr, nullptr};
}

std::array<Quantity, 3> compared() {
  return {quantity::energy_drift(), quantity::angular_momentum_drift(), quantity::attitude_error()};
}

bool differ(const RunRecord& with, const RunRecord& without) {
  const auto quantities = compared();
  return std::any_of(quantities.begin(), quantities.end(),
                     [&](const auto& quantity) { return printed(with, quantity) != printed(without, quantity); });
}

std::vector<std::string> comparison_row(const Grouping& grouping, const Curve& curve, const RunRecord& with,
                                        const RunRecord& without) {
  std::vector<std::string> row = {grouping.methods[curve.method_index], grouping.cases[curve.case_index].label(),
                                  step_label(with)};
  for (const auto& quantity : compared()) {
    row.push_back(printed(with, quantity));
    row.push_back(printed(without, quantity));
  }
  return row;
}

}  // namespace

std::vector<std::string> cautions(const Grouping& grouping) {
  std::map<std::pair<std::size_t, std::size_t>, Deceived> groups;
  for (const auto& curve : grouping.curves) {
    for (const auto* run : curve.runs) {
      const auto energy = value(*run, quantity::energy_drift()),
                 momentum = value(*run, quantity::angular_momentum_drift());
      if (!energy || !momentum || *energy >= perfect_energy || *momentum <= lost_momentum) continue;
      groups[{curve.case_index, curve.variant_index}].add(curve, *run, *energy, *momentum);
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [key, deceived] : groups) sentences.push_back(caution(grouping, deceived));
  for (auto& sentence : gyroscopic_not_checked(grouping)) sentences.push_back(std::move(sentence));
  return sentences;
}

std::optional<GyroscopicComparison> gyroscopic_comparison(const Grouping& grouping) {
  using Kind = Column::Kind;
  bool differs = false;
  Table table{
      .caption =
          "The same runs with the gyroscopic term (on) and without it (off), at the smallest step that both completed",
      .columns = {{"method", "", Kind::name},
                  {"motion", "", Kind::text},
                  {"step", "", Kind::text},
                  {"energy drift, on"},
                  {"energy drift, off"},
                  {"angular momentum drift, on"},
                  {"angular momentum drift, off"},
                  {"attitude error, on", "rad"},
                  {"attitude error, off", "rad"}},
      .rows = {}};
  std::map<ComparisonKey, std::vector<const Curve*>> left_out;
  for (const auto& curve : grouping.curves) {
    if (leaves_gyroscopic_out(curve)) left_out[comparison_key(curve)].push_back(&curve);
  }
  if (left_out.empty()) return std::nullopt;
  for (const auto& with : grouping.curves) {
    if (leaves_gyroscopic_out(with)) continue;
    const auto comparable = left_out.find(comparison_key(with));
    if (comparable == left_out.end()) continue;
    for (const Curve* without : comparable->second) {
      const auto [a, b] = smallest_common(with, *without);
      if (a == nullptr) continue;
      table.rows.push_back(comparison_row(grouping, with, *a, *b));
      differs = differs || differ(*a, *b);
    }
  }
  if (table.rows.empty()) return std::nullopt;
  return GyroscopicComparison{without_empty_columns(std::move(table)), differs};
}

}  // namespace polhode::study::report::findings
