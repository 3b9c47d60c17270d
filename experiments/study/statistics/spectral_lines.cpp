// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/spectral_lines.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>

#include "experiments/study/statistics/eight.hpp"

namespace polhode::study::inline statistics::spectral {

std::optional<Index> line_in(const Cosines& cosines, const Numbers& rest) {
  constexpr double line = 25;
  constexpr Index lowest = lowest_line, gap = 3;  // four oscillations in the run; a line's flank
  const Spectrum& weights = likeliest_weights(cosines, rest);
  double white_sum = 0, white_peak = 0, peak = 0;
  Index white_at = 0, at = 0;
  for (Index i = 0; i < rest.size(); ++i) {
    const double power = rest[i] * rest[i], white = power * weights[i];
    white_sum += white;
    if (white > white_peak) {
      white_peak = white;
      white_at = i;
    }
    if (power > peak) {
      peak = power;
      at = i;
    }
  }
  if (!(peak > 0)) return std::nullopt;
  if (white_at + 1 >= lowest && white_peak >= line * (white_sum / static_cast<double>(rest.size()))) {
    return white_at + 1;
  }
  if (at + 1 >= lowest && peak >= line * rest.head(at - gap).cwiseAbs2().mean()) return at + 1;
  return std::nullopt;
}

Index below_lines(const Cosines& cosines, const Numbers& rest) {
  Index count = rest.size();
  while (count > fewest_cosines) {
    const auto line = line_in(cosines, rest.head(count));
    if (!line) break;
    count = std::max(fewest_cosines, *line * 3 / 5);
  }
  return count;
}

namespace {

/// Sums of products of an oscillation x = [cos, sin] with itself, with the columns of a trend and with a series.
struct Products {
  double cos_cos = 0, cos_sin = 0, sin_sin = 0;
  std::array<double, trends> cos_trend = {}, sin_trend = {};
  double cos_rest = 0, sin_rest = 0;
};

/// The oscillations of any frequency about a trend and a series, eight numbers at a time.
class Oscillations {
 public:
  Oscillations(const Matrix& trend, const Vector& rest)
      : n_(rest.size()),
        padded_(in_eights(n_)),
        trend_(Matrix::Zero(padded_, trends)),
        rest_(Vector::Zero(padded_)),
        x_(padded_, 2) {
    trend_.topRows(n_) = trend;
    rest_.head(n_) = rest;
  }

  /// cos and sin of ω (i + ½), i = 0 … n − 1; valid after products(ω).
  auto oscillation() const { return x_.topRows(n_); }

  Products products(double omega) {
    const double c = std::cos(omega), s = std::sin(omega);
    double cosines[8] = {std::cos(omega / 2)}, sines[8] = {std::sin(omega / 2)};
    for (int i = 1; i < 8; ++i) {
      cosines[i] = c * cosines[i - 1] - s * sines[i - 1];
      sines[i] = s * cosines[i - 1] + c * sines[i - 1];
    }
    Eight cosine = eight(cosines), sine = eight(sines);
    double c8 = c, s8 = s;  // cosine and sine of 8ω, by doubling the angle three times
    for (int i = 0; i < 3; ++i) {
      const double twice = 2 * s8 * c8;
      c8 = c8 * c8 - s8 * s8;
      s8 = twice;
    }
    Eight cos_cos = {}, cos_sin = {}, sin_sin = {}, cos_rest = {}, sin_rest = {}, cos_trend[trends] = {},
          sin_trend[trends] = {};
    for (Index i = 0; i < padded_; i += 8) {
      cosine.write(&x_(i, 0));
      sine.write(&x_(i, 1));
      if (n_ - i < 8) {
        x_.bottomRows(padded_ - n_).setZero();
        cosine = eight(&x_(i, 0));
        sine = eight(&x_(i, 1));
      }
      cos_cos += cosine * cosine;
      cos_sin += cosine * sine;
      sin_sin += sine * sine;
      const Eight rest = eight(&rest_[i]);
      cos_rest += cosine * rest;
      sin_rest += sine * rest;
      for (int j = 0; j < trends; ++j) {
        const Eight trend = eight(&trend_(i, j));
        cos_trend[j] += cosine * trend;
        sin_trend[j] += sine * trend;
      }
      const Eight next = c8 * cosine - s8 * sine;
      sine = s8 * cosine + c8 * sine;
      cosine = next;
    }
    Products sums{total(cos_cos), total(cos_sin), total(sin_sin), {}, {}, total(cos_rest), total(sin_rest)};
    for (std::size_t j = 0; j < trends; ++j) {
      sums.cos_trend[j] = total(cos_trend[j]);
      sums.sin_trend[j] = total(sin_trend[j]);
    }
    return sums;
  }

 private:
  Index n_, padded_;
  Matrix trend_;
  Vector rest_;
  Matrix x_;
};

}  // namespace

Vector fitted_oscillation(const Vector& series, const Matrix& trend, Index k) {
  const double unit = std::numbers::pi / static_cast<double>(series.size()), near = static_cast<double>(k);
  Oscillations oscillations(trend, series - trend * (trend.transpose() * series));
  Eigen::Vector2d amplitudes;
  // Least squares of the rest on the part F of x = [cos, sin] that is orthogonal to the trend: FᵀF = xᵀx − (Tᵀx)ᵀ(Tᵀx)
  // and Fᵀ rest = xᵀ rest. Returns the decrease of the sum of squares.
  const auto fit_at = [&](double place) {
    const Products sums = oscillations.products(place * unit);
    Eigen::Matrix2d normal;
    normal << sums.cos_cos, sums.cos_sin, 0, sums.sin_sin;
    for (std::size_t i = 0; i < trends; ++i) {
      normal(0, 0) -= sums.cos_trend[i] * sums.cos_trend[i];
      normal(0, 1) -= sums.cos_trend[i] * sums.sin_trend[i];
      normal(1, 1) -= sums.sin_trend[i] * sums.sin_trend[i];
    }
    normal(1, 0) = normal(0, 1);
    const Eigen::Vector2d right(sums.cos_rest, sums.sin_rest);
    amplitudes = normal.ldlt().solve(right);
    return amplitudes.dot(right);
  };
  const auto minus_decrease = [&](double place) { return -fit_at(place); };
  constexpr int bits = 16;
  constexpr double reach = 1.2;
  fit_at(boost::math::tools::brent_find_minima(minus_decrease, near - reach, near + reach, bits).first);
  return oscillations.oscillation() * amplitudes;
}

}  // namespace polhode::study::statistics::spectral
