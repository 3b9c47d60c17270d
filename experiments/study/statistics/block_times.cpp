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

}  // namespace

BlockTimes::BlockTimes(const Vector& t)
    : t_(t),
      log_t_(t.array().log()),
      cosines_(cosines_of(t.size())),
      polynomial_(polynomial_of(*cosines_, t)),
      flat_(polynomial_, cosines_->shapes.front().inverse, 0),
      orthonormal_(orthonormal_polynomials(t)) {
  for (std::size_t k = 0; k < first_exponents.size(); ++k) {
    first_powers_[k] = power(first_exponents[k], cosines_->size);
  }
}

const Regression& BlockTimes::with_shape(Shaped& all, std::size_t shape) const {
  std::optional<Regression>& made = all.made[shape];
  if (!made) {
    const Cosines::Shape& noise = cosines_->shapes[shape];
    made.emplace(all.x, noise.inverse, noise.sum_of_logs[all.x.rows() - 1]);
  }
  return *made;
}

const Regression& BlockTimes::regression(Trend trend, Index count, std::size_t shape) {
  Shaped& all = regressions_[{trend, count}];
  if (all.x.size() == 0) {
    switch (trend) {
      case Trend::polynomial: all.x = polynomial_.topRows(count); break;
      case Trend::none: all.x = cosines_->edges(count); break;
      case Trend::line: all.x = with_edges(polynomial_.topLeftCorner(count, 1), *cosines_); break;
      case Trend::curve: all.x = with_edges(polynomial_.topRows(count), *cosines_); break;
    }
  }
  return with_shape(all, shape);
}

BlockTimes::Power BlockTimes::power(double p, Index count) const {
  const Vector series = (p * log_t_).array().exp();
  return {cosines_->transform(series, count), cosines_->transform(series.cwiseProduct(log_t_), count)};
}

BlockTimes::Power BlockTimes::first_power(std::size_t k, Index count) const {
  return {first_powers_[k].value.head(count), first_powers_[k].derivative.head(count)};
}

const Regression& BlockTimes::first_regression(std::size_t k, Index count, std::size_t shape) {
  Shaped& all = first_regressions_[count][k];
  if (all.x.size() == 0) all.x = with_edges(first_powers_[k].value.head(count), *cosines_);
  return with_shape(all, shape);
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
