// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/cosine_spectrum.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <type_traits>
#include <vector>

#include "experiments/study/statistics/eight.hpp"

namespace polhode::study::inline statistics::spectral {

namespace {

constexpr Index per_column = 32;  ///< numbers k in a column of the table of cosines

/// The parts of a series that are even and odd about its middle. Even cosines depend on the one, odd ones on the other.
struct Parts {
  std::vector<double> even, odd;

  void take(const Vector& series) {
    const Index n = series.size(), half = (n + 1) / 2;
    even.resize(static_cast<std::size_t>(half));
    odd.resize(static_cast<std::size_t>(half));
    const double mean = sum(series.data(), n) / static_cast<double>(n);
    const double *from_first = series.data(), *from_last = series.data() + n - 1;
    double *evens = even.data(), *odds = odd.data();
    for (Index i = 0; i < half; ++i) {
      const double first = from_first[i] - mean, last = from_last[-i] - mean;
      evens[i] = first + last;
      odds[i] = first - last;
    }
    if (n % 2) even.back() /= 2;
  }
};

/// Sums of the products of each series' parts and `half` columns, for the 32 cosines of a column.
template <std::size_t several>
void add_columns(const double* columns, Index half, const std::array<Parts, several>& parts,
                 std::array<std::array<double, per_column>, several>& cosines) {
  constexpr Index odd_ones = per_column / 2, at_once = 2 * wide;
  for (Index from = 0; from < odd_ones; from += at_once) {
    Wide odd[several][2] = {}, even[several][2] = {};
    const double* column = columns + from;
    for (Index i = 0; i < half; ++i, column += per_column) {
      for (Index e = 0; e < 2; ++e) {
        Wide odd_cosines, even_cosines;
        std::memcpy(&odd_cosines, column + wide * e, sizeof odd_cosines);
        std::memcpy(&even_cosines, column + odd_ones + wide * e, sizeof even_cosines);
        for (std::size_t s = 0; s < several; ++s) {
          odd[s][e] += parts[s].odd[static_cast<std::size_t>(i)] * odd_cosines;
          even[s][e] += parts[s].even[static_cast<std::size_t>(i)] * even_cosines;
        }
      }
    }
    for (std::size_t s = 0; s < several; ++s) {
      double odds[at_once], evens[at_once];
      std::memcpy(odds, odd[s], sizeof odds);
      std::memcpy(evens, even[s], sizeof evens);
      double* const c = cosines[s].data() + 2 * from;
      for (Index k = 0; k < at_once; ++k) {
        c[2 * k] = odds[k];
        c[2 * k + 1] = evens[k];
      }
    }
  }
}

}  // namespace

Cosines::Cosines(Index n)
    : blocks(n),
      size(n - 1),
      half_((n + 1) / 2),
      table_(Vector::Zero((size + per_column - 1) / per_column * per_column * half_)) {
  const double pi = std::numbers::pi, blocks_ = static_cast<double>(n);
  Vector cosines(4 * n);
  for (Index j = 0; j < 4 * n; ++j) {
    cosines[j] = std::sqrt(2 / blocks_) * std::cos(pi * static_cast<double>(j) / (2 * blocks_));
  }
  for (Index i = 0; i < half_; ++i) {
    Index step = 0;  // k (2i + 1) modulo 4n
    for (Index k = 1; k <= size; ++k) {
      step += 2 * i + 1;
      if (step >= 4 * n) step -= 4 * n;
      table_[place(k, i)] = cosines[step];
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

template <std::size_t several>
void Cosines::transform(const std::array<const Vector*, several>& series, Index count,
                        const std::array<double*, several>& c) const {
  thread_local std::array<Parts, several> parts;  // kept, since allocations take time
  for (std::size_t s = 0; s < several; ++s) parts[s].take(*series[s]);
  std::array<std::array<double, per_column>, several> cosines;
  for (Index k = 0; k < count; k += per_column) {
    add_columns(table_.data() + k * half_, half_, parts, cosines);
    const auto bytes = static_cast<std::size_t>(std::min(per_column, count - k)) * sizeof(double);
    for (std::size_t s = 0; s < several; ++s) std::memcpy(c[s] + k, &cosines[s], bytes);
  }
}

Spectrum Cosines::transform(const Vector& series) const {
  Spectrum c(size);
  transform<1>({&series}, size, {c.data()});
  return c;
}

void Cosines::transform(const Vector& first, const Vector& second, Low& of_first, Low& of_second) const {
  transform<2>({&first, &second}, of_first.size(), {of_first.data(), of_second.data()});
}

Index Cosines::place(Index k, Index i) const {
  const Index first = (k - 1) / per_column * per_column, rest = k - 1 - first;
  return first * half_ + i * per_column + rest % 2 * (per_column / 2) + rest / 2;
}

Regressors Cosines::edges(Index count) const {
  constexpr Index enough = 24;
  const Index each = count < enough ? 1 : 2;
  Matrix x(count, 2 * each);
  for (Index k = 1; k <= count; ++k) {
    for (Index i = 0; i < each; ++i) {
      x(k - 1, i) = table_[place(k, i)];
      x(k - 1, each + i) = k % 2 == 0 ? x(k - 1, i) : -x(k - 1, i);
    }
  }
  return {std::move(x), each};
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

/// Sum of a_i b_i w_i over n numbers, in eight sums.
double weighted_dot(const double* a, const double* b, const double* w, Index n) {
  Eight sums = {};
  for_each_eight(
      n, [&](Index i, auto count) { sums += eight(a + i, count) * (eight(b + i, count) * eight(w + i, count)); });
  return total(sums);
}

}  // namespace

Regression::Regression(const Regressors& regressors, const Spectrum& weight, double sum_of_log_v)
    : x_(regressors.x),
      mirrored_(regressors.mirrored),
      weight_(weight.data()),
      covariance_(8, x_.cols()),
      sum_of_log_v_(sum_of_log_v) {
  using Normal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_regressors, most_regressors>;
  Normal normal(x_.cols(), x_.cols());
  for (Index j = 0; j < x_.cols(); ++j) {
    for (Index i = 0; i <= j; ++i) {
      normal(i, j) = normal(j, i) = weighted_dot(x_.col(i).data(), x_.col(j).data(), weight_, x_.rows());
    }
  }
  const Eigen::LDLT<Normal> factors(normal);
  covariance_.setZero();
  covariance_.topRows(x_.cols()) = factors.solve(Normal::Identity(normal.rows(), normal.cols()));
  log_determinant_ = factors.vectorD().array().log().sum();
}

namespace {

template <int number>
using Number = std::integral_constant<int, number>;

/// Calls use(columns, mirrored) with constants, those of Regressors: the sums for all columns then stay in registers.
template <class Use>
void with_sizes_of(const Matrix& x, Index mirrored, const Use& use) {
  const auto beside = [&](auto pulses) {
    switch (x.cols() - 2 * pulses) {
      case 0: return use(Number<2 * pulses>(), pulses);
      case 1: return use(Number<2 * pulses + 1>(), pulses);
      default: return use(Number<2 * pulses + 2>(), pulses);
    }
  };
  switch (mirrored) {
    case 0: return use(Number<2>(), Number<0>());
    case 1: return beside(Number<1>());
    default: return beside(Number<2>());
  }
}

/// What the columns of x explain of several series; the last ones are Regressors::mirrored.
template <int columns, int mirrored, std::size_t several>
class Explained {
 public:
  /// By least squares with these weights; covariance: the inverse of xᵀWx, a column in every eight numbers.
  Explained(const Matrix& x, const double* weights, const double* covariance,
            const std::array<const double*, several>& series) {
    for (int j = 0; j < columns; ++j) columns_[j] = x.col(j).data();
    constexpr int summed = columns - mirrored;
    Eight sums[several][summed] = {};
    for_each_eight(x.rows(), [&](Index i, auto count) {
      Eight numbers[several];
      for (std::size_t s = 0; s < several; ++s) numbers[s] = eight(series[s] + i, count);
      const Eight weight = eight(weights + i, count);
      for (int j = 0; j < summed; ++j) {
        const Eight weighted = eight(columns_[j] + i, count) * weight;
        for (std::size_t s = 0; s < several; ++s) sums[s][j] += weighted * numbers[s];
      }
    });
    for (std::size_t s = 0; s < several; ++s) {
      double products[columns];
      for (int j = 0; j < summed; ++j) {
        const TwoTotals two = two_totals(sums[s][j]);
        products[j] = two.even + two.odd;
        // The place of k is k − 1: where it is even, the mirrored column has the other sign.
        if (j >= summed - mirrored) products[j + mirrored] = two.odd - two.even;
      }
      Eight coefficients = eight(covariance) * products[0];
      for (int j = 1; j < columns; ++j) coefficients += eight(covariance + 8 * j) * products[j];
      coefficients.write(coefficients_[s]);
    }
  }

  double coefficient(std::size_t s, Index j) const { return coefficients_[s][j]; }

  /// Takes it out of `numbers`, those of the s-th series from the i-th on.
  template <class Count>
  void take_out_of(Eight& numbers, std::size_t s, Index i, Count count) const {
    for (int j = 0; j < columns; ++j) numbers -= coefficients_[s][j] * eight(columns_[j] + i, count);
  }

 private:
  const double* columns_[columns];
  double coefficients_[several][8];
};

/// The data are of size one: a sum of squares below it is nothing but the rounding of this arithmetic.
constexpr double least_squares = 1e-30;

/// Weighted sum of the squares of c without what is explained of it.
template <int columns, int mirrored>
double squares_without(const Explained<columns, mirrored, 1>& explained, const double* weights, const Numbers& c) {
  Eight sums = {};
  for_each_eight(c.size(), [&](Index i, auto count) {
    Eight rest = eight(c.data() + i, count);
    explained.take_out_of(rest, 0, i, count);
    sums += rest * (rest * eight(weights + i, count));
  });
  return std::max(total(sums), least_squares);
}

}  // namespace

Fit Regression::fit(const Numbers& c) const {
  Fit f;
  f.variances = covariance_.diagonal();
  f.coefficients.resize(x_.cols());
  with_sizes_of(x_, mirrored_, [&](auto columns, auto mirrored) {
    const Explained<columns, mirrored, 1> explained(x_, weight_, covariance_.data(), {c.data()});
    for (Index j = 0; j < columns; ++j) f.coefficients[j] = explained.coefficient(0, j);
    f.squares = squares_without(explained, weight_, c);
  });
  f.degrees = degrees();
  return f;
}

double Regression::squares(const Numbers& c) const {
  double squares = 0;
  with_sizes_of(x_, mirrored_, [&](auto columns, auto mirrored) {
    squares = squares_without(Explained<columns, mirrored, 1>(x_, weight_, covariance_.data(), {c.data()}), weight_, c);
  });
  return squares;
}

std::array<double, noise_shapes> Regression::squares(const OfShapes& all, const Numbers& c) {
  const Matrix& x = all.front()->x_;
  std::array<double, noise_shapes> squares;
  with_sizes_of(x, all.front()->mirrored_, [&](auto columns, auto mirrored) {
    constexpr int number = columns;
    double coefficients[noise_shapes][number];
    for (std::size_t k = 0; k < noise_shapes; ++k) {
      const Explained<columns, mirrored, 1> explained(x, all[k]->weight_, all[k]->covariance_.data(), {c.data()});
      for (int j = 0; j < columns; ++j) coefficients[k][j] = explained.coefficient(0, j);
    }
    Eight sums[noise_shapes] = {};
    for_each_eight(x.rows(), [&](Index i, auto count) {
      const Eight numbers = eight(c.data() + i, count);
      Eight column[number];
      for (int j = 0; j < columns; ++j) column[j] = eight(x.col(j).data() + i, count);
      for (std::size_t k = 0; k < noise_shapes; ++k) {
        Eight rest = numbers;
        for (int j = 0; j < columns; ++j) rest -= coefficients[k][j] * column[j];
        sums[k] += rest * (rest * eight(all[k]->weight_ + i, count));
      }
    });
    for (std::size_t k = 0; k < noise_shapes; ++k) squares[k] = std::max(total(sums[k]), least_squares);
  });
  return squares;
}

FitBeside Regression::fit_beside(const Low& x, const Low& z, const Low& c) const {
  const Index n = x_.rows();
  Eight x_free[most_cosines / 8], z_free[most_cosines / 8], c_free[most_cosines / 8];  // of what is explained
  Eight sums[5] = {};
  with_sizes_of(x_, mirrored_, [&](auto columns, auto mirrored) {
    const Explained<columns, mirrored, 3> explained(x_, weight_, covariance_.data(), {x.data(), z.data(), c.data()});
    for_each_eight(n, [&](Index i, auto count) {
      Eight x8 = eight(x.data() + i, count), z8 = eight(z.data() + i, count), c8 = eight(c.data() + i, count);
      explained.take_out_of(x8, 0, i, count);
      explained.take_out_of(z8, 1, i, count);
      explained.take_out_of(c8, 2, i, count);
      x_free[i / 8] = x8;
      z_free[i / 8] = z8;
      c_free[i / 8] = c8;
      const Eight weight = eight(weight_ + i, count);
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
  FitBeside f;
  f.z = (zc - ratio * xc) / pivot;
  f.x = xc / xx - ratio * f.z;
  Eight squares = {};
  for_each_eight(n, [&](Index i, auto count) {
    const Eight rest = c_free[i / 8] - f.x * x_free[i / 8] - f.z * z_free[i / 8];
    squares += rest * (rest * eight(weight_ + i, count));
  });
  f.squares = std::max(total(squares), least_squares);
  f.degrees = degrees() - 2;
  f.xx = xx;
  f.pivot = pivot;
  return f;
}

const Spectrum& likeliest_weights(const Cosines& cosines, const Numbers& c) {
  const Index n = c.size();
  Eight sums[noise_shapes] = {};
  for_each_eight(n, [&](Index i, auto count) {
    const Eight numbers = eight(c.data() + i, count), squares = numbers * numbers;
    for (std::size_t k = 0; k < noise_shapes; ++k)
      sums[k] += squares * eight(cosines.shapes[k].inverse.data() + i, count);
  });
  std::array<double, noise_shapes> means;
  for (std::size_t k = 0; k < noise_shapes; ++k) means[k] = total(sums[k]) / static_cast<double>(n);
  const std::size_t shape = likeliest_shape([&](std::size_t k) {
    return -(cosines.shapes[k].sum_of_logs[n - 1] / static_cast<double>(n) + std::log(means[k]));
  });
  return cosines.shapes[shape].inverse;
}

}  // namespace polhode::study::statistics::spectral
