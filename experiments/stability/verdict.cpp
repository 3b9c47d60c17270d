// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/study/curves/curves.hpp"

namespace polhode::study::stability {
namespace {

struct Range {
  double low = 0, high = 0;
  bool empty = true;

  void add(double x) {
    low = empty ? x : std::min(low, x);
    high = empty ? x : std::max(high, x);
    empty = false;
  }
  double middle() const { return (low + high) / 2; }
  double width() const { return high - low; }
};

std::array<Range, 4> quarters(const RunResult& result) {
  std::array<Range, 4> ranges;
  const double end = result.series.back().t;
  for (const SeriesPoint& p : result.series) {
    const double quarter = end > 0 ? 4 * p.t / end : 0;
    ranges[static_cast<std::size_t>(std::min(3.0, quarter))].add(p.energy_drift_rel);
  }
  ranges[3].add(*result.energy_drift_final_rel);
  return ranges;
}

/// The permanent change of the relative energy drift, signed; 0: there is none.
double change_for_good(const std::array<Range, 4>& q) {
  const double moved = q[3].middle() - q[0].middle();
  const auto follows = [&](std::size_t i) { return (q[i].middle() - q[i - 1].middle()) * moved > 0; };
  double widest = 0;
  for (const Range& range : q) widest = std::max(widest, range.width());
  if (follows(1) && follows(2) && follows(3) && std::abs(moved) > verdict::trend * widest) return moved;
  return std::abs(q[3].middle()) > verdict::settled * q[3].width() ? q[3].middle() : 0;
}

/// Largest relative change of the energy that rounding explains.
double rounding(const RunRecord& run) {
  const RunResult& r = run.result;
  const bool measured = r.energy_round_off && r.energy_scale && *r.energy_scale > 0;
  return std::max(4 * round_off_level(run), measured ? *r.energy_round_off / *r.energy_scale : 0);
}

/// Least-squares slope of the energy drift over the energy scale, 1/s.
std::optional<double> slope(const RunResult& r) {
  if (!r.energy_drift_rate || !r.energy_scale) return std::nullopt;
  return *r.energy_drift_rate / *r.energy_scale;
}

}  // namespace

Verdict stability_verdict(const RunRecord& run, std::optional<double> turn) {
  const RunResult& r = run.result;
  if (r.status == "refused") return Verdict::none;
  if (r.status != "ok" || r.series.empty() || !r.energy_drift_max_rel || !r.energy_drift_final_rel) {
    return Verdict::blown_up;
  }
  if (*r.energy_drift_max_rel > verdict::lost || r.orientation_defect_max.value_or(0) > verdict::lost) {
    return Verdict::blown_up;
  }
  const auto q = quarters(r);
  if (std::any_of(q.begin(), q.end(), [](const Range& range) { return range.empty; })) return Verdict::stable;
  const double change = change_for_good(q);
  if (std::abs(change) <= std::max(verdict::counted, rounding(run))) return Verdict::stable;
  if (change < 0) return Verdict::damped;
  if (!turn) return Verdict::gaining;
  const double fitted = slope(r).value_or(0) * r.t_reached;
  const bool slow = std::max(change, fitted) <= verdict::slow * std::max(1.0, r.t_reached / *turn);
  return slow ? Verdict::gaining_slowly : Verdict::gaining;
}

std::optional<double> energy_gain_rate(const RunRecord& run) {
  return stability_verdict(run) == Verdict::blown_up ? std::nullopt : slope(run.result);
}

}  // namespace polhode::study::stability
