// SPDX-License-Identifier: BSD-3-Clause
// How a drift grows: the exponent p of |drift| ~ t^p and the slope of the drift, each with a 95 % confidence interval
// that knows of the drift's oscillations.
//
// The run is kept as at most 128 means over stretches of equal length (blocks), which flattens what oscillates within
// one. Their cosine transform c_k, k = 1, 2, … half periods in the run, tells the rest apart:
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

#include <cstddef>
#include <optional>
#include <vector>

namespace polhode::study::inline statistics {

struct BlockMean {
  double t = 0;      ///< s
  double value = 0;  ///< of the drift, in any unit
};

/// The means of a series over blocks of as many samples each; when all are in use, neighbours merge.
class BlockMeans {
 public:
  void add(double t, double value) {
    open_.t += t;
    open_.value += value;
    if (++in_open_ == per_block_) close();
  }
  /// The last block counts if it is half full.
  std::vector<BlockMean> finish() const;

 private:
  static constexpr std::size_t capacity = 128;
  void close();

  std::vector<BlockMean> sums_;
  BlockMean open_;
  std::size_t in_open_ = 0, per_block_ = 1;
};

/// What a class is found from (drift_class.hpp); sizes in the unit of the drift.
struct DriftGrowth {
  bool secular = false;      ///< the drift goes one way: told from noise with 99.5 % confidence
  double exponent = 0;       ///< p of a drift that goes one way, else H of what is left, below 0 where that is bounded
  double low = 0, high = 0;  ///< its 95 % confidence interval
  double slope_half_width_95 = 0;  ///< of the least-squares slope, per s
  double change = 0;               ///< what goes one way comes to over the run
  double change_limit = 0;         ///< what a change in proportion to time may come to, with 97.5 % confidence
  double rest = 0;         ///< the largest of what is left without the oscillations that were taken out, from its mean
  double oscillation = 0;  ///< the largest of these
  /// How many periods the run has of an oscillation that is too slow to be told from growth; 0: there is none.
  double slow_periods = 0;
  double slowest_line = 0;  ///< how many periods it has of the slowest oscillation that was taken out; 0: none was
  double misfit = 0;        ///< what t^p leaves from peak to peak, where that is smooth
  bool even = true;         ///< no instant and no frequency stands out of what is left, as none does of a random walk
};

/// Absent: fewer than `fewest_blocks`, a drift that is constant to its last digit, or numbers that are not finite.
/// Costs some 0.3 ms.
std::optional<DriftGrowth> growth_of(const std::vector<BlockMean>& blocks);
inline constexpr std::size_t fewest_blocks = 32;

}  // namespace polhode::study
