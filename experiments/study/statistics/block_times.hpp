// SPDX-License-Identifier: BSD-3-Clause
// All that the growth of a drift needs of the times of its blocks alone: polynomials of the time, their cosine
// transforms, and regressions on them.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/study/statistics/block_means.hpp"
#include "experiments/study/statistics/cosine_spectrum.hpp"

namespace polhode::study::inline statistics::spectral {

/// Regressors beside noise. All but `polynomial` come with the pulses at the ends of the series (Cosines::edges).
enum class Trend { polynomial, none, line, curve };

/// Regressions on the same regressors with the variances of each of Cosines::shapes, made when they are asked for.
class Regressions {
 public:
  Regressions(const Cosines& cosines, Regressors x) : cosines_(cosines), x_(std::move(x)) {}
  Regressions(const Regressions&) = delete;
  Regressions& operator=(const Regressions&) = delete;

  const Regression& operator[](std::size_t shape) {
    std::optional<Regression>& made = made_[shape];
    if (!made) {
      const Cosines::Shape& noise = cosines_.shapes[shape];
      made.emplace(x_, noise.inverse, noise.sum_of_logs[x_.x.rows() - 1]);
    }
    return *made;
  }

  std::array<double, noise_shapes> squares(const Low& c) {
    Regression::OfShapes all;
    for (std::size_t k = 0; k < noise_shapes; ++k) all[k] = &(*this)[k];
    return Regression::squares(all, c);
  }

 private:
  const Cosines& cosines_;
  Regressors x_;
  std::array<std::optional<Regression>, noise_shapes> made_;
};

class BlockTimes {
 public:
  /// t: times of the blocks over that of the last one, all above 0.
  explicit BlockTimes(const Vector& t);
  BlockTimes(const BlockTimes&) = delete;
  BlockTimes& operator=(const BlockTimes&) = delete;

  const Cosines& cosines() const { return *cosines_; }
  const Vector& t() const { return t_; }
  const Matrix& polynomial() const { return polynomial_.x; }  ///< t and t², all cosines
  const Regression& flat() const { return flat_; }            ///< on t and t², with equal variances
  /// Orthonormal polynomials of the time up to the second degree, a column each.
  const Matrix& orthonormal() const { return orthonormal_; }

  /// The regressions on the first `count` cosines. Valid until the next call of block_times().
  Regressions& regressions(Trend trend, Index count);

  /// Sums of the least-squares slope over the first `count` cosines.
  struct Slope {
    double squares = 0;                             ///< Σ x², x the cosines of t
    std::array<double, noise_shapes> with_noise{};  ///< Σ x² v, v the variances of each shape
  };
  const Slope& slope(Index count);

  /// Cosines of t^p and of its derivative with respect to p, the first `count`.
  struct Power {
    alignas(64) Low value, derivative;
  };
  Power power(double p, Index count);

  /// The exponents p at which the search of an exponent begins.
  static constexpr std::array<double, 4> first_exponents = {0.5, 1, 2, 4};
  /// power() of the k-th of these exponents.
  Power first_power(std::size_t k, Index count) const;
  /// The regressions on t^p and the pulses for each of these exponents. Valid until the next call of block_times().
  std::deque<Regressions>& first_regressions(Index count);

 private:
  friend BlockTimes* block_times(const std::vector<BlockMean>& blocks);
  using Key = std::pair<Trend, Index>;

  Vector given_;  ///< the times as they came last
  Vector t_, log_t_;
  std::shared_ptr<const Cosines> cosines_;
  Regressors polynomial_;
  Regression flat_;
  Vector power_, derivative_;  ///< the series of power(); kept, since allocations take time
  std::array<Power, first_exponents.size()> first_powers_;
  Matrix orthonormal_;
  std::map<Key, Regressions> regressions_;
  std::map<Index, Slope> slopes_;                               ///< by number of cosines
  std::map<Index, std::deque<Regressions>> first_regressions_;  ///< by number of cosines
};

/// The one of the times of these blocks; null unless these are finite, from 0 on, and the last is above the first. Kept
/// for later calls of the thread, since the runs of a study mostly share their times: at most 16 of some megabytes
/// each. Valid until the next call.
BlockTimes* block_times(const std::vector<BlockMean>& blocks);

}  // namespace polhode::study::statistics::spectral
