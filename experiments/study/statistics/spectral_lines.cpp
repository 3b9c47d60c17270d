// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/spectral_lines.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>

namespace polhode::study::inline statistics::spectral {

std::optional<Index> line_in(const Cosines& cosines, const Spectrum& rest) {
  constexpr double line = 25;
  constexpr Index lowest = lowest_line, gap = 3;  // four oscillations in the run; a line's flank
  const Spectrum power = rest.cwiseAbs2();
  if (!(power.maxCoeff() > 0)) return std::nullopt;
  const Spectrum white = whitened(cosines, power);
  Index at = 0;
  if (white.maxCoeff(&at) >= line * white.mean() && at + 1 >= lowest) return at + 1;
  const double peak = power.maxCoeff(&at);
  if (at + 1 >= lowest && peak >= line * power.head(at - gap).mean()) return at + 1;
  return std::nullopt;
}

Index below_lines(const Cosines& cosines, const Spectrum& rest) {
  Index count = rest.size();
  while (count > fewest_cosines) {
    const auto line = line_in(cosines, rest.head(count));
    if (!line) break;
    count = std::max(fewest_cosines, *line * 3 / 5);
  }
  return count;
}

namespace {

/// cos and sin of ω (i + ½), i = 0 … n − 1.
Matrix oscillation(double omega, Index n) {
  Matrix x(n, 2);
  const double c = std::cos(omega), s = std::sin(omega);
  x(0, 0) = std::cos(omega / 2);
  x(0, 1) = std::sin(omega / 2);
  for (Index i = 1; i < n; ++i) {
    x(i, 0) = c * x(i - 1, 0) - s * x(i - 1, 1);
    x(i, 1) = s * x(i - 1, 0) + c * x(i - 1, 1);
  }
  return x;
}

}  // namespace

Vector fitted_oscillation(const Vector& series, const Matrix& trend, Index k) {
  const Index n = series.size(), trends = trend.cols();
  const double unit = std::numbers::pi / static_cast<double>(n), near = static_cast<double>(k);
  const Vector rest = series - trend * (trend.transpose() * series);
  Matrix x;
  Eigen::Vector2d amplitudes;
  // Least squares of the rest on the part F of x = [cos, sin] that is orthogonal to the trend: FᵀF = xᵀx − (Tᵀx)ᵀ(Tᵀx)
  // and Fᵀ rest = xᵀ rest. Returns the decrease of the sum of squares.
  const auto fit_at = [&](double place) {
    x = oscillation(place * unit, n);
    const double *cosine = x.col(0).data(), *sine = x.col(1).data();
    Eigen::Matrix2d normal;
    normal << dot(cosine, cosine, n), dot(cosine, sine, n), 0, dot(sine, sine, n);
    for (Index i = 0; i < trends; ++i) {
      const double c = dot(trend.col(i).data(), cosine, n), s = dot(trend.col(i).data(), sine, n);
      normal(0, 0) -= c * c;
      normal(0, 1) -= c * s;
      normal(1, 1) -= s * s;
    }
    normal(1, 0) = normal(0, 1);
    const Eigen::Vector2d right(dot(cosine, rest.data(), n), dot(sine, rest.data(), n));
    amplitudes = normal.ldlt().solve(right);
    return amplitudes.dot(right);
  };
  const auto minus_decrease = [&](double place) { return -fit_at(place); };
  constexpr int bits = 16;
  constexpr double reach = 1.2;
  fit_at(boost::math::tools::brent_find_minima(minus_decrease, near - reach, near + reach, bits).first);
  return x * amplitudes;
}

}  // namespace polhode::study::statistics::spectral
