// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/precision/growth_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/study/statistics/quantiles.hpp"

namespace polhode::study::precision {
namespace {

constexpr int most_octaves = 5;
constexpr std::size_t least_octaves = 4, least_points = 3, least_paths = 3;
constexpr double margin = 0.2;

/// The mean square over [from, to] by the trapezoidal rule; −1 for fewer than three points.
double mean_square(const std::vector<PathPoint>& path, double from, double to) {
  constexpr double slack = 1e-9;
  double sum = 0, first = 0, last = 0;
  std::size_t n = 0;
  for (const PathPoint& p : path) {
    if (p.t < from * (1 - slack) || p.t > to * (1 + slack)) continue;
    last = p.value * p.value;
    if (n++ == 0) first = last;
    sum += last;
  }
  return n < least_points ? -1 : (sum - (first + last) / 2) / static_cast<double>(n - 1);
}

Growth judge(const GrowthEstimate& estimate, double bounded) {
  if (!(estimate.half_width_95 <= margin)) return Growth::not_told;
  const double p = estimate.exponent - bounded;
  if (std::abs(p) <= margin) return Growth::bounded;
  if (std::abs(p - 0.5) <= margin) return Growth::random_walk;
  return std::abs(p - 1) <= margin ? Growth::linear : Growth::not_told;
}

}  // namespace

std::optional<double> path_exponent(const std::vector<PathPoint>& path) {
  if (path.empty()) return std::nullopt;
  std::vector<double> logs;  // log2 of the root mean squares, the last octave first
  double to = path.back().t;
  for (int k = 0; k < most_octaves; ++k, to /= 2) {
    const double square = mean_square(path, to / 2, to);
    if (square < 0) break;
    if (!(square > 0) || !std::isfinite(square)) return std::nullopt;
    logs.push_back(std::log2(square) / 2);
  }
  if (logs.size() < least_octaves) return std::nullopt;
  const double middle = static_cast<double>(logs.size() - 1) / 2;
  double xx = 0, xy = 0;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    const double x = middle - static_cast<double>(k);
    xx += x * x;
    xy += x * logs[k];
  }
  return xy / xx;
}

std::optional<GrowthEstimate> estimate_growth(const std::vector<double>& path_exponents) {
  const auto n = path_exponents.size();
  if (n < least_paths) return std::nullopt;
  const double count = static_cast<double>(n);
  double mean = 0, rest = 0;
  for (const double p : path_exponents) mean += p / count;
  for (const double p : path_exponents) rest += (p - mean) * (p - mean);
  return GrowthEstimate{mean, students_t_95(count - 1) * std::sqrt(rest / (count - 1) / count), n};
}

std::string word_of(Growth growth) {
  switch (growth) {
    case Growth::bounded: return "bounded";
    case Growth::random_walk: return "random walk";
    case Growth::linear: return "linear";
    default: return "not told";
  }
}

Growth judge_energy_growth(const GrowthEstimate& estimate) { return judge(estimate, 0); }
Growth judge_attitude_growth(const GrowthEstimate& estimate) { return judge(estimate, 1); }

}  // namespace polhode::study::precision
