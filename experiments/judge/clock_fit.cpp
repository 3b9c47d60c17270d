// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/clock_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::judge {
namespace {

/// Minimum of a function between two arguments, by golden-section search.
template <class F>
double lowest(const F& f, double low, double high) {
  constexpr double golden = 0.6180339887498949;
  double a = high - golden * (high - low), b = low + golden * (high - low), at_a = f(a), at_b = f(b);
  for (int i = 0; i < 60; ++i) {
    if (at_a <= at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low), at_a = f(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low), at_b = f(b);
    }
  }
  return (low + high) / 2;
}

/// The shift (s) with the least miss among shifts of up to ten radians of the motion.
template <class Miss>
double best_shift(const Miss& miss, double rate) {
  constexpr double reach = 10, grid = 0.2;  // rad
  constexpr int points = static_cast<int>(reach / grid);
  constexpr std::size_t most_valleys = 5;
  std::vector<double> heights;
  for (int k = -points; k <= points; ++k) heights.push_back(miss(k * grid / rate));
  // A nearly periodic motion has a local minimum at each whole turn. The least minimum counts.
  std::vector<std::size_t> valleys;
  for (std::size_t k = 1; k + 1 < heights.size(); ++k) {
    if (heights[k] <= heights[k - 1] && heights[k] <= heights[k + 1]) valleys.push_back(k);
  }
  std::stable_sort(valleys.begin(), valleys.end(), [&](auto a, auto b) { return heights[a] < heights[b]; });
  valleys.resize(std::min(most_valleys, valleys.size()));
  double shift = 0, least = unknown_miss;
  for (const std::size_t k : valleys) {
    const double middle = (static_cast<double>(k) - points) * grid / rate;
    const double there = lowest(miss, middle - grid / rate, middle + grid / rate);
    if (const double here = miss(there); here < least) shift = there, least = here;
  }
  return shift;
}

/// The rate of the clock with the least miss: within 30 % of 1, or near the ratio of two units of time.
template <class Miss>
double best_rate(const Miss& miss) {
  constexpr double reach = 0.3, grid = 0.01;  // logarithms
  double best = 0, least = unknown_miss;
  for (const double unit : {1e-3, 1.0 / 60, 60.0, 1e3}) {
    if (const double here = miss(std::log(unit)); here < least) best = std::log(unit), least = here;
  }
  for (int k = -static_cast<int>(reach / grid); k <= static_cast<int>(reach / grid); ++k) {
    if (const double here = miss(k * grid); here < least) best = k * grid, least = here;
  }
  return std::exp(lowest(miss, best - grid, best + grid));
}

/// True if ω is nearly constant over the spans, so that the rows determine only the angle of the motion.
bool steady(const RowStates& rows, const Hypothesis& h) {
  constexpr double little = 0.1;  // change of ω over the rotation
  double changes = 0;
  for (const auto& [from, to] : rows.spans) {
    const VectorX<double> a = rows.state(from, h.reading), b = rows.state(to, h.reading);
    for (const Layout::Slot& s : rows.right.system().layout().slots) {
      changes += (a.segment<3>(s.angular) - b.segment<3>(s.angular)).norm() / rows.rate;
    }
  }
  return changes < little * rows.span * static_cast<double>(rows.spans.size() * rows.trajectory.moving);
}

}  // namespace

std::optional<Hypothesis> fitted_shift(const RowStates& rows, const Hypothesis& base) {
  if (rows.first.size() < 3) return std::nullopt;
  const FaultyMotion motion(base.problem, base.equations);
  const std::vector<VectorX<double>> unshifted = motion_at_first_rows(rows, base, motion);
  if (unshifted.size() < rows.first.size()) return std::nullopt;
  std::vector<VectorX<double>> read;
  for (const std::size_t row : rows.first) read.push_back(rows.state(row, base.reading));
  const auto miss = [&](double shift) {
    std::vector<double> misses;
    for (std::size_t i = 0; i < read.size(); ++i) {
      VectorX<double> y = unshifted[i];
      const bool followed = motion.advance(rows.trajectory.times[rows.first[i]], shift, y);
      misses.push_back(followed ? rows.distance(y, read[i]) : std::numbers::pi);
    }
    return typical(std::move(misses));
  };
  const double shift = best_shift(miss, rows.rate);
  Hypothesis h =
      with_cause(base, "clock_offset",
                 fmt::format("its clock is {} by {} s: each row shows the motion of so much {} than its t_s",
                             shift < 0 ? "fast" : "late", number(std::abs(shift), 4), shift < 0 ? "earlier" : "later"),
                 Part::clock);
  h.shift = shift;
  h.miss = miss_of(rows, h);
  return h;
}

Hypothesis fitted_rate(const RowStates& rows, const Hypothesis& base) {
  constexpr std::size_t few_spans = 6;
  constexpr double least_excusable = 2e-3, most_excusable = 0.08, far_better = 100;
  Hypothesis trial = base;
  const double clock = best_rate([&](double log_clock) {
    trial.clock = std::exp(log_clock);
    return miss_of(rows, trial, rows.stride_for(few_spans));
  });
  Hypothesis h = with_cause(base, "clock_rate",
                            fmt::format("its clock runs {}: in 1 s of t_s the motion goes on by {} s",
                                        clock > 1 ? "slow" : "fast", number(clock, 5)),
                            Part::clock);
  h.clock = clock;
  h.miss = miss_of(rows, h);
  const double excusable = std::clamp(rows.spacing * rows.spacing / 4, least_excusable, most_excusable);
  const double off = std::abs(clock - 1);
  h.excused = off <= least_excusable || (off <= excusable && (h.miss * far_better > base.miss || steady(rows, base)));
  return h;
}

}  // namespace polhode::study::judge
