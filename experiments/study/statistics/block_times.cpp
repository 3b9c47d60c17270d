// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/block_times.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <list>

namespace polhode::study::inline statistics::spectral {
namespace {

Matrix polynomial_of(const Cosines& cosines, const Vector& t) {
  Matrix x(cosines.size, 2);
  x << cosines.transform(t), cosines.transform(t.cwiseAbs2());
  return x;
}

Matrix orthonormal_polynomials(const Vector& t) {
  Matrix polynomial(t.size(), 3);
  polynomial << Vector::Ones(t.size()), t, t.cwiseAbs2();
  return polynomial.householderQr().householderQ() * Matrix::Identity(t.size(), polynomial.cols());
}

/// The regressors x and the pulses.
Regressors with_edges(const Matrix& x, const Cosines& cosines) {
  Regressors all = cosines.edges(x.rows());
  Matrix both(x.rows(), x.cols() + all.x.cols());
  both << x, all.x;
  all.x = std::move(both);
  return all;
}

}  // namespace

BlockTimes::BlockTimes(const Vector& t)
    : t_(t),
      log_t_(t.array().log()),
      cosines_(cosines_of(t.size())),
      polynomial_{polynomial_of(*cosines_, t)},
      flat_(polynomial_, cosines_->shapes.front().inverse, 0),
      orthonormal_(orthonormal_polynomials(t)) {
  for (std::size_t k = 0; k < first_exponents.size(); ++k) {
    first_powers_[k] = power(first_exponents[k], std::min(most_cosines, cosines_->size));
  }
}

Regressions& BlockTimes::regressions(Trend trend, Index count) {
  const Key key{trend, count};
  const auto made = regressions_.find(key);
  if (made != regressions_.end()) return made->second;
  const auto regressors = [&]() -> Regressors {
    switch (trend) {
      case Trend::polynomial: return {polynomial().topRows(count)};
      case Trend::none: return cosines_->edges(count);
      case Trend::line: return with_edges(polynomial().topLeftCorner(count, 1), *cosines_);
      case Trend::curve: break;
    }
    return with_edges(polynomial().topRows(count), *cosines_);
  };
  return regressions_.try_emplace(key, *cosines_, regressors()).first->second;
}

const BlockTimes::Slope& BlockTimes::slope(Index count) {
  const auto [at, is_new] = slopes_.try_emplace(count);
  Slope& slope = at->second;
  if (is_new) {
    const Spectrum x2 = polynomial().col(0).head(count).cwiseAbs2();
    slope.squares = x2.sum();
    for (std::size_t shape = 0; shape < noise_shapes; ++shape) {
      slope.with_noise[shape] = x2.dot(cosines_->shapes[shape].variance.head(count));
    }
  }
  return slope;
}

BlockTimes::Power BlockTimes::power(double p, Index count) {
  power_ = (p * log_t_).array().exp();
  derivative_ = power_.cwiseProduct(log_t_);
  Power c{Low(count), Low(count)};
  cosines_->transform(power_, derivative_, c.value, c.derivative);
  return c;
}

BlockTimes::Power BlockTimes::first_power(std::size_t k, Index count) const {
  return {first_powers_[k].value.head(count), first_powers_[k].derivative.head(count)};
}

std::deque<Regressions>& BlockTimes::first_regressions(Index count) {
  std::deque<Regressions>& all = first_regressions_[count];
  if (all.empty()) {
    for (const Power& power : first_powers_)
      all.emplace_back(*cosines_, with_edges(power.value.head(count), *cosines_));
  }
  return all;
}

namespace {

bool are_the_same(const Vector& t, const std::vector<BlockMean>& blocks) {
  if (t.size() != static_cast<Index>(blocks.size())) return false;
  bool same = true;
  for (Index i = 0; i < t.size(); ++i) same &= t[i] == blocks[static_cast<std::size_t>(i)].t;
  return same;
}

}  // namespace

BlockTimes* block_times(const std::vector<BlockMean>& blocks) {
  constexpr std::size_t most_times = 16, most_regressions = 16;
  thread_local std::list<BlockTimes> kept;  // the latest one first
  auto found =
      std::find_if(kept.begin(), kept.end(), [&](const BlockTimes& one) { return are_the_same(one.given_, blocks); });
  if (found == kept.end()) {
    Vector given(static_cast<Index>(blocks.size()));
    for (Index i = 0; i < given.size(); ++i) given[i] = blocks[static_cast<std::size_t>(i)].t;
    const double end = given[given.size() - 1];
    if (!given.allFinite() || !(given[0] >= 0) || !(end > given[0])) return nullptr;
    const Vector t = (given / end).cwiseMax(std::numeric_limits<double>::min());
    found = std::find_if(kept.begin(), kept.end(), [&](const BlockTimes& one) {
      return one.t_.size() == t.size() && one.t_ == t;  // Eigen compares equal sizes only
    });
    if (found == kept.end()) found = kept.emplace(kept.begin(), t);
    found->given_ = std::move(given);
  }
  kept.splice(kept.begin(), kept, found);
  if (kept.size() > most_times) kept.pop_back();
  BlockTimes& times = kept.front();
  if (times.regressions_.size() > most_regressions) times.regressions_.clear();
  if (times.first_regressions_.size() > most_regressions) times.first_regressions_.clear();
  return &times;
}

}  // namespace polhode::study::statistics::spectral
