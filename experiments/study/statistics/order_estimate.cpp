// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/order_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "experiments/study/statistics/line_fit.hpp"
#include "experiments/study/statistics/quantiles.hpp"

namespace polhode::study::inline statistics {
namespace {

constexpr double above_rounding = 10;  ///< error over round-off, from which rounding adds no more than a tenth
constexpr std::size_t least_points = 3, wanted_points = 4;
constexpr double margin = 0.25;

/// Takes away the points at and above the smallest step at which the motion is lost; those left are finite.
void drop_blown_up(std::vector<LadderPoint>& points, double lost, OrderEstimate& estimate) {
  const auto last = std::find_if(points.rbegin(), points.rend(),
                                 [&](const LadderPoint& p) { return !std::isfinite(p.error) || p.error >= lost; });
  estimate.blown_up = static_cast<std::size_t>(points.rend() - last);
  points.erase(points.begin(), last.base());
}

double local_slope(const LadderPoint& larger, const LadderPoint& smaller) {
  return std::log(larger.error / smaller.error) / std::log(larger.step / smaller.step);
}

void drop_round_off(std::vector<LadderPoint>& points, const OrderSettings& settings, OrderEstimate& estimate) {
  const auto before = points.size();
  std::erase_if(points, [](const LadderPoint& p) { return p.error <= above_rounding * p.round_off; });
  double floor = 0;
  // Rounding goes up and down from step to step: two steps show it where one does not.
  const auto falls_from = [&](std::size_t back) {
    return points.size() <= back || local_slope(points[points.size() - 1 - back], points.back()) >= settings.least_fall;
  };
  while (points.size() >= 2 && points.back().error < std::sqrt(settings.epsilon) && !(falls_from(1) && falls_from(2))) {
    floor = std::max(floor, points.back().error);
    points.pop_back();
  }
  std::erase_if(points, [&](const LadderPoint& p) { return p.error <= above_rounding * floor; });
  estimate.floor = floor;
  estimate.at_round_off = before - points.size();
}

bool is_straight(std::span<const LinePoint> points, double straightness) {
  return fit_line(points).worst <= straightness;
}

/// Drops the smallest steps if they deviate, below √ε, from a line that is straight before them: rounding begins there.
void drop_bent_end(std::vector<LinePoint>& logs, const OrderSettings& settings, OrderEstimate& estimate) {
  const double rounding_shows = 0.5 * std::log(settings.epsilon);
  const auto straight_without = [&](std::size_t n) {
    return is_straight(std::span(logs).first(logs.size() - n).last(least_points), settings.straightness);
  };
  while (logs.size() > least_points && logs.back().y < rounding_shows && !straight_without(0) && straight_without(1)) {
    logs.pop_back();
    ++estimate.at_round_off;
  }
}

/// The longest straight stretch that ends at the smallest step.
std::span<const LinePoint> straight_stretch(std::span<const LinePoint> points, double straightness) {
  const auto straight = [&](std::size_t n) { return is_straight(points.last(n), straightness); };
  std::size_t n = std::min(wanted_points, points.size());
  if (!straight(n) && straight(least_points)) n = least_points;
  while (n < points.size() && straight(n + 1)) ++n;
  return points.last(n);
}

}  // namespace

OrderEstimate estimate_order(std::vector<LadderPoint> points, const OrderSettings& settings) {
  OrderEstimate estimate;
  std::erase_if(points, [](const LadderPoint& p) { return !(p.step > 0) || !std::isfinite(p.step); });
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.step > b.step; });
  points.erase(std::unique(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.step == b.step; }),
               points.end());
  drop_blown_up(points, settings.lost, estimate);
  const bool any = !points.empty();
  estimate.exact = any && std::all_of(points.begin(), points.end(), [](const LadderPoint& p) {
                     return std::isfinite(p.round_off) && p.error <= above_rounding * p.round_off;
                   });
  drop_round_off(points, settings, estimate);
  estimate.points = points.size();
  if (points.empty()) return estimate;
  estimate.largest = points.front().step;
  estimate.smallest = points.back().step;
  if (points.size() < least_points) return estimate;

  std::vector<LinePoint> logs;
  for (const LadderPoint& p : points) logs.push_back({std::log(p.step), std::log(p.error)});
  drop_bent_end(logs, settings, estimate);
  points.resize(logs.size());
  estimate.smallest = points.back().step;
  const auto stretch = straight_stretch(logs, settings.straightness);
  const LineFit line = fit_line(stretch);
  estimate.straight = line.worst <= settings.straightness;
  estimate.not_straight = logs.size() - stretch.size();
  estimate.points = stretch.size();
  estimate.largest = points[estimate.not_straight].step;
  estimate.line = OrderEstimate::Line{line.slope, line.standard_error,
                                      students_t_95(static_cast<double>(stretch.size() - 2)) * line.standard_error};
  return estimate;
}

std::string word_of(OrderVerdict verdict) {
  switch (verdict) {
    case OrderVerdict::as_declared: return "as declared";
    case OrderVerdict::higher: return "higher";
    case OrderVerdict::lower: return "lower";
    case OrderVerdict::exact_here: return "exact here";
    case OrderVerdict::too_few: return "not seen: too few points";
    default: return "not seen: points scatter";
  }
}

OrderVerdict order_verdict(const OrderEstimate& estimate, std::optional<double> declared) {
  if (estimate.exact) return declared ? OrderVerdict::exact_here : OrderVerdict::as_declared;
  if (!estimate.line) return OrderVerdict::too_few;
  const auto& [order, standard_error, half_width] = *estimate.line;
  if (half_width > widest_order_interval) return OrderVerdict::scattered;
  if (!declared) return OrderVerdict::lower;
  const double off = order - *declared;
  if (std::abs(off) <= margin) return OrderVerdict::as_declared;
  if (std::abs(off) <= half_width) return OrderVerdict::scattered;
  return off > 0 ? OrderVerdict::higher : OrderVerdict::lower;
}

}  // namespace polhode::study::statistics
