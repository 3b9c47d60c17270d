// SPDX-License-Identifier: BSD-3-Clause
// A made-up run whose energy drift is a given function of time.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::stability {

/// A finished run of 400 steps with this drift over t from 0 to 1.
inline RunRecord run_of(const std::function<double(double)>& drift, const char* status = "ok") {
  RunRecord run;
  run.result.status = status;
  run.result.t_reached = 1;
  run.result.steps = 400;
  double largest = 0;
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0;
    run.result.series.push_back({.t = t, .energy_drift_rel = drift(t)});
    largest = std::max(largest, std::abs(drift(t)));
  }
  run.result.energy_drift_max_rel = largest;
  run.result.energy_drift_final_rel = drift(1);
  return run;
}

inline double swing(double t) { return 0.5 * (1 - std::cos(2 * std::numbers::pi * 13.3 * t)); }

}  // namespace polhode::study::stability
