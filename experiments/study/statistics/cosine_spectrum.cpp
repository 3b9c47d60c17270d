// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/cosine_spectrum.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>

#include "experiments/study/statistics/eight.hpp"

namespace polhode::study::inline statistics::spectral {

namespace {

/// Σ_i series_i table(k, i) for 8 `eights` rows k from the first one, which stay in registers.
template <int eights>
void add_columns(const Matrix& table, const Vector& series, Index first_row, double* out) {
  Eight sums[eights] = {};
  const double* column = table.data() + first_row;
  for (Index i = 0; i < series.size(); ++i, column += table.rows()) {
    for (int e = 0; e < eights; ++e) {
      Eight numbers;
      read(numbers, column + 8 * e);
      sums[e] += series[i] * numbers;
    }
  }
  std::memcpy(out, sums, sizeof sums);
}

/// table · series for the first `rows` rows of a table, up to a multiple of eight.
Spectrum first_rows(const Matrix& table, const Vector& series, Index rows) {
  Spectrum out(in_eights(rows));
  Index k = 0;
  for (; k + 32 <= out.size(); k += 32) add_columns<4>(table, series, k, out.data() + k);
  for (; k < out.size(); k += 8) add_columns<1>(table, series, k, out.data() + k);
  return out;
}

}  // namespace

Cosines::Cosines(Index n)
    : blocks(n),
      size(n - 1),
      even_(Matrix::Zero(in_eights(size / 2), (n + 1) / 2)),
      odd_(Matrix::Zero(in_eights(size - size / 2), (n + 1) / 2)) {
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
  // Even cosines depend on the even part of the series about its middle, odd ones on the odd part.
  const Index half = (blocks + 1) / 2, middle = blocks % 2;
  const double mean = series.mean();
  const Vector first = series.head(half).array() - mean;
  Vector last = series.tail(half).reverse().array() - mean;
  if (middle) last[half - 1] = 0;
  Vector symmetric = first + last, antisymmetric = first - last;
  if (middle) antisymmetric[half - 1] = 0;
  const Spectrum even = first_rows(even_, symmetric, count / 2),
                 odd = first_rows(odd_, antisymmetric, count - count / 2);
  Spectrum c(count);
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

double dot(const double* a, const double* b, Index n) {
  Eight sums = {}, left, right;
  Index i = 0;
  for (; i + 8 <= n; i += 8) {
    read(left, a + i);
    read(right, b + i);
    sums += left * right;
  }
  double sum = total(sums);
  for (; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

Regression::Regression(const Regressors& x, const Spectrum& v, double sum_of_log_v)
    : x_(x), weighted_(x.rows(), x.cols()), weight_(v.cwiseInverse()), sum_of_log_v_(sum_of_log_v) {
  const Index n = x.rows();
  Normal normal(x.cols(), x.cols());
  for (Index j = 0; j < x.cols(); ++j) {
    weighted_.col(j) = x.col(j).cwiseProduct(weight_);
    for (Index i = 0; i <= j; ++i) {
      normal(i, j) = normal(j, i) = dot(x.col(i).data(), weighted_.col(j).data(), n);
    }
  }
  const Eigen::LDLT<Normal> factors(normal);
  covariance_ = factors.solve(Normal::Identity(normal.rows(), normal.cols()));
  log_determinant_ = factors.vectorD().array().log().sum();
}

Coefficients Regression::coefficients(const Spectrum& c) const {
  Coefficients right(x_.cols());
  for (Index j = 0; j < x_.cols(); ++j) right[j] = dot(weighted_.col(j).data(), c.data(), c.size());
  return covariance_ * right;
}

void Regression::subtract(const Coefficients& coefficients, Spectrum& c) const {
  for (Index j = 0; j < x_.cols(); ++j) c -= coefficients[j] * x_.col(j);
}

namespace {

/// Weighted sum of squares. The data are of size one: below the least there is nothing but the rounding of this
/// arithmetic.
double squares_of(const Spectrum& rest, const Spectrum& weight) {
  constexpr double least = 1e-30;
  const Spectrum weighted = rest.cwiseProduct(weight);
  return std::max(dot(rest.data(), weighted.data(), rest.size()), least);
}

}  // namespace

Fit Regression::fit(const Spectrum& c) const {
  Fit f;
  f.covariance = covariance_;
  f.coefficients = coefficients(c);
  Spectrum rest = c;
  subtract(f.coefficients, rest);
  f.squares = squares_of(rest, weight_);
  f.degrees = static_cast<double>(c.size() - x_.cols());
  f.restricted = -0.5 * (sum_of_log_v_ + f.degrees * std::log(f.squares) + log_determinant_);
  return f;
}

Beside::Beside(const Regression& behind, const Spectrum& c) : behind_(behind), rest_(c) {
  behind.subtract(behind.coefficients(c), rest_);
}

Fit Beside::fit(const Spectrum& x, const Spectrum& z) const {
  const Index n = rest_.size();
  Spectrum x_free = x, z_free = z;
  behind_.subtract(behind_.coefficients(x), x_free);
  behind_.subtract(behind_.coefficients(z), z_free);
  const Spectrum x_weighted = x_free.cwiseProduct(behind_.weight_), z_weighted = z_free.cwiseProduct(behind_.weight_);
  const double xx = dot(x_free.data(), x_weighted.data(), n), xz = dot(x_free.data(), z_weighted.data(), n);
  const double zz = dot(z_free.data(), z_weighted.data(), n);
  const double xc = dot(x_weighted.data(), rest_.data(), n), zc = dot(z_weighted.data(), rest_.data(), n);
  // Elimination of x: [xx xz; xz zz] = L diag(xx, pivot) Lᵀ, with `ratio` below the diagonal of L.
  const double ratio = xz / xx, pivot = zz - ratio * xz;
  Fit f;
  f.coefficients.resize(2);
  f.coefficients[1] = (zc - ratio * xc) / pivot;
  f.coefficients[0] = xc / xx - ratio * f.coefficients[1];
  f.covariance.resize(2, 2);
  f.covariance << 1 / xx + ratio * ratio / pivot, -ratio / pivot, -ratio / pivot, 1 / pivot;
  const Spectrum rest = rest_ - f.coefficients[0] * x_free - f.coefficients[1] * z_free;
  f.squares = squares_of(rest, behind_.weight_);
  f.degrees = static_cast<double>(n - 2 - behind_.x_.cols());
  const double log_determinant = behind_.log_determinant_ + std::log(xx) + std::log(pivot);
  f.restricted = -0.5 * (behind_.sum_of_log_v_ + f.degrees * std::log(f.squares) + log_determinant);
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
