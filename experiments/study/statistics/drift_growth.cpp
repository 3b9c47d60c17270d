// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/drift_growth.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "experiments/study/statistics/quantiles.hpp"

namespace polhode::study::inline statistics {
namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr Index most_cosines = 64, fewest_cosines = 9, most_regressors = 6;
using Spectrum = Vector;    ///< over the cosines
using Regressors = Matrix;  ///< a column each, over the cosines
using Normal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_regressors, most_regressors>;
using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_regressors, 1>;
constexpr double significance = 0.005;  // of the test for a secular drift
/// Fewer half periods than this in the run: no line is looked for, since it would not be told from a trend.
constexpr Index lowest_line = 8;
/// A number that comes once in some 3000 normal ones, in squares of their deviation.
constexpr double stands_out = 13;

/// Quantities that depend only on the number n of blocks.
class Cosines {
 public:
  explicit Cosines(Index n) : blocks(n), size(n - 1), even_(size / 2, (n + 1) / 2), odd_(size - size / 2, (n + 1) / 2) {
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

  /// c_k, k = 1 … count, of a series of n numbers.
  Spectrum transform(const Vector& series, Index count) const {
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
  Spectrum transform(const Vector& series) const { return transform(series, size); }

  /// Pulses at the first and the last block and, if there are enough cosines, at their neighbours: the spectrum that an
  /// oscillation with arbitrary phases at the ends has far below its line.
  Regressors edges(Index count) const {
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

  Index blocks, size;
  Spectrum log_frequency;  ///< ln(2 sin(θ/2)), θ = πk/n
  Spectrum log_averaging;  ///< ln((2 + cos θ)/3): what the means over blocks leave of a random walk
  struct Shape {
    Spectrum variance, logarithm;
  };
  /// Shapes of the noise a + b g_k, from b = 0 to a = 0.
  std::array<Shape, 9> shapes;

 private:
  /// √(2/n) cos(πk (2i + 1)/2n) over the first half of the blocks, for k = 2, 4, … and 1, 3, …
  Matrix even_, odd_;
};

/// Generalised least squares of c on the columns of x with variances s² v_k.
struct Fit {
  Coefficients coefficients;
  Normal covariance;      ///< of them, over s²
  double squares = 0;     ///< weighted sum of the residuals' squares
  double restricted = 0;  ///< logarithm of the restricted likelihood, the scale s² at its best
  double degrees = 0;     ///< of freedom
  double scale2() const { return squares / degrees; }
};

/// In four sums, none of which waits for another.
template <class A, class B>
double dot(const A& a, const B& b) {
  const Index n = a.size();
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  Index i = 0;
  for (; i + 4 <= n; i += 4) {
    s0 += a[i] * b[i];
    s1 += a[i + 1] * b[i + 1];
    s2 += a[i + 2] * b[i + 2];
    s3 += a[i + 3] * b[i + 3];
  }
  for (; i < n; ++i) s0 += a[i] * b[i];
  return (s0 + s1) + (s2 + s3);
}

Fit fit(const Spectrum& c, const Regressors& x, const Spectrum& v, double sum_of_log_v) {
  Fit f;
  const Spectrum weight = v.cwiseInverse();
  const Regressors weighted = weight.asDiagonal() * x;
  Normal normal(x.cols(), x.cols());
  Coefficients right(x.cols());
  for (Index j = 0; j < x.cols(); ++j) {
    for (Index i = 0; i <= j; ++i) normal(i, j) = normal(j, i) = dot(x.col(i), weighted.col(j));
    right[j] = dot(weighted.col(j), c);
  }
  const Eigen::LDLT<Normal> factors(normal);
  f.covariance = factors.solve(Normal::Identity(x.cols(), x.cols()));
  f.coefficients = f.covariance * right;
  const Spectrum rest = c - x * f.coefficients;
  // The data are of size one: below this there is nothing but the rounding of this arithmetic.
  constexpr double rounding2 = 1e-30;
  f.squares = std::max(dot(rest.cwiseAbs2().eval(), weight), rounding2);
  f.degrees = static_cast<double>(c.size() - x.cols());
  f.restricted = -0.5 * (sum_of_log_v + f.degrees * std::log(f.squares) + factors.vectorD().array().log().sum());
  return f;
}
Fit fit(const Spectrum& c, const Regressors& x, const Spectrum& v) { return fit(c, x, v, 0); }

/// The variances, to a factor, that are most likely beside these regressors.
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

/// The same of a series without regressors, divided out of the squares.
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

/// A line among the first cosines, that is, an oscillation that the blocks resolve: a square 25 times the mean of those
/// below it, or of the noise there. `rest`: of a fit by t and t², which takes the first cosines.
std::optional<Index> line_in(const Cosines& cosines, const Spectrum& rest) {
  constexpr double line = 25;
  constexpr Index lowest = lowest_line, gap = 3;  // four oscillations in the run; a line's flank
  const Spectrum power = rest.cwiseAbs2();
  if (!(power.maxCoeff() > 0)) return std::nullopt;
  const Spectrum white = whitened(cosines, power);
  Index at = 0;
  if (white.maxCoeff(&at) >= line * white.mean() && at + 1 >= lowest) return at + 1;
  const double peak = power.maxCoeff(&at);
  if (at + 1 >= lowest && peak >= line * power.head(at - gap).mean()) return at + 1;
  return std::nullopt;
}

/// cos and sin of ω (i + ½), i = 0 … n − 1.
Matrix oscillation(double omega, Index n) {
  Matrix x(n, 2);
  const double c = std::cos(omega), s = std::sin(omega);
  x(0, 0) = std::cos(omega / 2);
  x(0, 1) = std::sin(omega / 2);
  for (Index i = 1; i < n; ++i) {
    x(i, 0) = c * x(i - 1, 0) - s * x(i - 1, 1);
    x(i, 1) = s * x(i - 1, 0) + c * x(i - 1, 1);
  }
  return x;
}

/// The oscillation of the best frequency near the k-th cosine, of a least-squares fit by it and by the columns of
/// `trend`, which are orthonormal.
Vector fitted_oscillation(const Vector& series, const Matrix& trend, Index k) {
  const Index n = series.size();
  const double unit = std::numbers::pi / static_cast<double>(n), near = static_cast<double>(k);
  const Vector rest = series - trend * (trend.transpose() * series);
  const auto fit_at = [&](double place, Vector& oscillating) {
    const Matrix x = oscillation(place * unit, n);
    const Matrix free = x - trend.lazyProduct(trend.transpose().lazyProduct(x).eval());
    const Eigen::Matrix2d normal = free.transpose().lazyProduct(free);
    const Eigen::Vector2d amplitudes = normal.ldlt().solve(free.transpose().lazyProduct(rest));
    oscillating = x * amplitudes;
    return (rest - free * amplitudes).squaredNorm();
  };
  Vector oscillating;
  const auto squares = [&](double place) { return fit_at(place, oscillating); };
  constexpr int bits = 16;
  constexpr double reach = 1.2;
  fit_at(boost::math::tools::brent_find_minima(squares, near - reach, near + reach, bits).first, oscillating);
  return oscillating;
}

/// Number of the first cosines that lie well below every line.
Index below_lines(const Cosines& cosines, const Spectrum& rest) {
  Index count = rest.size();
  while (count > fewest_cosines) {
    const auto line = line_in(cosines, rest.head(count));
    if (!line) break;
    count = std::max(fewest_cosines, *line * 3 / 5);
  }
  return count;
}

struct Exponent {
  double value = 0, half_width = 0;
};

class Estimator {
 public:
  Estimator(const Cosines& cosines, const Vector& t, const Vector& drift)
      : cosines_(cosines), t_(t), log_t_(t.array().log()) {
    polynomial_.resize(cosines_.size, 2);
    polynomial_ << cosines_.transform(t), cosines_.transform(t.cwiseAbs2());
    const Spectrum c = cosines_.transform(drift);
    with_lines_ = c.head(std::min(most_cosines, below_lines(cosines_, without_polynomial(c))));
    without_lines(drift);
    trend_ = polynomial_.topRows(c_.size());
    edges_ = cosines_.edges(c_.size());
    v_ = noise_shape(cosines_, c_, with_edges(trend_));
  }

  bool secular() const {
    const Fit with = fit(c_, with_edges(trend_), v_), without = fit(c_, edges_, v_);
    const double f = (without.squares - with.squares) / 2 / with.scale2();
    return f > fisher_f_exceeded(2, with.degrees, significance);
  }

  /// Upper limit (97.5 % confidence) of a change in proportion to time over the run.
  double change_limit() const {
    const Fit f = fit(c_, with_edges(trend_.leftCols(1)), v_);
    return std::abs(f.coefficients[0]) + students_t_95(f.degrees) * std::sqrt(f.scale2() * f.covariance(0, 0));
  }

  /// Half the 95 % interval of the slope by ordinary least squares, which the oscillations affect too.
  double slope_half_width() const {
    const Regressors x = polynomial_.topRows(with_lines_.size());
    const Spectrum v = noise_shape(cosines_, with_lines_, x), x2 = x.col(0).cwiseAbs2();
    const Fit f = fit(with_lines_, x, v);
    return students_t_95(f.degrees) * std::sqrt(f.scale2() * x2.dot(v)) / x2.sum();
  }

  /// constant + a t^p, by Gauss and Newton: the regressors are t^p and its derivative with respect to p.
  Exponent power_law() {
    constexpr double least = 0.05, most = 20, longest_step = 0.5, close = 1e-5;
    constexpr int passes = 2, most_steps = 20;
    double p = start();
    for (int pass = 0; pass < passes; ++pass) {
      for (int i = 0; i < most_steps; ++i) {
        const Fit f = fit(c_, power_regressors(p), v_);
        const double step = std::clamp(f.coefficients[1] / f.coefficients[0], -longest_step, longest_step);
        p = std::clamp(p + step, least, most);
        if (!(std::abs(step) > close)) break;
      }
      if (pass + 1 < passes) v_ = noise_shape(cosines_, c_, power_regressors(p));
    }
    const Regressors x = power_regressors(p);
    const Fit f = fit(c_, x, v_);
    change_ = std::abs(f.coefficients[0]) * (1 - std::pow(t_[0], p));
    misfit_ = c_ - x.col(0) * f.coefficients[0];
    const double error = std::sqrt(f.scale2() * f.covariance(1, 1)) / std::abs(f.coefficients[0]);
    return {p, students_t_95(f.degrees) * error};
  }

  /// Change by t^p over the run; call after power_law().
  double change() const { return change_; }

  /// Half of the number of the strongest cosine beside t^p, where those that are too slow for a line come to half of
  /// the change from peak to peak.
  double slow_periods_beside_growth() const {
    const Spectrum low = misfit_.head(lowest_line - 1).cwiseAbs2();
    Index at = 0;
    low.maxCoeff(&at);
    return peak_to_peak(low.sum()) > change_ / 2 ? static_cast<double>(at + 1) / 2 : 0;
  }

  /// From peak to peak, of what t^p leaves, where that is smooth.
  double smooth_misfit() const {
    constexpr Index smooth = 4;
    constexpr double far_above = 20;
    const Spectrum power = misfit_.cwiseAbs2();
    const double low = power.head(smooth).sum(), high = power.tail(power.size() - smooth).sum();
    return low > far_above * high ? peak_to_peak(low) : 0;
  }

  /// Half of the number of the strongest cosine that is too slow for a line; 0: a faster one is stronger.
  double slow_periods() const {
    Index at = 0;
    c_.cwiseAbs2().maxCoeff(&at);
    return at + 1 < lowest_line ? static_cast<double>(at + 1) / 2 : 0;
  }

  /// True if the rest is noise of the exponent h throughout: no cosine stands out, no third of them (by logarithm) has
  /// more than its share, and no change between blocks stands out from those of a random walk.
  bool is_even(double h) const {
    const Spectrum per_h = cosines_.log_averaging.head(below_.size()) - 2 * cosines_.log_frequency.head(below_.size());
    const Spectrum white = below_.cwiseAbs2().cwiseQuotient(((h + 0.5) * per_h).array().exp().matrix());
    const Vector steps = (smooth_.tail(smooth_.size() - 1) - smooth_.head(smooth_.size() - 1)).cwiseAbs2();
    const auto its_part = [&](Index from, Index to) {
      // The mean of m squares of normal numbers has the standard deviation √(2/m).
      const double part = white.segment(from, to - from).mean() / white.mean();
      return std::abs(part - 1) < 2 * std::sqrt(2 / static_cast<double>(to - from));
    };
    constexpr Index fewest = 48;
    const Index n = white.size();
    return n >= fewest && its_part(0, 4) && its_part(4, 16) && its_part(16, n) &&
           white.maxCoeff() < stands_out * white.mean() && steps.maxCoeff() < stands_out * steps.mean();
  }

  /// H of v_k = s² (2 sin(θ/2))^−(1+2H).
  Exponent noise_exponent() const {
    const Index used = below_.size();
    const Spectrum per_h = cosines_.log_averaging.head(used) - 2 * cosines_.log_frequency.head(used);
    const Regressors edges = cosines_.edges(used);
    const auto minus_likelihood = [&](double h) {
      const Spectrum log_v = (h + 0.5) * per_h;
      return -fit(below_, edges, log_v.array().exp(), log_v.sum()).restricted;
    };
    constexpr double least = -1.5, most = 2.5;
    constexpr int bits = 16;
    const double h = boost::math::tools::brent_find_minima(minus_likelihood, least, most, bits).first;
    const double information = 0.5 * (per_h.array() - per_h.mean()).square().sum();
    return {h, students_t_95(static_cast<double>(used - 2)) / std::sqrt(information)};
  }

  /// The rest without the oscillations that were subtracted.
  double largest_rest() const { return (smooth_.array() - smooth_.mean()).abs().maxCoeff(); }
  double largest_oscillation() const { return largest_oscillation_; }
  /// Number of its periods in the run.
  double slowest_line() const { return static_cast<double>(slowest_line_) / 2; }

 private:
  /// Peak-to-peak amplitude of a sine whose cosines have this sum of squares.
  double peak_to_peak(double squares) const { return 2 * std::sqrt(2 * squares / static_cast<double>(t_.size())); }

  Spectrum without_polynomial(const Spectrum& c) const {
    return c - polynomial_ * fit(c, polynomial_, Spectrum::Ones(c.size())).coefficients;
  }

  /// Takes out, one after the other, the oscillations that the blocks resolve.
  void without_lines(const Vector& drift) {
    constexpr int most_oscillations = 8;
    Matrix polynomial(t_.size(), 3);
    polynomial << Vector::Ones(t_.size()), t_, t_.cwiseAbs2();
    const Matrix trend = polynomial.householderQr().householderQ() * Matrix::Identity(t_.size(), polynomial.cols());
    Vector smooth = drift;
    Spectrum c = cosines_.transform(smooth), rest = without_polynomial(c);
    for (int i = 0; i < most_oscillations; ++i) {
      const auto line = line_in(cosines_, rest);
      if (!line) break;
      smooth -= fitted_oscillation(smooth, trend, *line);
      slowest_line_ = i == 0 ? *line : std::min(slowest_line_, *line);
      c = cosines_.transform(smooth);
      rest = without_polynomial(c);
    }
    below_ = c.head(below_lines(cosines_, rest));
    c_ = below_.head(std::min(most_cosines, below_.size()));
    largest_oscillation_ = (drift - smooth).cwiseAbs().maxCoeff();
    smooth_ = std::move(smooth);
  }

  Regressors with_edges(const Regressors& x) const {
    Regressors both(x.rows(), x.cols() + edges_.cols());
    both << x, edges_;
    return both;
  }

  Regressors power_regressors(double p) const {
    const Vector power = (p * log_t_).array().exp();
    Regressors x(c_.size(), 2);
    x << cosines_.transform(power, c_.size()), cosines_.transform(power.cwiseProduct(log_t_), c_.size());
    return with_edges(x);
  }

  double start() const {
    double best = 1, least = std::numeric_limits<double>::infinity();
    for (const double p : {0.5, 1.0, 2.0, 4.0}) {
      const Regressors x = cosines_.transform((p * log_t_).array().exp(), c_.size());
      const double squares = fit(c_, with_edges(x), v_).squares;
      if (squares < least) {
        least = squares;
        best = p;
      }
    }
    return best;
  }

  const Cosines& cosines_;
  Vector t_, log_t_;
  Regressors polynomial_;  ///< t and t², all cosines
  Spectrum with_lines_;    ///< the drift's cosines below its lowest line
  Spectrum below_;         ///< the drift's cosines without its lines, those that are well below what is left of them
  Spectrum c_, v_;         ///< the first of these, which trends are fitted to, and the shape of their variance
  Regressors trend_, edges_;
  Vector smooth_;    ///< the drift without its lines
  Spectrum misfit_;  ///< c_ without t^p
  double largest_oscillation_ = 0, change_ = 0;
  Index slowest_line_ = 0;
};

/// Kept for later calls, since many runs of a study have as many blocks: at most half a megabyte each.
const Cosines& cosines_of(Index n) {
  constexpr std::size_t most = 16;
  thread_local std::map<Index, Cosines> kept;
  if (kept.size() >= most && !kept.contains(n)) kept.clear();
  return kept.try_emplace(n, n).first->second;
}

}  // namespace

void BlockMeans::close() {
  sums_.push_back(open_);
  open_ = {};
  in_open_ = 0;
  if (sums_.size() < capacity) return;
  for (std::size_t i = 0; i < capacity / 2; ++i) {
    const BlockMean &a = sums_[2 * i], &b = sums_[2 * i + 1];
    sums_[i] = {a.t + b.t, a.value + b.value};
  }
  sums_.resize(capacity / 2);
  per_block_ *= 2;
}

std::vector<BlockMean> BlockMeans::finish() const {
  std::vector<BlockMean> means;
  const auto mean = [&](const BlockMean& sum, std::size_t n) {
    means.push_back({sum.t / static_cast<double>(n), sum.value / static_cast<double>(n)});
  };
  for (const BlockMean& sum : sums_) mean(sum, per_block_);
  if (2 * in_open_ >= per_block_ && in_open_ > 0) mean(open_, in_open_);
  return means;
}

std::optional<DriftGrowth> growth_of(const std::vector<BlockMean>& blocks) {
  if (blocks.size() < fewest_blocks) return std::nullopt;
  const auto n = static_cast<Index>(blocks.size());
  Vector t(n), drift(n);
  for (Index i = 0; i < n; ++i) {
    t[i] = blocks[static_cast<std::size_t>(i)].t;
    drift[i] = blocks[static_cast<std::size_t>(i)].value;
  }
  const double end = t[n - 1], largest = drift.cwiseAbs().maxCoeff();
  if (!drift.allFinite() || !t.allFinite() || !(t[0] >= 0) || !(end > t[0])) return std::nullopt;
  t = (t / end).cwiseMax(std::numeric_limits<double>::min());
  drift.array() -= drift.mean();
  const double size = drift.cwiseAbs().maxCoeff();
  if (!(size > std::numeric_limits<double>::epsilon() * largest)) return std::nullopt;
  drift /= size;

  Estimator estimate(cosines_of(n), t, drift);
  DriftGrowth growth;
  growth.slope_half_width_95 = estimate.slope_half_width() * size / end;
  growth.secular = estimate.secular();
  growth.change_limit = estimate.change_limit() * size;
  growth.rest = estimate.largest_rest() * size;
  growth.oscillation = estimate.largest_oscillation() * size;
  growth.slowest_line = estimate.slowest_line();
  Exponent p;
  if (growth.secular) {
    p = estimate.power_law();
    growth.change = estimate.change() * size;
    growth.slow_periods = estimate.slow_periods_beside_growth();
    growth.misfit = estimate.smooth_misfit() * size;
  } else {
    p = estimate.noise_exponent();
    growth.slow_periods = estimate.slow_periods();
    growth.even = estimate.is_even(p.value);
  }
  growth.exponent = p.value;
  growth.low = p.value - p.half_width;
  growth.high = p.value + p.half_width;
  return growth;
}

}  // namespace polhode::study::statistics
