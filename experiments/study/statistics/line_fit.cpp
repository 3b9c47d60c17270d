// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/line_fit.hpp"

#include <algorithm>
#include <cmath>

namespace polhode::study::inline statistics {

LineFit fit_line(std::span<const LinePoint> points) {
  const auto n = static_cast<double>(points.size());
  double x = 0, y = 0, xx = 0, xy = 0, rest = 0;
  for (const LinePoint& p : points) x += p.x / n, y += p.y / n;
  for (const LinePoint& p : points) xx += (p.x - x) * (p.x - x), xy += (p.x - x) * (p.y - y);
  LineFit line{.slope = xy / xx};
  for (const LinePoint& p : points) {
    const double off = p.y - y - line.slope * (p.x - x);
    rest += off * off;
    line.worst = std::max(line.worst, std::abs(off));
  }
  line.standard_error = std::sqrt(rest / (n - 2) / xx);
  return line;
}

}  // namespace polhode::study::statistics
