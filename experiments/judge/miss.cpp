// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/miss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace polhode::study::judge {
namespace {

/// Advances the motion from one row to another. Returns false if that is not possible.
bool carry(const RowStates& rows, const Hypothesis& h, const FaultyMotion& motion, std::size_t from, std::size_t to,
           VectorX<double>& y) {
  const auto& t = rows.trajectory.times;
  if (h.steps.per_row == 0) return motion.advance(h.clock * t[from] + h.shift, h.clock * (t[to] - t[from]), y);
  for (std::size_t k = from; k < to; ++k) {
    const double size = (t[k + 1] - t[k]) / h.steps.per_row;
    for (int i = 0; i < h.steps.per_row; ++i) motion.step(t[k] + i * size, size, h.steps.by, y);
  }
  return y.allFinite();
}

/// Advances the motion from the scenario's start to row 0. Returns false if that is not possible.
bool carry_to_first(const RowStates& rows, const Hypothesis& h, const FaultyMotion& motion, VectorX<double>& y) {
  const auto& times = rows.trajectory.times;
  const double t = h.clock * times.front() + h.shift;
  if (h.steps.per_row == 0 || times.front() == 0) return motion.advance(0, t, y);
  const double size = (times[1] - times[0]) / h.steps.per_row;
  const int steps = static_cast<int>(std::clamp(std::round(t / size), 1.0, 1e5));
  for (int i = 0; i < steps; ++i) motion.step(i * t / steps, t / steps, h.steps.by, y);
  return y.allFinite();
}

}  // namespace

double typical(std::vector<double> misses) {
  std::sort(misses.begin(), misses.end());
  misses.resize(misses.size() - misses.size() / 10);
  double sum = 0;
  for (const double x : misses) sum += x * x;
  return std::sqrt(sum / static_cast<double>(misses.size()));
}

std::vector<VectorX<double>> motion_at_first_rows(const RowStates& rows, const Hypothesis& h,
                                                  const FaultyMotion& motion) {
  std::vector<VectorX<double>> states;
  VectorX<double> y = rows.start(h.start);
  if (!carry_to_first(rows, h, motion, y)) return states;
  states.push_back(y);
  for (std::size_t i = 1; i < rows.first.size(); ++i) {
    if (!carry(rows, h, motion, rows.first[i - 1], rows.first[i], y)) break;
    states.push_back(y);
  }
  return states;
}

double miss_of_start(const RowStates& rows, const Hypothesis& h) {
  const FaultyMotion motion(h.problem, h.equations);
  VectorX<double> y = rows.start(h.start);
  return carry_to_first(rows, h, motion, y) ? rows.distance(y, rows.state(0, h.reading)) : std::numbers::pi;
}

double miss_of(const RowStates& rows, const Hypothesis& h, std::size_t stride) {
  const FaultyMotion motion(h.problem, h.equations);
  std::vector<double> misses;
  for (std::size_t i = 0; i < rows.spans.size(); i += stride) {
    const auto [from, to] = rows.spans[i];
    VectorX<double> y = rows.state(from, h.reading);
    misses.push_back(carry(rows, h, motion, from, to, y) ? rows.distance(y, rows.state(to, h.reading))
                                                         : std::numbers::pi);
  }
  const double over_spans = typical(std::move(misses));
  if (rows.first.empty()) return over_spans;
  misses.assign(rows.first.size(), std::numbers::pi);
  const auto states = motion_at_first_rows(rows, h, motion);
  for (std::size_t i = 0; i < states.size(); ++i)
    misses[i] = rows.distance(states[i], rows.state(rows.first[i], h.reading));
  return std::hypot(over_spans, typical(std::move(misses)));
}

}  // namespace polhode::study::judge
