// SPDX-License-Identifier: BSD-3-Clause
// The cosine transform of a series of n numbers, c_k with k = 1, 2, … half periods in the series, and fits in it: noise
// of variance v_k beside regressors.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>

namespace polhode::study::inline statistics::spectral {

using Eigen::Index;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr Index most_regressors = 6;
constexpr std::size_t noise_shapes = 9;
using Spectrum = Vector;    ///< one number for each cosine
using Regressors = Matrix;  ///< one column for each regressor, one row for each cosine
using Normal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_regressors, most_regressors>;
using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_regressors, 1>;

/// Quantities that depend only on the number n of blocks.
class Cosines {
 public:
  explicit Cosines(Index n);

  /// c_k, k = 1 … count, of a series of n numbers.
  Spectrum transform(const Vector& series, Index count) const;
  Spectrum transform(const Vector& series) const { return transform(series, size); }

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
  /// √(2/n) cos(πk (2i + 1)/2n) over the first half of the blocks, for k = 2, 4, … and 1, 3, …; rows of zeros complete
  /// a multiple of eight
  Matrix even_, odd_;
};

/// The cosines of n blocks. Kept for later calls of the thread, since many runs of a study have as many: at most half a
/// megabyte each.
std::shared_ptr<const Cosines> cosines_of(Index n);

/// Sum of a_i b_i over n numbers, in eight sums, none of which waits for another.
double dot(const double* a, const double* b, Index n);

/// Generalised least squares of c on the columns of x with variances s² v_k.
struct Fit {
  Coefficients coefficients;
  Normal covariance;      ///< covariance of the coefficients, over s²
  double squares = 0;     ///< weighted sum of the residuals' squares
  double restricted = 0;  ///< logarithm of the restricted likelihood, the scale s² at its best
  double degrees = 0;     ///< degrees of freedom
  double scale2() const { return squares / degrees; }
};

/// All of a fit that does not depend on c, for the fits of several series.
class Regression {
 public:
  /// On the columns of x with variances 1/weight_k. `x` and `weight`, one number for each row of x, must outlive this
  /// object: many regressions share them.
  Regression(const Regressors& x, const Spectrum& weight, double sum_of_log_v);

  Fit fit(const Spectrum& c) const;
  /// The same as fit(c).restricted.
  double restricted(const Spectrum& c) const;

 private:
  friend class Beside;
  /// c without what the regressors explain.
  Spectrum rest_of(const Spectrum& c) const;
  double restricted_of(double squares) const;

  const Regressors& x_;
  const double* weight_;
  Normal covariance_;
  double sum_of_log_v_ = 0, log_determinant_ = 0;
};

/// Fits of c by two more regressors beside those of a regression, with its variances. What the latter explain is taken
/// out of c once and out of each pair (theorem of Frisch, Waugh and Lovell), so that many pairs can be tried.
class Beside {
 public:
  Beside(const Regression& behind, const Spectrum& c);  ///< `behind` must outlive this object

  /// Coefficients and covariance are those of x and z; degrees and likelihood are those of the whole fit.
  Fit fit(const Spectrum& x, const Spectrum& z) const;

 private:
  const Regression& behind_;
  Spectrum rest_;  ///< c without what `behind` explains
};

inline Fit fit(const Spectrum& c, const Regressors& x, const Spectrum& v, double sum_of_log_v) {
  const Spectrum weight = v.cwiseInverse();
  return Regression(x, weight, sum_of_log_v).fit(c);
}

/// Number of the shape of Cosines::shapes that is most likely; restricted_of(k) is Fit::restricted with shape k.
template <class RestrictedOf>
std::size_t likeliest_shape(const RestrictedOf& restricted_of) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < noise_shapes; ++k) {
    const double likelihood = restricted_of(k);
    if (likelihood > most) {
      most = likelihood;
      best = k;
    }
  }
  return best;
}

/// The squares of a series without regressors over its most likely variances.
Spectrum whitened(const Cosines& cosines, const Spectrum& power);

}  // namespace polhode::study::statistics::spectral
