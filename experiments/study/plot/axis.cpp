// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plot {

namespace {

constexpr int max_ticks = 7;
constexpr double first_lane = 0.035, lane_height = 0.04;  // height of a lane, over the height of a panel
constexpr std::size_t most_lanes = 10;                    // further curves share them
constexpr double all_zero_floor = 1e-17;                  // floor under round-off, where nothing else sets the scale

int floor_decade(double value) { return static_cast<int>(std::floor(std::log10(value) + 1e-9)); }
int ceil_decade(double value) { return static_cast<int>(std::ceil(std::log10(value) - 1e-9)); }
double decade(int exponent) { return std::pow(10.0, exponent); }

Tick decade_tick(int exponent, bool negative = false) {
  return {negative ? -decade(exponent) : decade(exponent), fmt::format("{}10^{{{}}}", negative ? "−" : "", exponent)};
}

/// A step between ticks so that no more than max_ticks stand on so many decades.
int stride(int decades) { return std::max(1, (decades + max_ticks - 1) / max_ticks); }

/// Ticks at 1, 2 and 5 times powers of ten, for an axis too short for whole decades.
std::vector<Tick> short_log_ticks(double low, double high) {
  std::vector<Tick> ticks;
  for (int e = floor_decade(low); e <= ceil_decade(high); ++e) {
    for (const int m : {1, 2, 5}) {
      // m / 10^-e is the double that the text "2e-4" reads as; m * 10^e is not.
      const double at = e < 0 ? m / decade(-e) : m * decade(e);
      if (at >= low && at <= high) ticks.push_back({at, exact_number(at)});
    }
  }
  if (ticks.empty()) ticks.push_back({low, number(low)});
  return ticks;
}

/// Ticks at multiples of the stride, so that 10^0 is among them where it is on the axis.
std::vector<Tick> decade_ticks(int low, int high) {
  std::vector<Tick> ticks;
  const int step = stride(high - low);
  for (int e = low; e <= high; ++e) {
    if (e % step == 0) ticks.push_back(decade_tick(e));
  }
  return ticks;
}

}  // namespace

double Axis::place(double value) const {
  switch (scale) {
    case Scale::linear: return value;
    case Scale::logarithmic: return std::log10(value);
    default: return std::copysign(std::asinh(std::abs(value) / threshold), value) / std::numbers::ln10;
  }
}

double Axis::value_at(double place) const {
  switch (scale) {
    case Scale::linear: return place;
    case Scale::logarithmic: return std::pow(10.0, place);
    default: return std::copysign(threshold * std::sinh(std::abs(place) * std::numbers::ln10), place);
  }
}

Axis time_axis(double high) { return linear_axis("time (s)", 0, high); }

Axis linear_axis(std::string label, double low, double high) {
  Axis axis{.label = std::move(label), .low = low, .high = high};
  const double rough = (high - low) / 5;
  const double unit = decade(floor_decade(rough));
  const double step = rough / unit < 1.5   ? unit
                      : rough / unit < 3.5 ? 2 * unit
                      : rough / unit < 7.5 ? 5 * unit
                                           : 10 * unit;
  const double slack = 1e-9 * (high - low);
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) {
    const double at = k * step + 0.0;  // never −0
    axis.ticks.push_back({at, number(at, 6)});
  }
  return axis;
}

Axis step_axis(std::string label, const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double margin = std::pow(std::max(*high / *low, 10.0), 0.05);
  Axis axis{.label = std::move(label), .scale = Scale::logarithmic, .low = *low / margin, .high = *high * margin};
  const int first = ceil_decade(axis.low), last = floor_decade(axis.high);
  axis.ticks = last - first >= 1 ? decade_ticks(first, last) : short_log_ticks(axis.low, axis.high);
  return axis;
}

Needs needs_of(const std::vector<Panel>& panels) {
  Needs needs;
  for (const auto& panel : panels) {
    std::size_t crosses = 0;
    for (const auto& curve : panel.curves) {
      const auto has = [&](Mark mark) {
        return std::any_of(curve.points.begin(), curve.points.end(), [&](const auto& p) { return p.mark == mark; });
      };
      needs.floor = needs.floor || has(Mark::zero);
      crosses += has(Mark::edge);
    }
    needs.crosses = std::max(needs.crosses, crosses);
  }
  return needs;
}

Axis log_axis(std::string label, const std::vector<double>& values, Needs needs) {
  int first = floor_decade(all_zero_floor) + 1, last = first + 2;
  if (!values.empty()) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    first = floor_decade(*low);
    last = std::max(ceil_decade(*high), first + 1);
  }
  Axis axis{.label = std::move(label), .scale = Scale::logarithmic, .ticks = decade_ticks(first, last)};
  // A zero stands further below the lowest decade the more decades there are, so that it is seen to stand apart.
  const double gap = std::max(0.5, 0.08 * (last - first)), margin = 0.025 * (last - first);
  axis.low = std::pow(10.0, first - (needs.floor ? 2 * gap : margin));
  const double lanes = first_lane + lane_height * static_cast<double>(std::min(needs.crosses, most_lanes));
  const double room_for_crosses = lanes / (1 - lanes) * (last - floor_decade(axis.low));
  axis.high = std::pow(10.0, last + (needs.crosses > 0 ? std::max(gap, room_for_crosses) : margin));
  if (needs.floor) {
    axis.ticks.insert(axis.ticks.begin(), Tick{std::pow(10.0, first - gap), "0"});
  }
  return axis;
}

double floor_of(const Axis& axis) {
  const auto zero =
      std::find_if(axis.ticks.begin(), axis.ticks.end(), [](const auto& tick) { return tick.label == "0"; });
  return zero == axis.ticks.end() ? axis.low : zero->at;
}

double edge_of(const Axis& axis, bool up, std::size_t lane) {
  const double low = axis.place(axis.low), high = axis.place(axis.high);
  const double inside = (first_lane + lane_height * static_cast<double>(lane % most_lanes)) * (high - low);
  return axis.value_at(up ? high - inside : low + inside);
}

Axis symlog_axis(std::string label, double lowest, double highest, double smallest_curve) {
  Axis axis{.label = std::move(label), .scale = Scale::symlog};
  axis.threshold = smallest_curve > 0 ? std::max(1e-16, decade(floor_decade(smallest_curve) - 2)) : 1e-16;
  const double above = axis.place(std::max(highest, axis.threshold)),
               below = axis.place(std::min(lowest, -axis.threshold));
  const double margin = 0.04 * (above - below);
  axis.high = axis.value_at(above + margin);
  axis.low = axis.value_at(below - margin);

  const int first = floor_decade(axis.threshold) + 1;
  const int top = floor_decade(axis.high), bottom = floor_decade(-axis.low);
  const int step = stride(std::max(0, top - first) + std::max(0, bottom - first) + 1);
  const int nearest = first + step / 2;  // not on top of the tick at zero
  for (int e = nearest; e <= std::max(top, bottom); ++e) {
    if (e % step != 0) continue;
    if (e <= bottom) axis.ticks.push_back(decade_tick(e, true));
    if (e <= top) axis.ticks.push_back(decade_tick(e));
  }
  axis.ticks.push_back({0, "0"});
  std::sort(axis.ticks.begin(), axis.ticks.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  return axis;
}

std::size_t labels_apart(const Axis& axis, double length, double width) {
  double least = axis.place(axis.high) - axis.place(axis.low);
  const double whole = least;
  for (std::size_t i = 1; i < axis.ticks.size(); ++i)
    least = std::min(least, axis.place(axis.ticks[i].at) - axis.place(axis.ticks[i - 1].at));
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(width / (least / whole * length) - 1e-9)));
}

void share_y_axis(std::vector<Panel>& panels, const Axis& axis) {
  for (auto& panel : panels) {
    panel.y = axis;
    std::size_t lanes[2] = {0, 0};  // numbers of lanes in use, at the bottom and at the top
    for (auto& curve : panel.curves) {
      bool crosses[2] = {false, false};
      for (auto& point : curve.points) {
        const bool up = !(point.value < 0);
        point.drawn = point.mark == Mark::value  ? point.value
                      : point.mark == Mark::zero ? floor_of(axis)
                                                 : edge_of(axis, up, lanes[up]);
        if (point.mark == Mark::edge) crosses[up] = true;
      }
      for (const bool up : {false, true}) lanes[up] += crosses[up];
    }
  }
}

}  // namespace polhode::study::plot
