// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/curves/error_ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "experiments/study/curves/reference_words.hpp"

namespace polhode::study::inline curves {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A velocity or a force has no scale of its own: it is too large where the motion is lost.
bool is_too_large(const RunRecord& run, const Curve& curve, const Quantity& quantity) {
  if (!quantity.bounded && !quantity.of_place) return off_the_motion(run, curve);
  const auto found = value(run, quantity);
  return found && !(*found < lost_to_fits / motion_lost * lost_level(curve, quantity));
}

std::string too_large_words(const Quantity& quantity) {
  if (quantity.unit == " rad") return "the attitude is off by more than half a radian";
  if (quantity.of_place) return "the position is off by more than half of the way that the motion goes";
  if (!quantity.bounded) return "the motion is lost";
  return fmt::format("the {} is above 0.5", quantity.words);
}

/// "the attitude is off by more than half a radian", "the run did not end".
std::string why_lost(const Curve& curve, const Quantity& quantity) {
  const auto any = [&](auto test) { return std::any_of(curve.runs.begin(), curve.runs.end(), test); };
  std::vector<std::string> reasons;
  if (any([&](const auto* run) { return is_too_large(*run, curve, quantity); })) {
    reasons.push_back(too_large_words(quantity));
  }
  if (any([](const auto* run) { return ended_early(*run); })) reasons.emplace_back("the run did not end");
  return fmt::format("{}", fmt::join(reasons, ", or "));
}

}  // namespace

std::vector<LadderPoint> error_ladder(const Curve& curve, const Quantity& quantity) {
  std::vector<LadderPoint> points;
  for (const auto* run : curve.runs) {
    if (!completed(*run) && !ended_early(*run)) continue;  // refused
    LadderPoint point{abscissa(*run).value_or(0), infinite, round_off_level(*run, quantity)};
    if (const auto found = value(*run, quantity); found && !is_too_large(*run, curve, quantity)) point.error = *found;
    if (completed(*run) && !quantity.of(run->result) && used_reference(*run))
      point.error = 0, point.round_off = infinite;
    points.push_back(point);
  }
  return points;
}

OrderEstimate observed_order(const Curve& curve, const Quantity& quantity) {
  OrderSettings settings = curve.adaptive ? of_chosen_steps : OrderSettings{};
  settings.epsilon = epsilon(curve.runs.front()->config.precision);
  return estimate_order(error_ladder(curve, quantity), settings);
}

std::optional<OrderEstimate::Line> told_line(const OrderEstimate& estimate) {
  const bool tells = estimate.line && estimate.straight && estimate.line->half_width_95 <= widest_order_interval;
  return tells ? estimate.line : std::nullopt;
}

std::string why_not_told(const Curve& curve, const Quantity& quantity, const OrderEstimate& estimate) {
  if (estimate.line) return estimate.straight ? "too few points for a line within ±0.5" : "the points lie on no line";
  const auto lost = fmt::format("steps too large: {}", why_lost(curve, quantity));
  if (estimate.blown_up > 0 && estimate.at_round_off > 0) return fmt::format("errors at round-off, or {}", lost);
  if (estimate.blown_up > 0) return lost;
  return estimate.at_round_off > 0 ? "errors at round-off" : "fewer than three steps";
}

}  // namespace polhode::study::curves
