// SPDX-License-Identifier: BSD-3-Clause
// Estimate of the exponent p of the growth of an error, |error| ∝ t^p, with its 95 % confidence interval, from an
// ensemble of independent runs.
//
// One run: slope of the logarithm of the root mean square of the error over octaves of time, (T/2, T], (T/4, T/2], ….
// The octaves of a random walk are statistically equal up to their scale √t, so that the mean slope is ½, with a
// scatter of about 0.3 from run to run. The slope is 3/2 for an integrated random walk and 1 for a straight line.
// Ensemble: mean of the slopes, with an interval by Student's t with runs − 1 degrees of freedom. Runs are independent,
// points of one run are not.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace polhode::study::precision {

struct PathPoint {
  double t = 0;  ///< s
  double value = 0;
};

/// The exponent of one run. Points must be in ascending order of time and spread evenly from 0 to T. Absent for fewer
/// than four octaves of at least three points, and if an octave is zero throughout.
std::optional<double> path_exponent(const std::vector<PathPoint>& path);

struct GrowthEstimate {
  double exponent = 0;
  double half_width_95 = 0;  ///< half the 95 % confidence interval
  std::size_t paths = 0;
};
/// The exponent of an ensemble. Absent for fewer than three paths.
std::optional<GrowthEstimate> estimate_growth(const std::vector<double>& path_exponents);

/// Growth of an error, named after the corresponding drift of the energy.
enum class Growth { bounded, random_walk, linear, not_told };
std::string word_of(Growth growth);

/// The growth that an exponent indicates. Exponents of an energy drift: bounded 0, random walk ½ (Brouwer's law),
/// linear 1. Exponents of an attitude error, the integral of a frequency drift: 1, 3/2, 2. The exponent must agree with
/// one of these to within 0.2 and have an interval of at most ±0.2; otherwise the result is not_told.
Growth judge_energy_growth(const GrowthEstimate& estimate);
Growth judge_attitude_growth(const GrowthEstimate& estimate);

}  // namespace polhode::study::precision
