// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/plot/thinned.hpp"

#include <algorithm>
#include <array>

namespace polhode::study::plot_program {

void ThinnedCurve::add(double t, double y) {
  const SeriesValue value{t, y};
  if (in_last_ == of_a_stretch_ || stretches_.empty()) {
    if (stretches_.size() == most_) merge_neighbours();
    if (in_last_ == of_a_stretch_ || stretches_.empty()) {
      stretches_.push_back({value, value, value, value});
      in_last_ = 1;
      return;
    }
  }
  Stretch& open = stretches_.back();
  if (y < open.least.y) open.least = value;
  if (y > open.largest.y) open.largest = value;
  open.last = value;
  ++in_last_;
}

void ThinnedCurve::merge_neighbours() {
  std::size_t n = 0;
  for (std::size_t k = 0; k + 1 < stretches_.size(); k += 2, ++n) {
    const Stretch &a = stretches_[k], &b = stretches_[k + 1];
    stretches_[n] = {a.first, b.least.y < a.least.y ? b.least : a.least,
                     b.largest.y > a.largest.y ? b.largest : a.largest, b.last};
  }
  stretches_.resize(n);
  of_a_stretch_ *= 2;
  in_last_ = of_a_stretch_;  // the last one is full
}

std::vector<SeriesValue> ThinnedCurve::points() const {
  std::vector<SeriesValue> points;
  for (const Stretch& s : stretches_) {
    std::array all = {s.first, s.least, s.largest, s.last};
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
    for (const SeriesValue& p : all) {
      if (points.empty() || points.back().t != p.t || points.back().y != p.y) points.push_back(p);
    }
  }
  return points;
}

}  // namespace polhode::study::plot_program
