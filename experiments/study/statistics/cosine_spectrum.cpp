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
    shape.sum_of_logs = shape.variance.array().log();
    for (Index k = 1; k < size; ++k) shape.sum_of_logs[k] += shape.sum_of_logs[k - 1];
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

std::shared_ptr<const Cosines> cosines_of(Index n) {
  constexpr std::size_t most = 16;
  thread_local std::map<Index, std::shared_ptr<const Cosines>> kept;
  if (kept.size() >= most && !kept.contains(n)) kept.clear();
  auto& cosines = kept[n];
  if (!cosines) cosines = std::make_shared<const Cosines>(n);
  return cosines;
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

Regression::Regression(const Regressors& x, const Spectrum& v, double sum_of_log_v)
    : x_(x), weighted_(x.rows(), x.cols()), weight_(v.cwiseInverse()), sum_of_log_v_(sum_of_log_v) {
  const Index n = x.rows();
  normal_.resize(x.cols(), x.cols());
  for (Index j = 0; j < x.cols(); ++j) {
    weighted_.col(j) = x.col(j).cwiseProduct(weight_);
    for (Index i = 0; i <= j; ++i) {
      normal_(i, j) = normal_(j, i) = dot(x.col(i).data(), weighted_.col(j).data(), n);
    }
  }
  solve();
}

Regression::Regression(const Regressors& x, const Regression& behind)
    : x_(x.rows(), x.cols() + behind.x_.cols()),
      weighted_(x_.rows(), x_.cols()),
      weight_(behind.weight_),
      sum_of_log_v_(behind.sum_of_log_v_) {
  const Index n = x.rows(), front = x.cols(), rest = behind.x_.cols();
  x_ << x, behind.x_;
  weighted_ << weight_.asDiagonal() * x, behind.weighted_;
  normal_.resize(x_.cols(), x_.cols());
  normal_.bottomRightCorner(rest, rest) = behind.normal_;
  for (Index i = 0; i < front; ++i) {
    for (Index j = i; j < x_.cols(); ++j) {
      normal_(i, j) = normal_(j, i) = dot(x_.col(i).data(), weighted_.col(j).data(), n);
    }
  }
  solve();
}

void Regression::solve() {
  const Eigen::LDLT<Normal> factors(normal_);
  covariance_ = factors.solve(Normal::Identity(normal_.rows(), normal_.cols()));
  log_determinant_ = factors.vectorD().array().log().sum();
}

Fit Regression::fit(const Spectrum& c) const {
  Fit f;
  const Index n = c.size();
  Coefficients right(x_.cols());
  for (Index j = 0; j < x_.cols(); ++j) right[j] = dot(weighted_.col(j).data(), c.data(), n);
  f.covariance = covariance_;
  f.coefficients = f.covariance * right;
  Spectrum rest = c;
  for (Index j = 0; j < x_.cols(); ++j) rest -= f.coefficients[j] * x_.col(j);
  const Spectrum weighted = rest.cwiseProduct(weight_);
  // The data are of size one: below this there is nothing but the rounding of this arithmetic.
  constexpr double rounding2 = 1e-30;
  f.squares = std::max(dot(rest.data(), weighted.data(), n), rounding2);
  f.degrees = static_cast<double>(n - x_.cols());
  f.restricted = -0.5 * (sum_of_log_v_ + f.degrees * std::log(f.squares) + log_determinant_);
  return f;
}

Spectrum whitened(const Cosines& cosines, const Spectrum& power) {
  const Index n = power.size();
  std::size_t best = noise_shapes;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < noise_shapes; ++k) {
    const Cosines::Shape& shape = cosines.shapes[k];
    const double mean_of_logs = shape.sum_of_logs[n - 1] / static_cast<double>(n);
    const double minus_likelihood = mean_of_logs + std::log(power.cwiseQuotient(shape.variance.head(n)).mean());
    if (minus_likelihood < least) {
      least = minus_likelihood;
      best = k;
    }
  }
  if (best == noise_shapes) return power;
  return power.cwiseQuotient(cosines.shapes[best].variance.head(n));
}

}  // namespace polhode::study::statistics::spectral
