// SPDX-License-Identifier: BSD-3-Clause
// The cosine transform of a series of n numbers, c_k with k = 1, 2, … half periods in the series, and fits in it: noise
// of variance v_k beside regressors.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

namespace polhode::study::inline statistics::spectral {

using Eigen::Index;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr Index most_regressors = 6;
constexpr Index most_cosines = 64;  ///< most cosines that trends are fitted to
constexpr std::size_t noise_shapes = 9;
using Spectrum = Vector;  ///< one number for each cosine
/// The first cosines, without allocation. Those that fits read are aligned, so that no eight lie in two cache lines.
using Low = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_cosines, 1>;
using Numbers = Eigen::Ref<const Vector>;  ///< any of these, or a part of one
using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_regressors, 1>;

/// Regressors: one column for each, one row for each cosine k = 1, 2, …
struct Regressors {
  Matrix x;
  Index mirrored = 0;  ///< number of last columns that are those before them with the sign changed where k is odd
};

/// Quantities that depend only on the number n of blocks.
class Cosines {
 public:
  explicit Cosines(Index n);

  /// c_k of a series of n numbers.
  Spectrum transform(const Vector& series) const;
  /// The first ones of two series at once, as many as the vectors for them hold.
  void transform(const Vector& first, const Vector& second, Low& of_first, Low& of_second) const;

  /// Pulses at the first and the last block and, if there are enough cosines, at their neighbours: the spectrum that an
  /// oscillation with arbitrary phases at the ends has far below its line.
  Regressors edges(Index count) const;

  Index blocks, size;
  Spectrum log_frequency;  ///< ln(2 sin(θ/2)), θ = πk/n
  Spectrum log_averaging;  ///< ln((2 + cos θ)/3): what the means over blocks leave of a random walk
  struct Shape {
    Spectrum variance, inverse;
    Spectrum sum_of_logs;  ///< Σ ln v_1 … v_k at k − 1
  };
  /// Shapes of the noise a + b g_k, from b = 0 to a = 0.
  std::array<Shape, noise_shapes> shapes;

 private:
  template <std::size_t several>
  void transform(const std::array<const Vector*, several>& series, Index count,
                 const std::array<double*, several>& c) const;
  Index place(Index k, Index i) const;  ///< in the table

  Index half_;  ///< blocks in the first half, with the one in the middle
  /// √(2/n) cos(πk (2i + 1)/2n). A column holds 32 numbers k for one i, the odd ones before the even ones: first for
  /// k = 1 … 32 a column for each i in the first half of the blocks, then the same for the next 32. Zeros complete the
  /// last ones.
  Vector table_;
};

/// The cosines of n blocks. Kept for later calls of the thread, since many runs of a study have as many: at most half a
/// megabyte each.
std::shared_ptr<const Cosines> cosines_of(Index n);

/// Generalised least squares of c on the columns of x with variances s² v_k.
struct Fit {
  Coefficients coefficients, variances;  ///< of the regressors; variances over s²
  double squares = 0;                    ///< weighted sum of the residuals' squares
  double degrees = 0;                    ///< degrees of freedom
  double scale2() const { return squares / degrees; }
};

/// A fit by two regressors x and z beside those of a regression, with its variances.
struct FitBeside {
  double x = 0, z = 0;  ///< coefficients
  double squares = 0, degrees = 0;
  double scale2() const { return squares / degrees; }
  /// Diagonal of the normal equations of x and z, without what the others explain, after elimination of x. The
  /// coefficient of z has the variance s²/pivot.
  double xx = 0, pivot = 0;
};

/// All of a fit that does not depend on c, for the fits of several series.
class Regression {
 public:
  /// With variances 1/weight_k. `regressors` and `weight`, one number for each row of x, must outlive this object: many
  /// regressions share them.
  Regression(const Regressors& regressors, const Spectrum& weight, double sum_of_log_v);

  Fit fit(const Numbers& c) const;
  double squares(const Numbers& c) const;  ///< fit(c).squares
  /// The same for regressions on the same regressors with other variances.
  using OfShapes = std::array<const Regression*, noise_shapes>;
  static std::array<double, noise_shapes> squares(const OfShapes& all, const Numbers& c);
  double degrees() const { return static_cast<double>(x_.rows() - x_.cols()); }
  /// Logarithm of the restricted likelihood of a fit with these squares, the scale s² at its best.
  double restricted(double squares) const {
    return -0.5 * (sum_of_log_v_ + degrees() * std::log(squares) + log_determinant_);
  }

  /// What the regressors explain is taken out of x, z and c (theorem of Frisch, Waugh and Lovell).
  FitBeside fit_beside(const Low& x, const Low& z, const Low& c) const;
  double restricted(const FitBeside& fit) const {
    const double log_determinant = log_determinant_ + std::log(fit.xx) + std::log(fit.pivot);
    return -0.5 * (sum_of_log_v_ + fit.degrees * std::log(fit.squares) + log_determinant);
  }

 private:
  const Matrix& x_;
  Index mirrored_;  ///< Regressors::mirrored
  const double* weight_;
  /// Covariance of the coefficients, over s²; rows of zeros complete eight.
  Eigen::Matrix<double, 8, Eigen::Dynamic, 0, 8, most_regressors> covariance_;
  double sum_of_log_v_ = 0, log_determinant_ = 0;
};

/// Number of the shape of Cosines::shapes that is most likely, the first one of equals. likelihood(k): its logarithm
/// for the k-th.
template <class Likelihood>
std::size_t likeliest_shape(const Likelihood& likelihood) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < noise_shapes; ++k) {
    const double of_shape = likelihood(k);
    if (of_shape > most) {
      most = of_shape;
      best = k;
    }
  }
  return best;
}

/// One over the most likely variances of c without regressors.
const Spectrum& likeliest_weights(const Cosines& cosines, const Numbers& c);

}  // namespace polhode::study::statistics::spectral
