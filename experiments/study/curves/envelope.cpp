// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/curves/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::study::inline curves {
namespace {

bool usable(const WorkPoint& p) { return std::isfinite(p.error) && p.error > 0 && std::isfinite(p.cost) && p.cost > 0; }

/// Points with a positive and finite error and cost, in ascending order of cost.
std::vector<WorkPoint> by_cost(std::vector<WorkPoint> curve) {
  std::erase_if(curve, [](const WorkPoint& p) { return !usable(p); });
  std::stable_sort(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  return curve;
}

std::optional<double> cost_along(double error, const std::vector<WorkPoint>& sorted) {
  const auto reached = std::find_if(sorted.begin(), sorted.end(), [&](const WorkPoint& p) { return p.error <= error; });
  if (reached == sorted.end()) return std::nullopt;
  if (reached == sorted.begin()) return reached->cost;
  const WorkPoint &a = *(reached - 1), &b = *reached;
  const double s = std::log(a.error / error) / std::log(a.error / b.error);
  return a.cost * std::pow(b.cost / a.cost, s);
}

}  // namespace

std::optional<double> cost_to_reach(double error, const std::vector<WorkPoint>& curve) {
  return cost_along(error, by_cost(curve));
}

std::vector<EnvelopePoint> lower_envelope(const std::vector<std::vector<WorkPoint>>& curves, double lost) {
  std::vector<std::vector<WorkPoint>> sorted;
  double best = std::numeric_limits<double>::infinity(), worst = 0;
  for (auto curve : curves) {
    std::erase_if(curve, [&](const WorkPoint& p) { return p.error >= lost; });
    sorted.push_back(by_cost(std::move(curve)));
    for (const WorkPoint& p : sorted.back()) best = std::min(best, p.error), worst = std::max(worst, p.error);
  }
  std::vector<EnvelopePoint> envelope;
  if (worst == 0) return envelope;
  constexpr double nearly = 1e-9;  // tolerance for decades at the ends, which covers rounding
  for (int k = static_cast<int>(std::floor(std::log10(worst) + nearly)); k >= std::log10(best) - nearly; --k) {
    const double error = std::pow(10.0, k) * (1 + nearly);
    std::vector<std::pair<double, std::size_t>> costs;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      if (const auto cost = cost_along(error, sorted[i])) costs.emplace_back(*cost, i);
    }
    if (costs.empty()) continue;
    std::sort(costs.begin(), costs.end());
    EnvelopePoint point{.decade = k, .curve = costs[0].second, .cost = costs[0].first};
    point.at_most = sorted[point.curve].front().error < error / (1 + 2 * nearly);
    if (costs.size() > 1) point.next = costs[1].second, point.next_cost = costs[1].first;
    envelope.push_back(point);
  }
  return envelope;
}

}  // namespace polhode::study::curves
