// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/block_times.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <list>

namespace polhode::study::inline statistics::spectral {
namespace {

Regressors polynomial_of(const Cosines& cosines, const Vector& t) {
  Regressors x(cosines.size, 2);
  x << cosines.transform(t), cosines.transform(t.cwiseAbs2());
  return x;
}

Matrix orthonormal_polynomials(const Vector& t) {
  Matrix polynomial(t.size(), 3);
  polynomial << Vector::Ones(t.size()), t, t.cwiseAbs2();
  return polynomial.householderQr().householderQ() * Matrix::Identity(t.size(), polynomial.cols());
}

/// The regressors x and the pulses.
Regressors with_edges(const Regressors& x, const Cosines& cosines) {
  const Regressors edges = cosines.edges(x.rows());
  Regressors both(x.rows(), x.cols() + edges.cols());
  both << x, edges;
  return both;
}

Regression with_shape(const Regressors& x, const Cosines::Shape& noise) {
  return {x, noise.variance.head(x.rows()), noise.sum_of_logs[x.rows() - 1]};
}

}  // namespace

BlockTimes::BlockTimes(const Vector& t)
    : t_(t),
      log_t_(t.array().log()),
      cosines_(cosines_of(t.size())),
      polynomial_(polynomial_of(*cosines_, t)),
      flat_(polynomial_, Spectrum::Ones(polynomial_.rows())),
      orthonormal_(orthonormal_polynomials(t)) {
  for (std::size_t k = 0; k < first_exponents.size(); ++k) {
    first_powers_[k] = power(first_exponents[k], cosines_->size);
  }
}

const Regression& BlockTimes::regression(Trend trend, Index count, std::size_t shape) {
  std::optional<Regression>& made = regressions_[{trend, count}][shape];
  if (made) return *made;
  const Cosines::Shape& noise = cosines_->shapes[shape];
  switch (trend) {
    case Trend::polynomial: made = with_shape(polynomial_.topRows(count), noise); break;
    case Trend::none: made = with_shape(cosines_->edges(count), noise); break;
    case Trend::line: made = with_shape(with_edges(polynomial_.topLeftCorner(count, 1), *cosines_), noise); break;
    case Trend::curve: made = with_shape(with_edges(polynomial_.topRows(count), *cosines_), noise); break;
  }
  return *made;
}

BlockTimes::Power BlockTimes::power(double p, Index count) const {
  const Vector series = (p * log_t_).array().exp();
  return {cosines_->transform(series, count), cosines_->transform(series.cwiseProduct(log_t_), count)};
}

BlockTimes::Power BlockTimes::first_power(std::size_t k, Index count) const {
  return {first_powers_[k].value.head(count), first_powers_[k].derivative.head(count)};
}

const Regression& BlockTimes::first_regression(std::size_t k, Index count, std::size_t shape) {
  std::optional<Regression>& made = first_regressions_[count][k][shape];
  if (!made) made = with_shape(with_edges(first_powers_[k].value.head(count), *cosines_), cosines_->shapes[shape]);
  return *made;
}

BlockTimes& block_times(const Vector& t) {
  constexpr std::size_t most_times = 16, most_regressions = 16;
  thread_local std::list<BlockTimes> kept;  // the latest one first
  const auto found = std::find_if(kept.begin(), kept.end(), [&](const BlockTimes& one) {
    return one.t_.size() == t.size() && one.t_ == t;  // Eigen compares equal sizes only
  });
  if (found != kept.end()) {
    kept.splice(kept.begin(), kept, found);
  } else {
    kept.emplace_front(t);
    if (kept.size() > most_times) kept.pop_back();
  }
  BlockTimes& times = kept.front();
  if (times.regressions_.size() > most_regressions) times.regressions_.clear();
  if (times.first_regressions_.size() > most_regressions) times.first_regressions_.clear();
  return times;
}

}  // namespace polhode::study::statistics::spectral
