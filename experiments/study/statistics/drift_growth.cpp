// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/drift_growth.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "experiments/study/statistics/cosine_spectrum.hpp"
#include "experiments/study/statistics/quantiles.hpp"
#include "experiments/study/statistics/spectral_lines.hpp"

namespace polhode::study::inline statistics {
namespace {

using namespace spectral;

constexpr Index most_cosines = 64;
constexpr double significance = 0.005;  // of the test for a secular drift
/// A number that comes once in some 3000 normal ones, in squares of their deviation.
constexpr double stands_out = 13;

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

}  // namespace

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
