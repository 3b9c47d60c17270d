// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/findings/method_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/study/curves/declared_order.hpp"
#include "experiments/study/curves/error_ladder.hpp"
#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline report::inline findings {

namespace {

/// Declared order for the motion of the curve: "4"; "2 (attitude: exact)" if the attitude of a free top under gravity
/// has another order.
std::string declared_text(const Curve& curve) {
  const RunRecord& run = *curve.runs.front();
  const auto* entry = find_integrator(run.config.integrator);
  if (entry == nullptr) return "";
  if (entry->declaration.order == 0) return "variable";
  const auto text = [](const std::optional<double>& order) { return order ? number(*order) : std::string("exact"); };
  const auto path = text(declared_order(entry->declaration, run, false));
  const auto attitude = text(declared_order(entry->declaration, run, true));
  return path == attitude ? path : fmt::format("{} (attitude: {})", path, attitude);
}

/// Observed order and number of points: "2.00 (7)"; or the reason for which there is none.
std::string slope_text(const Curve& curve, const Quantity& quantity) {
  constexpr std::size_t wanted_runs = 3;
  if (curve.runs.size() < wanted_runs || !is_measured(curve, quantity)) return "";
  const auto estimate = observed_order(curve, quantity);
  if (const auto line = told_line(estimate)) {
    const double p = std::abs(line->order) < 0.005 ? 0 : line->order;  // no "-0.00"
    return fmt::format("{:.2f} ({})", p, estimate.points);
  }
  if (estimate.line) return "uncertain";
  if (estimate.blown_up > 0 && estimate.at_round_off > 0) return "lost, round-off";
  return estimate.blown_up > 0 ? "lost" : estimate.at_round_off > 0 ? "round-off" : "";
}

std::string largest(const Curve& curve, const Quantity& quantity) {
  std::optional<double> most;
  for (const auto* run : curve.runs) {
    if (const auto found = value(*run, quantity)) most = std::max(most.value_or(0), *found);
  }
  return most ? number(*most) : "";
}

std::string range_of_steps(const Curve& curve) {
  const auto first = abscissa(*curve.runs.front()), last = abscissa(*curve.runs.back());
  if (!first || !last) return "";
  const auto range = *first == *last ? rounded(*first) : fmt::format("{} … {}", rounded(*first), rounded(*last));
  return curve.adaptive ? "tol. " + range : range + " s";
}

}  // namespace

std::string energy_trend(const RunRecord& run) {
  const RunResult& r = run.result;
  const auto most = value(run, quantity::energy_drift());
  if (!most) return "";
  const std::string& c = r.drift_class;
  if (*most <= round_off_level(run, quantity::energy_drift()) || c == "round-off") return "round-off";
  if (c == "bounded") return "comes back";
  if (c == "undecided") return "undecided";
  const double end = r.energy_drift_final_rel.value_or(0);
  const bool one_way = c == "sublinear" || c == "linear" || c == "quadratic" || c == "faster";
  if (one_way) return r.energy_drift_rate.value_or(end) > 0 ? "gains" : "loses";
  if (!(std::abs(end) >= 0.1 * *most)) return "comes back";
  return end > 0 ? "gains" : "loses";
}

std::string energy_trend(const Curve& curve) {
  std::set<std::string> trends;
  for (const auto* run : curve.runs) {
    if (auto trend = energy_trend(*run); !trend.empty()) trends.insert(std::move(trend));
  }
  if (trends.size() > 1) trends.erase("round-off");
  if (trends.size() > 1) trends.erase("undecided");
  if (trends.size() > 1) trends.erase("comes back");
  return fmt::format("{}", fmt::join(trends, " or "));
}

Table method_table(const Grouping& grouping) {
  using Kind = Column::Kind;
  Table table{
      .caption =
          "In brackets: the number of points behind a slope. In its place where the data do not tell it: round-off, "
          "errors "
          "at round-off; lost, steps too large (an attitude off by more than half a radian, a drift above 0.5, or a "
          "run that did not end); uncertain, points on no line or too few of them. The energy column says what becomes "
          "of the energy",
      .columns = {{"method", "", Kind::name},
                  {.header = "motion", .kind = Kind::text, .apart = true},
                  {"formulation", "", Kind::text},
                  {"steps", "", Kind::text},
                  {.header = "energy drift, largest step", .best = Column::Best::least},
                  {.header = "energy drift, smallest step", .best = Column::Best::least},
                  {"slope, energy drift"},
                  {"slope, attitude error"},
                  {"declared order"},
                  {"energy", "", Kind::text},
                  {.header = "angular momentum drift, largest", .best = Column::Best::least},
                  {.header = "orientation defect, largest", .best = Column::Best::least}},
      .rows = {}};
  for (const auto& curve : grouping.curves) {
    const auto& method = grouping.methods[curve.method_index];
    const auto energy = quantity::energy_drift();
    const bool several = curve.runs.size() > 1;
    table.rows.push_back({method, grouping.cases.size() > 1 ? grouping.cases[curve.case_index].label() : "",
                          grouping.variants[curve.variant_index], range_of_steps(curve),
                          printed(*curve.runs.front(), energy), several ? printed(*curve.runs.back(), energy) : "",
                          slope_text(curve, energy), slope_text(curve, quantity::attitude_error()),
                          declared_text(curve), energy_trend(curve), largest(curve, quantity::angular_momentum_drift()),
                          largest(curve, quantity::orientation_defect())});
  }
  return without_empty_columns(std::move(table));
}

}  // namespace polhode::study::report::findings
