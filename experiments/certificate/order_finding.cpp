// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/order_finding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/run/integrator.hpp"

namespace polhode::study::certificate {
namespace {

constexpr double order_margin = 0.25;
constexpr double above_rounding = 10;
constexpr double tolerance_margin = 0.4;  // margin of the slope against the tolerance, as in the laws of integrators
constexpr double straightness = 0.03;  // deviation in ln(error); small, since multistep methods reach their order late

TraitVerdict verdict_of(OrderVerdict seen) {
  switch (seen) {
    case OrderVerdict::as_declared:
    case OrderVerdict::exact_here: return TraitVerdict::holds;
    case OrderVerdict::higher:
    case OrderVerdict::lower: return TraitVerdict::does_not_hold;
    default: return TraitVerdict::undecided;
  }
}

TraitVerdict against_tolerance(const OrderEstimate& estimate) {
  if (estimate.exact) return TraitVerdict::holds;
  if (!estimate.line) return TraitVerdict::undecided;
  const double off = std::abs(estimate.line->order - 1);
  if (off <= tolerance_margin) return TraitVerdict::holds;
  return off <= estimate.line->half_width_95 ? TraitVerdict::undecided : TraitVerdict::does_not_hold;
}

/// The order between the two smallest steps with an error above round-off. Absent unless the last three orders between
/// neighbouring steps approach `declared`.
std::optional<double> limit_order(std::vector<LadderPoint> ladder, double largest, double declared) {
  std::erase_if(ladder, [&](const LadderPoint& p) {
    return !(p.error < largest && p.error > above_rounding * p.round_off && p.step > 0);
  });
  std::sort(ladder.begin(), ladder.end(), [](const auto& a, const auto& b) { return a.step > b.step; });
  std::vector<double> orders;
  for (std::size_t k = 1; k < ladder.size(); ++k) {
    orders.push_back(std::log(ladder[k - 1].error / ladder[k].error) / std::log(ladder[k - 1].step / ladder[k].step));
  }
  if (orders.size() < 3) return std::nullopt;
  const auto off = [&](std::size_t from_end) { return std::abs(orders[orders.size() - from_end] - declared); };
  return off(3) > off(2) && off(2) > off(1) ? std::optional(orders.back()) : std::nullopt;
}

std::string note_of(const OrderEstimate& estimate, OrderVerdict seen) {
  if (estimate.exact) return "round-off at every step";
  std::string note;
  if (estimate.line) note = fmt::format("± {:.2f} over {} points", estimate.line->half_width_95, estimate.points);
  if (seen == OrderVerdict::as_declared) return note;
  return note.empty() ? word_of(seen) : note + "; " + word_of(seen);
}

}  // namespace

OrderSettings order_settings(bool adaptive) {
  OrderSettings settings = adaptive ? of_chosen_steps : OrderSettings{.straightness = straightness};
  settings.lost = lost_to_fits;
  return settings;
}

Finding order_finding(std::string trait, bool adaptive, int declared, std::vector<LadderPoint> ladder,
                      OrderSettings settings) {
  Finding finding;
  finding.trait = std::move(trait);
  finding.unit = "1";
  const auto estimate = estimate_order(ladder, settings);
  if (estimate.line) finding.measured = estimate.line->order;
  if (adaptive) {
    finding.declared = "1, against the tolerance";
    finding.verdict = against_tolerance(estimate);
    finding.note = note_of(estimate, OrderVerdict::as_declared);
    return finding;
  }
  const bool exact = declared == Declaration::exact_order;
  finding.declared = exact ? "exact" : std::to_string(declared);
  const auto seen = order_verdict(estimate, exact ? std::nullopt : std::optional<double>(declared));
  finding.verdict = verdict_of(seen);
  finding.note = note_of(estimate, seen);
  if (exact || finding.verdict == TraitVerdict::holds) return finding;
  const auto limit = limit_order(std::move(ladder), settings.lost, declared);
  if (limit && std::abs(*limit - declared) <= order_margin) {
    finding.note =
        fmt::format("a line through all points has {:.2f}; this is between the last two, and they tend to {}",
                    finding.measured.value_or(0), declared);
    finding.measured = limit;
    finding.verdict = TraitVerdict::holds;
  }
  return finding;
}

}  // namespace polhode::study::certificate
