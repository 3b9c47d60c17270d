// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/traits/order_finding.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/integrator.hpp"

namespace polhode::study {
namespace {

constexpr double tolerance_margin = 0.4;  // of the slope against a tolerance, as the laws of integrators have it
constexpr double lost = 0.5;              // rad, or m: such an error says nothing about an order

Verdict verdict_of(OrderVerdict seen) {
  switch (seen) {
    case OrderVerdict::as_declared:
    case OrderVerdict::exact_here: return Verdict::holds;
    case OrderVerdict::higher:
    case OrderVerdict::lower: return Verdict::does_not_hold;
    default: return Verdict::undecided;
  }
}

std::string note_of(const OrderEstimate& estimate, OrderVerdict seen) {
  if (estimate.exact) return "round-off at every step";
  std::string note;
  if (estimate.line) note = fmt::format("± {:.2f} over {} points", estimate.line->half_width_95, estimate.points);
  if (seen == OrderVerdict::as_declared) return note;
  return note.empty() ? text(seen) : note + "; " + text(seen);
}

}  // namespace

OrderSettings order_settings(bool adaptive) {
  OrderSettings settings;
  settings.lost = lost;
  if (adaptive) {
    settings.straightness = std::numeric_limits<double>::infinity();
    settings.least_fall = 0;
  }
  return settings;
}

Finding order_finding(std::string trait, bool adaptive, int declared, std::vector<LadderPoint> ladder,
                      OrderSettings settings) {
  Finding finding;
  finding.trait = std::move(trait);
  finding.unit = "1";
  const auto estimate = estimate_order(std::move(ladder), settings);
  if (estimate.line) finding.measured = estimate.line->order;
  if (adaptive) {
    finding.declared = "1, against the tolerance";
    const auto seen = judge(estimate, 1.0);
    finding.verdict = verdict_of(seen);
    finding.note = note_of(estimate, OrderVerdict::as_declared);
    if (estimate.line && !estimate.exact) {
      finding.verdict = std::abs(estimate.line->order - 1) <= tolerance_margin ? Verdict::holds : Verdict::does_not_hold;
    }
    return finding;
  }
  const bool exact = declared == Declaration::exact_order;
  finding.declared = exact ? "exact" : std::to_string(declared);
  const auto seen = judge(estimate, exact ? std::nullopt : std::optional<double>(declared));
  finding.verdict = verdict_of(seen);
  finding.note = note_of(estimate, seen);
  return finding;
}

}  // namespace polhode::study
