// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/cosine_spectrum.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <type_traits>

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
    shape.inverse = shape.variance.cwiseInverse();
    shape.sum_of_logs = shape.variance.array().log();
    for (Index k = 1; k < size; ++k) shape.sum_of_logs[k] += shape.sum_of_logs[k - 1];
  }
}

Spectrum Cosines::transform(const Vector& series, Index count) const {
  // Even cosines depend on the even part of the series about its middle, odd ones on the odd part.
  const Index half = (blocks + 1) / 2, middle = blocks % 2;
  const double mean = sum(series.data(), blocks) / static_cast<double>(blocks);
  Vector symmetric(half), antisymmetric(half);
  for (Index i = 0; i < half; ++i) {
    const double first = series[i] - mean, last = series[blocks - 1 - i] - mean;
    symmetric[i] = first + last;
    antisymmetric[i] = first - last;
  }
  if (middle) symmetric[half - 1] /= 2;
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
  Eight sums = {};
  for_each_eight(n, [&](Index i, auto count) {
    Eight left, right;
    read(left, a + i, count);
    read(right, b + i, count);
    sums += left * right;
  });
  return total(sums);
}

namespace {

/// Sum of a_i b_i w_i over n numbers, in eight sums.
double weighted_dot(const double* a, const double* b, const double* w, Index n) {
  Eight sums = {};
  for_each_eight(n, [&](Index i, auto count) {
    Eight left, right, weight;
    read(left, a + i, count);
    read(right, b + i, count);
    read(weight, w + i, count);
    sums += left * (right * weight);
  });
  return total(sums);
}

}  // namespace

Regression::Regression(const Regressors& x, const Spectrum& weight, double sum_of_log_v)
    : x_(x), weight_(weight.data()), sum_of_log_v_(sum_of_log_v) {
  Normal normal(x.cols(), x.cols());
  for (Index j = 0; j < x.cols(); ++j) {
    for (Index i = 0; i <= j; ++i) {
      normal(i, j) = normal(j, i) = weighted_dot(x.col(i).data(), x.col(j).data(), weight_, x.rows());
    }
  }
  const Eigen::LDLT<Normal> factors(normal);
  covariance_ = factors.solve(Normal::Identity(normal.rows(), normal.cols()));
  log_determinant_ = factors.vectorD().array().log().sum();
}

namespace {

/// Calls use(k), k an integral constant, the number of regressors: the sums for all of them then stay in registers.
template <class Use>
void with_number_of(const Regressors& x, const Use& use) {
  switch (x.cols()) {
    case 1: return use(std::integral_constant<int, 1>());
    case 2: return use(std::integral_constant<int, 2>());
    case 3: return use(std::integral_constant<int, 3>());
    case 4: return use(std::integral_constant<int, 4>());
    case 5: return use(std::integral_constant<int, 5>());
    default: return use(std::integral_constant<int, most_regressors>());
  }
}

/// What the columns of x explain of c.
template <int columns>
class Explained {
 public:
  /// By least squares with these weights; covariance: the inverse of xᵀWx.
  Explained(const Regressors& x, const double* weights, const Normal& covariance, const Spectrum& c) {
    for (int j = 0; j < columns; ++j) columns_[j] = x.col(j).data();
    Eight sums[columns] = {};
    for_each_eight(c.size(), [&](Index i, auto count) {
      Eight numbers, weight, column;
      read(numbers, c.data() + i, count);
      read(weight, weights + i, count);
      for (int j = 0; j < columns; ++j) {
        read(column, columns_[j] + i, count);
        sums[j] += column * weight * numbers;
      }
    });
    double right[columns];
    for (int j = 0; j < columns; ++j) right[j] = total(sums[j]);
    for (int i = 0; i < columns; ++i) {
      coefficients_[i] = covariance.data()[i] * right[0];
      for (int j = 1; j < columns; ++j) coefficients_[i] += covariance.data()[i + j * columns] * right[j];
    }
  }

  Coefficients coefficients() const { return Eigen::Map<const Eigen::Matrix<double, columns, 1>>(coefficients_); }

  /// Takes it out of `numbers`, those of c from the i-th on.
  template <class Count>
  void take_out_of(Eight& numbers, Index i, Count count) const {
    for (int j = 0; j < columns; ++j) {
      Eight column;
      read(column, columns_[j] + i, count);
      numbers -= coefficients_[j] * column;
    }
  }

 private:
  const double* columns_[columns];
  double coefficients_[columns];
};

/// The data are of size one: a sum of squares below it is nothing but the rounding of this arithmetic.
constexpr double least_squares = 1e-30;

/// Weighted sum of the squares of c without what is explained of it.
template <int columns>
double squares_without(const Explained<columns>& explained, const double* weights, const Spectrum& c) {
  Eight sums = {};
  for_each_eight(c.size(), [&](Index i, auto count) {
    Eight rest, weight;
    read(rest, c.data() + i, count);
    explained.take_out_of(rest, i, count);
    read(weight, weights + i, count);
    sums += rest * (rest * weight);
  });
  return std::max(total(sums), least_squares);
}

}  // namespace

Spectrum Regression::rest_of(const Spectrum& c) const {
  Spectrum all(c.size());
  with_number_of(x_, [&](auto number) {
    const Explained<number> explained(x_, weight_, covariance_, c);
    for_each_eight(c.size(), [&](Index i, auto count) {
      Eight rest;
      read(rest, c.data() + i, count);
      explained.take_out_of(rest, i, count);
      std::memcpy(all.data() + i, &rest, static_cast<std::size_t>(count) * sizeof(double));
    });
  });
  return all;
}

double Regression::restricted_of(double squares) const {
  const auto degrees = static_cast<double>(x_.rows() - x_.cols());
  return -0.5 * (sum_of_log_v_ + degrees * std::log(squares) + log_determinant_);
}

Fit Regression::fit(const Spectrum& c) const {
  Fit f;
  f.covariance = covariance_;
  with_number_of(x_, [&](auto number) {
    const Explained<number> explained(x_, weight_, covariance_, c);
    f.coefficients = explained.coefficients();
    f.squares = squares_without(explained, weight_, c);
  });
  f.degrees = static_cast<double>(x_.rows() - x_.cols());
  f.restricted = restricted_of(f.squares);
  return f;
}

double Regression::restricted(const Spectrum& c) const {
  double squares = 0;
  with_number_of(
      x_, [&](auto number) { squares = squares_without(Explained<number>(x_, weight_, covariance_, c), weight_, c); });
  return restricted_of(squares);
}

Beside::Beside(const Regression& behind, const Spectrum& c) : behind_(behind), rest_(behind.rest_of(c)) {}

Fit Beside::fit(const Spectrum& x, const Spectrum& z) const {
  const Index n = rest_.size();
  const double* weights = behind_.weight_;
  Spectrum x_free(n), z_free(n);
  Eight sums[5] = {};
  with_number_of(behind_.x_, [&](auto number) {
    const Explained<number> x_explained(behind_.x_, weights, behind_.covariance_, x),
        z_explained(behind_.x_, weights, behind_.covariance_, z);
    for_each_eight(n, [&](Index i, auto count) {
      Eight x8, z8, c8, weight;
      read(x8, x.data() + i, count);
      read(z8, z.data() + i, count);
      x_explained.take_out_of(x8, i, count);
      z_explained.take_out_of(z8, i, count);
      std::memcpy(x_free.data() + i, &x8, static_cast<std::size_t>(count) * sizeof(double));
      std::memcpy(z_free.data() + i, &z8, static_cast<std::size_t>(count) * sizeof(double));
      read(c8, rest_.data() + i, count);
      read(weight, weights + i, count);
      const Eight x_weighted = x8 * weight, z_weighted = z8 * weight;
      sums[0] += x8 * x_weighted;
      sums[1] += x8 * z_weighted;
      sums[2] += z8 * z_weighted;
      sums[3] += x_weighted * c8;
      sums[4] += z_weighted * c8;
    });
  });
  const double xx = total(sums[0]), xz = total(sums[1]), zz = total(sums[2]), xc = total(sums[3]), zc = total(sums[4]);
  // Elimination of x: [xx xz; xz zz] = L diag(xx, pivot) Lᵀ, with `ratio` below the diagonal of L.
  const double ratio = xz / xx, pivot = zz - ratio * xz;
  Fit f;
  f.coefficients.resize(2);
  f.coefficients[1] = (zc - ratio * xc) / pivot;
  f.coefficients[0] = xc / xx - ratio * f.coefficients[1];
  f.covariance.resize(2, 2);
  f.covariance << 1 / xx + ratio * ratio / pivot, -ratio / pivot, -ratio / pivot, 1 / pivot;
  const double along_x = f.coefficients[0], along_z = f.coefficients[1];
  Eight squares = {};
  for_each_eight(n, [&](Index i, auto count) {
    Eight x8, z8, c8, weight;
    read(x8, x_free.data() + i, count);
    read(z8, z_free.data() + i, count);
    read(c8, rest_.data() + i, count);
    read(weight, weights + i, count);
    const Eight rest = c8 - along_x * x8 - along_z * z8;
    squares += rest * (rest * weight);
  });
  f.squares = std::max(total(squares), least_squares);
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
    const double mean_square = dot(power.data(), shape.inverse.data(), n) / static_cast<double>(n);
    const double minus_likelihood = mean_of_logs + std::log(mean_square);
    if (minus_likelihood < least) {
      least = minus_likelihood;
      best = k;
    }
  }
  if (best == noise_shapes) return power;
  return power.cwiseProduct(cosines.shapes[best].inverse.head(n));
}

}  // namespace polhode::study::statistics::spectral
