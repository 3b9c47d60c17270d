// SPDX-License-Identifier: BSD-3-Clause
// The exponent p with which an error grows in time, |error| ∝ t^p, from an ensemble of independent runs, with its 95 %
// confidence interval.
//
// One run: the root mean square of the error over each octave (T/2, T], (T/4, T/2], … and the slope of its logarithm.
// The octaves of a random walk look alike but for their scale √t, so that the slope is ½ in the mean, though it
// scatters by about 0.3 from run to run; those of an integrated random walk give 3/2, of a straight line 1. The
// ensemble: mean of the slopes of its runs, and Student's t with runs − 1 degrees of freedom. Points of one run hang
// together, runs do not.
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

/// Of points in order of time, evenly spread from 0 to T. Absent with fewer than four octaves of at least three points,
/// and where an octave is zero throughout.
std::optional<double> path_exponent(const std::vector<PathPoint>& path);

struct GrowthEstimate {
  double exponent = 0;
  double half_width_95 = 0;  ///< of the confidence interval
  std::size_t paths = 0;
};
/// Absent with fewer than three paths.
std::optional<GrowthEstimate> estimate_growth(const std::vector<double>& path_exponents);

/// How an error can grow, by what rounding or truncation does to the energy.
enum class Growth { bounded, random_walk, linear, not_told };
std::string word_of(Growth growth);

/// Of an energy drift: bounded 0, random walk ½ (Brouwer's law), linear 1. Of an attitude error, which adds up the
/// drift of a frequency: 1, 3/2, 2. The one within 0.2 of the exponent, where its interval is ±0.2 at most.
Growth judge_energy_growth(const GrowthEstimate& estimate);
Growth judge_attitude_growth(const GrowthEstimate& estimate);

}  // namespace polhode::study
