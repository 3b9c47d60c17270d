// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/drift_class.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace polhode::study::inline metrics {
namespace {

constexpr double clear_of_round_off = 4;  // smallest significant growth, over round-off
// Smallest growth that oscillations within a block cannot hide, over the largest drift.
constexpr double seen_alone = 1e-3;
// Uncertainty of an oscillation that was subtracted, over its amplitude, times its number of periods.
constexpr double seen_beside = 0.16;
constexpr double rest_still = 0.02;        // largest negligible rest, over the largest drift
constexpr double rest_nearly_still = 0.1;  // the same, if the limit of growth is at most half of it
constexpr double bounded_limit = 0.15;     // largest limit of growth of a bounded drift, over the largest drift
constexpr double blown_up = 0.1;           // drift over the energy scale from which a method blows up
constexpr double swollen = 1.5;            // largest drift over that of the first half, above which a drift may grow
constexpr double periods_enough = 6;       // periods of an oscillation that decide between it and growth
constexpr double most_runs = 1000, fewest_runs = 1.5;  // limits of the duration that would decide, over that of the run

struct ExponentBounds {
  const char* name;
  double from, to;  ///< range of p
};
constexpr ExponentBounds one_way_classes[] = {
    {"sublinear", 0.25, 0.75}, {"linear", 0.75, 1.5}, {"quadratic", 1.5, 2.5}, {"faster", 2.5, 1e9}};
constexpr double walk_from = 0.25, walk_to = 0.75;

std::optional<double> lasting(const DriftRecord& record, double runs) {
  if (!(runs <= most_runs)) return std::nullopt;
  return record.t_end * std::max(runs, fewest_runs);
}

/// Uncertainty of the oscillations that were subtracted, J.
double unknown_of_oscillations(const DriftGrowth& g) {
  return g.slowest_line > 0 ? seen_beside * g.oscillation / g.slowest_line : 0;
}

struct DriftRange {
  double low = 0, high = 0;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  double width() const { return high - low; }
};

/// True if the drift rose or fell and has settled: in the last 40 % of the run it varies by at most a tenth of their
/// mean, and an earlier block differs from that mean by more than three tenths of it.
bool has_settled(std::span<const BlockMean> blocks, double largest) {
  const std::size_t first = blocks.size() * 6 / 10;
  const auto late = blocks.subspan(first);
  double mean = 0;
  for (const BlockMean& b : late) mean += b.value / static_cast<double>(late.size());
  if (!(std::abs(mean) >= largest / 2)) return false;
  DriftRange at_rest;
  for (const BlockMean& b : late) at_rest.add(b.value - mean);
  const auto off = [&](const BlockMean& b) { return std::abs(b.value - mean) > 0.3 * std::abs(mean); };
  const auto early = blocks.first(first);
  return at_rest.width() <= 0.1 * std::abs(mean) && std::any_of(early.begin(), early.end(), off);
}

enum class ImpactPart { none, alone, beside };

/// Role of impacts in the drift: none (or not separable), changes at impacts alone, or changes also between them.
ImpactPart part_of_impacts(const DriftRecord& record) {
  const auto& blocks = record.blocks;
  const std::size_t n = blocks.size();
  if (record.impacts.empty() || n < fewest_blocks) return ImpactPart::none;
  // Block i extends from halfway to the previous block to halfway to the next.
  std::vector<bool> met(n, false);
  std::size_t i = 0;
  for (const double t : record.impacts) {
    while (i + 1 < n && t > (blocks[i].t + blocks[i + 1].t) / 2) ++i;
    met[i] = true;
  }
  DriftRange free, jumps;
  double between = 0, at = 0;
  std::size_t free_changes = 0;
  for (std::size_t k = 1; k < n; ++k) {
    const double change = blocks[k].value - blocks[k - 1].value;
    if (met[k - 1] || met[k]) {
      jumps.add(at += change);
    } else {
      free.add(between += change);
      ++free_changes;
    }
  }
  constexpr double negligible = 0.05;
  if (3 * free_changes < n) return ImpactPart::none;  // lasting contact rather than impacts
  if (jumps.width() <= std::max(record.round_off, negligible * record.largest)) return ImpactPart::none;
  if (free.width() <= std::max(record.round_off, negligible * record.largest)) return ImpactPart::alone;
  return ImpactPart::beside;
}

void decide_as(DriftClass& c, const char* name, double exponent, double low, double high) {
  c.name = name;
  c.decided_after.reset();
  c.exponent = exponent;
  c.low = low;
  c.high = high;
}

/// Duration with enough periods of the slowest known oscillation, s.
std::optional<double> more_periods(const DriftRecord& record, const DriftGrowth& g) {
  constexpr double fewest = 1.5;  // number of periods as which a change over the whole run counts
  const double periods = g.slow_periods > 0 ? g.slow_periods : g.slowest_line;
  return periods > 0 ? lasting(record, periods_enough / std::max(periods, fewest)) : std::nullopt;
}

void classify_one_way(const DriftRecord& record, const DriftGrowth& g, DriftClass& c) {
  if (g.slow_periods > 0) {
    c.decided_after = more_periods(record, g);
    return;
  }
  // Error of p due to the uncertainty of the oscillations and to the residual of the growth, at most.
  constexpr double bends = 4, narrow = 0.2;
  const double bent = bends * (unknown_of_oscillations(g) + g.misfit) / g.change;
  const double half_width = std::hypot((g.high - g.low) / 2, bent);
  const double low = std::max(g.exponent - half_width, 0.0), high = g.exponent + half_width;
  // A sudden rise at the end of a run may be the first of many pulses, as when a body flips over.
  constexpr double sudden = 5, twice = 2;
  if (high > sudden && record.largest < blown_up * record.scale) {
    c.decided_after = lasting(record, twice);
    return;
  }
  for (const ExponentBounds& b : one_way_classes) {
    if (low >= b.from && high < b.to) return decide_as(c, b.name, g.exponent, low, high);
  }
  if (g.exponent > 0) c.decided_after = lasting(record, std::pow(half_width / narrow, 1 / (g.exponent + 0.5)));
}

void classify_both_ways(const DriftRecord& record, const DriftGrowth& g, DriftClass& c) {
  c.decided_after = more_periods(record, g);
  const double rest = g.rest / record.largest, limit = g.change_limit / record.largest;
  if (record.largest > swollen * record.largest_early) return;
  if (rest <= rest_still || (rest <= rest_nearly_still && limit <= rest_nearly_still / 2))
    return decide_as(c, "bounded", 0, 0, 0);
  if (g.secular) return;  // too small to be distinguished from residuals of the oscillations
  if (g.high < walk_from) {
    if (limit <= bounded_limit) return decide_as(c, "bounded", 0, 0, std::max(g.high, 0.0));
    c.decided_after = lasting(record, std::pow(limit / bounded_limit, 2));
  } else if (g.low >= walk_from && g.high < walk_to && g.even && g.rest > clear_of_round_off * record.round_off) {
    return decide_as(c, "random walk", g.exponent, g.low, g.high);
  }
}

}  // namespace

DriftClass classify(const DriftRecord& record) {
  DriftClass c;
  if (record.largest <= record.round_off) {
    c.slope_half_width = slope_half_width_95(record.blocks);
    c.name = "round-off";
    return c;
  }
  const auto growth = growth_of(record.blocks);
  if (growth) c.slope_half_width = growth->slope_half_width_95;
  c.name = "undecided";
  if (record.blocks.size() < fewest_blocks) {
    if (record.samples > 0)
      c.decided_after = lasting(record, static_cast<double>(fewest_blocks) / static_cast<double>(record.samples));
    return c;
  }
  if (const ImpactPart part = part_of_impacts(record); part != ImpactPart::none) {
    if (part == ImpactPart::alone && record.largest > clear_of_round_off * record.round_off) c.name = "jumps";
    return c;
  }
  if (!growth && std::isfinite(record.largest)) {  // constant
    decide_as(c, "bounded", 0, 0, 0);
    return c;
  }
  if (!growth) return c;
  if (has_settled(record.blocks, record.largest)) {
    if (record.largest > clear_of_round_off * record.round_off) c.name = "saturated";
    return c;
  }
  const double seen = std::max(seen_alone * record.largest, unknown_of_oscillations(*growth));
  if (growth->secular && growth->change > seen) {
    if (growth->change > clear_of_round_off * record.round_off) classify_one_way(record, *growth, c);
  } else {
    classify_both_ways(record, *growth, c);
  }
  if (record.scale > 0 && record.largest >= record.scale / 2) {
    // The computed motion is a different one: a longer run would not decide.
    if (c.name == "undecided") c.decided_after.reset();
    if (c.name == "bounded" || c.name == "random walk" || c.name == "sublinear") {
      c.name = "saturated";
      c.exponent = c.low = c.high = std::nullopt;
    }
  }
  return c;
}

}  // namespace polhode::study::metrics
