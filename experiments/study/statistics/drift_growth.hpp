// SPDX-License-Identifier: BSD-3-Clause
// Growth of a drift: the exponent p of |drift| ~ t^p and the slope of the drift, each with a 95 % confidence interval
// that takes the oscillations of the drift into account.
//
// The run is reduced to at most 128 means over intervals of equal length (blocks), which averages out oscillations
// within a block. The cosine transform c_k of the means, k = 1, 2, … half periods in the run, separates the rest:
//   an oscillation that the blocks resolve is a line: up to eight are fitted and taken out, and only the k well below
//     any that is left are used, without what pulses at the ends of the run would explain;
//   noise: of variance v_k = a + b g_k, a that of bounded errors, g_k that of a random walk (1/4 sin²(πk/2n), averaged
//     over blocks), by restricted maximum likelihood;
//   a secular drift: by an F test of t and t² against that noise, at 0.5 %. Where there is one, p is that of
//     constant + t^p by generalised least squares; where there is none, p is the exponent H of v_k ~ k^−(1+2H) by
//     Whittle's likelihood, which is ½ for a random walk and below 0 for what stays bounded.
// The slope is that of ordinary least squares over all samples; its interval counts the oscillations as noise.
// Sources: Harvey, Forecasting, Structural Time Series Models and the Kalman Filter (1989), ch. 2 and 4 (local level);
// Müller & Watson, Econometrica 76 (2008) 979–1016 (low-frequency cosines); Beran, Statistics for Long-Memory Processes
// (1994), ch. 5 and 6 (Whittle); Brouwer, Astronomical Journal 46 (1937) 149–153 (rounding as a random walk).
#pragma once

#include <optional>
#include <vector>

#include "experiments/study/statistics/block_means.hpp"

namespace polhode::study::inline statistics {

/// Quantities that decide the class of a drift (drift_class.hpp); sizes in the unit of the drift.
struct DriftGrowth {
  bool secular = false;            ///< there is a trend, significant at 0.5 %
  double exponent = 0;             ///< p of the trend; without one, H of the rest, below 0 if that is bounded
  double low = 0, high = 0;        ///< 95 % confidence interval of the exponent
  double slope_half_width_95 = 0;  ///< half the 95 % confidence interval of the least-squares slope, per s
  double change = 0;               ///< change due to the trend over the run
  double change_limit = 0;         ///< upper limit (97.5 % confidence) of a change in proportion to time
  double rest = 0;  ///< largest deviation from its mean of the series without the oscillations that were subtracted
  double oscillation = 0;  ///< largest value of those oscillations
  /// Number of periods in the run of an oscillation too slow to be told from growth; 0: there is none.
  double slow_periods = 0;
  double slowest_line = 0;  ///< number of periods in the run of the slowest oscillation that was subtracted; 0: none
  double misfit = 0;        ///< peak-to-peak residual of t^p, if that residual is smooth
  bool even = true;         ///< no instant and no frequency stands out in the rest, as in a random walk
};

/// The growth. Absent for fewer than `fewest_blocks` blocks, for a drift constant to its last digit, and for numbers
/// that are not finite.
std::optional<DriftGrowth> growth_of(const std::vector<BlockMean>& blocks);
/// DriftGrowth::slope_half_width_95 alone, without the cost of the others.
std::optional<double> slope_half_width_95(const std::vector<BlockMean>& blocks);
inline constexpr std::size_t fewest_blocks = 32;

}  // namespace polhode::study::statistics
