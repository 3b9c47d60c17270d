// SPDX-License-Identifier: BSD-3-Clause
// All that the growth of a drift needs of the times of its blocks alone: polynomials of the time, their cosine
// transforms, and regressions on them.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "experiments/study/statistics/cosine_spectrum.hpp"

namespace polhode::study::inline statistics::spectral {

/// Regressors beside noise. All but `polynomial` come with the pulses at the ends of the series (Cosines::edges).
enum class Trend { polynomial, none, line, curve };

class BlockTimes {
 public:
  /// t: times of the blocks over that of the last one, all above 0.
  explicit BlockTimes(const Vector& t);
  BlockTimes(const BlockTimes&) = delete;
  BlockTimes& operator=(const BlockTimes&) = delete;

  const Cosines& cosines() const { return *cosines_; }
  const Vector& t() const { return t_; }
  const Vector& log_t() const { return log_t_; }
  const Regressors& polynomial() const { return polynomial_; }  ///< t and t², all cosines
  const Regression& flat() const { return flat_; }              ///< on t and t², with equal variances
  /// Orthonormal polynomials of the time up to the second degree, a column each.
  const Matrix& orthonormal() const { return orthonormal_; }

  /// The regression on the first `count` cosines with the variances of a shape of Cosines::shapes.
  const Regression& regression(Trend trend, Index count, std::size_t shape);

  /// Cosines of t^p and of its derivative with respect to p.
  struct Power {
    Spectrum value, derivative;
  };
  Power power(double p, Index count) const;

  /// The exponents p at which the search of an exponent begins.
  static constexpr std::array<double, 4> first_exponents = {0.5, 1, 2, 4};
  /// power() of the k-th of these exponents.
  Power first_power(std::size_t k, Index count) const;
  /// The regression on t^p and the pulses, with the k-th of these exponents.
  const Regression& first_regression(std::size_t k, Index count, std::size_t shape);

 private:
  friend BlockTimes& block_times(const Vector& t);
  using Key = std::pair<Trend, Index>;
  /// Regressions on the same regressors with the variances of each shape, made when they are asked for.
  struct Shaped {
    Regressors x;
    std::array<std::optional<Regression>, noise_shapes> made;
  };
  const Regression& with_shape(Shaped& all, std::size_t shape) const;

  Vector t_, log_t_;
  std::shared_ptr<const Cosines> cosines_;
  Regressors polynomial_;
  Regression flat_;
  std::array<Power, first_exponents.size()> first_powers_;
  Matrix orthonormal_;
  std::map<Key, Shaped> regressions_;
  std::map<Index, std::array<Shaped, first_exponents.size()>> first_regressions_;  ///< by number of cosines
};

/// The one of these times. Kept for later calls of the thread, since the runs of a study mostly share their times: at
/// most 16 of some megabytes each. Valid until the next call.
BlockTimes& block_times(const Vector& t);

}  // namespace polhode::study::statistics::spectral
