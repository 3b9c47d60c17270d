// SPDX-License-Identifier: BSD-3-Clause
// The largest value of a quantity over a run.
#pragma once

#include <cmath>
#include <optional>

namespace polhode::study::inline metrics {

/// Raises the largest value so far to the present one. Numbers that are not finite are left out.
inline void raise(std::optional<double>& worst, double now) {
  if (std::isfinite(now) && !(worst && *worst >= now)) worst = now;
}

}  // namespace polhode::study::metrics
