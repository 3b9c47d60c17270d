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

}  // namespace

BlockTimes::BlockTimes(const Vector& t)
    : t_(t),
      log_t_(t.array().log()),
      cosines_(cosines_of(t.size())),
      polynomial_(polynomial_of(*cosines_, t)),
      flat_(polynomial_, Spectrum::Ones(polynomial_.rows())) {
  for (std::size_t k = 0; k < first_exponents.size(); ++k) {
    first_powers_[k] = cosines_->transform((first_exponents[k] * log_t_).array().exp());
  }
}

Matrix BlockTimes::orthonormal() const {
  Matrix polynomial(t_.size(), 3);
  polynomial << Vector::Ones(t_.size()), t_, t_.cwiseAbs2();
  return polynomial.householderQr().householderQ() * Matrix::Identity(t_.size(), polynomial.cols());
}

const Regression& BlockTimes::regression(Trend trend, Index count, std::size_t shape) {
  std::optional<Regression>& made = regressions_[{trend, count}][shape];
  if (made) return *made;
  const Cosines::Shape& noise = cosines_->shapes[shape];
  const Spectrum v = noise.variance.head(count);
  const double sum_of_log_v = noise.sum_of_logs[count - 1];
  if (trend == Trend::polynomial) return made.emplace(polynomial_.topRows(count), v, sum_of_log_v);
  const Regressors edges = cosines_->edges(count);
  if (trend == Trend::none) return made.emplace(edges, v, sum_of_log_v);
  const Index columns = trend == Trend::line ? 1 : 2;
  Regressors x(count, columns + edges.cols());
  x << polynomial_.topLeftCorner(count, columns), edges;
  return made.emplace(x, v, sum_of_log_v);
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
  return times;
}

}  // namespace polhode::study::statistics::spectral
