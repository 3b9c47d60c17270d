// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/cosine_spectrum.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>

namespace polhode::study::inline statistics::spectral {

Cosines::Cosines(Index n) : blocks(n), size(n - 1), even_(size / 2, (n + 1) / 2), odd_(size - size / 2, (n + 1) / 2) {
  const double pi = std::numbers::pi, blocks_ = static_cast<double>(n);
  Vector table(4 * n);
  for (Index j = 0; j < 4 * n; ++j) {
    table[j] = std::sqrt(2 / blocks_) * std::cos(pi * static_cast<double>(j) / (2 * blocks_));
  }
  for (Index i = 0; i < (n + 1) / 2; ++i) {
    Index place = 0;  // k (2i + 1) modulo 4n
    for (Index k = 1; k <= size; ++k) {
      place += 2 * i + 1;
      if (place >= 4 * n) place -= 4 * n;
      (k % 2 == 0 ? even_(k / 2 - 1, i) : odd_(k / 2, i)) = table[place];
    }
  }
  log_frequency.resize(size);
  log_averaging.resize(size);
  for (Index k = 1; k <= size; ++k) {
    const double theta = pi * static_cast<double>(k) / blocks_;
    log_frequency[k - 1] = std::log(2 * std::sin(theta / 2));
    log_averaging[k - 1] = std::log((2 + std::cos(theta)) / 3);
  }
  const Spectrum walk = (log_averaging - 2 * log_frequency).array().exp();
  double ratio = 1e-5;
  for (auto& shape : shapes) {
    shape.variance = &shape == &shapes.front()  ? Spectrum(Spectrum::Ones(size))
                     : &shape == &shapes.back() ? walk
                                                : Spectrum(1 + (ratio *= 8) * walk.array());
    shape.logarithm = shape.variance.array().log();
  }
}

Spectrum Cosines::transform(const Vector& series, Index count) const {
  // Even cosines see the even part of the series about its middle, odd ones the odd part.
  const Index half = (blocks + 1) / 2, middle = blocks % 2;
  const Vector first = series.head(half).array() - series.mean();
  Vector last = series.tail(half).reverse().array() - series.mean();
  if (middle) last[half - 1] = 0;
  Vector symmetric = first + last, antisymmetric = first - last;
  if (middle) antisymmetric[half - 1] = 0;
  // Block after block, not cosine after cosine: sums of many at once, and none waits for the one before it.
  Spectrum even = Spectrum::Zero(count / 2), odd = Spectrum::Zero(count - count / 2), c(count);
  for (Index i = 0; i < half; ++i) {
    even += symmetric[i] * even_.col(i).head(even.size());
    odd += antisymmetric[i] * odd_.col(i).head(odd.size());
  }
  for (Index k = 1; k <= count; ++k) c[k - 1] = k % 2 == 0 ? even[k / 2 - 1] : odd[k / 2];
  return c;
}

Regressors Cosines::edges(Index count) const {
  constexpr Index enough = 24;
  const Index each = count < enough ? 1 : 2;
  Regressors x(count, 2 * each);
  for (Index k = 1; k <= count; ++k) {
    for (Index i = 0; i < each; ++i) {
      x(k - 1, i) = k % 2 == 0 ? even_(k / 2 - 1, i) : odd_(k / 2, i);
      x(k - 1, each + i) = k % 2 == 0 ? x(k - 1, i) : -x(k - 1, i);
    }
  }
  return x;
}

const Cosines& cosines_of(Index n) {
  constexpr std::size_t most = 16;
  thread_local std::map<Index, Cosines> kept;
  if (kept.size() >= most && !kept.contains(n)) kept.clear();
  return kept.try_emplace(n, n).first->second;
}

namespace {

/// Eight numbers side by side. Their sums are the same for every width of the SIMD registers.
using Eight [[gnu::vector_size(8 * sizeof(double))]] = double;

double total(const Eight& s) { return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])); }

}  // namespace

double dot(const double* a, const double* b, Index n) {
  Eight sums = {}, left, right;
  Index i = 0;
  for (; i + 8 <= n; i += 8) {
    std::memcpy(&left, a + i, sizeof left);
    std::memcpy(&right, b + i, sizeof right);
    sums += left * right;
  }
  double sum = total(sums);
  for (; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

Fit fit(const Spectrum& c, const Regressors& x, const Spectrum& v, double sum_of_log_v) {
  Fit f;
  const Index n = c.size();
  const Spectrum weight = v.cwiseInverse();
  Spectrum weighted(n);
  Normal normal(x.cols(), x.cols());
  Coefficients right(x.cols());
  for (Index j = 0; j < x.cols(); ++j) {
    weighted = x.col(j).cwiseProduct(weight);
    for (Index i = 0; i <= j; ++i) normal(i, j) = normal(j, i) = dot(x.col(i).data(), weighted.data(), n);
    right[j] = dot(weighted.data(), c.data(), n);
  }
  const Eigen::LDLT<Normal> factors(normal);
  f.covariance = factors.solve(Normal::Identity(x.cols(), x.cols()));
  f.coefficients = f.covariance * right;
  Spectrum rest = c;
  for (Index j = 0; j < x.cols(); ++j) rest -= f.coefficients[j] * x.col(j);
  weighted = rest.cwiseProduct(weight);
  // The data are of size one: below this there is nothing but the rounding of this arithmetic.
  constexpr double rounding2 = 1e-30;
  f.squares = std::max(dot(rest.data(), weighted.data(), n), rounding2);
  f.degrees = static_cast<double>(n - x.cols());
  f.restricted = -0.5 * (sum_of_log_v + f.degrees * std::log(f.squares) + factors.vectorD().array().log().sum());
  return f;
}

Spectrum noise_shape(const Cosines& cosines, const Spectrum& c, const Regressors& x) {
  Spectrum best;
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& shape : cosines.shapes) {
    const Spectrum v = shape.variance.head(c.size());
    const double likelihood = fit(c, x, v, shape.logarithm.head(c.size()).sum()).restricted;
    if (likelihood > most) {
      most = likelihood;
      best = v;
    }
  }
  return best;
}

Spectrum whitened(const Cosines& cosines, const Spectrum& power) {
  Spectrum best = power;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& shape : cosines.shapes) {
    const Spectrum white = power.cwiseQuotient(shape.variance.head(power.size()));
    const double minus_likelihood = shape.logarithm.head(power.size()).mean() + std::log(white.mean());
    if (minus_likelihood < least) {
      least = minus_likelihood;
      best = white;
    }
  }
  return best;
}

}  // namespace polhode::study::statistics::spectral
