// SPDX-License-Identifier: BSD-3-Clause
// A long series as the few points that a figure shows: of each stretch the first, the least, the largest and the last.
#pragma once

#include <cstddef>
#include <vector>

namespace polhode::study::plot_program {

struct SeriesValue {
  double t = 0, y = 0;
};

class ThinnedCurve {
 public:
  /// `stretches`: their largest number; even.
  explicit ThinnedCurve(std::size_t stretches = 1024) : most_(stretches) { stretches_.reserve(stretches); }

  /// Adds a value; times do not decrease.
  void add(double t, double y);
  /// Points in the order of their times: all values, or of each stretch up to four.
  std::vector<SeriesValue> points() const;

 private:
  struct Stretch {
    SeriesValue first, least, largest, last;
  };
  void merge_neighbours();

  std::size_t most_, of_a_stretch_ = 1, in_last_ = 0;
  std::vector<Stretch> stretches_;
};

}  // namespace polhode::study::plot_program
