// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/drift_growth.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

#include "experiments/study/statistics/block_times.hpp"
#include "experiments/study/statistics/cosine_spectrum.hpp"
#include "experiments/study/statistics/eight.hpp"
#include "experiments/study/statistics/quantiles.hpp"
#include "experiments/study/statistics/spectral_lines.hpp"

namespace polhode::study::inline statistics {
namespace {

using namespace spectral;

constexpr double significance = 0.005;  // level of significance of the test for a secular drift
/// A number that comes once in some 3000 normal ones, in squares of their deviation.
constexpr double stands_out = 13;

struct Exponent {
  double value = 0, half_width = 0;
};

/// Estimates from a series over blocks. slope_half_width() may be called at once, all others after separate().
class Estimator {
 public:
  Estimator(BlockTimes& times, const Vector& drift)
      : times_(times), cosines_(times.cosines()), drift_(drift), all_(cosines_.transform(drift)) {
    const Spectrum rest = without_polynomial(all_);
    strongest_line_ = line_in(cosines_, rest);
    with_lines_ = all_.head(std::min(most_cosines, strongest_line_ ? below_lines(cosines_, rest) : rest.size()));
  }

  /// Half the 95 % interval of the slope by ordinary least squares, which the oscillations affect too.
  double slope_half_width() {
    const Noise noise = likeliest(with_lines_, Trend::polynomial);
    const BlockTimes::Slope& slope = times_.slope(with_lines_.size());
    return students_t_95(noise.degrees) * std::sqrt(noise.scale2() * slope.with_noise[noise.shape]) / slope.squares;
  }

  /// Takes out the oscillations, and finds the noise beside a trend.
  void separate() {
    without_lines();
    beside_curve_ = likeliest(c_, Trend::curve);
    shape_ = beside_curve_.shape;
  }

  bool secular() {
    const double without = regression(Trend::none).squares(c_);
    const double f = (without - beside_curve_.squares) / 2 / beside_curve_.scale2();
    return f > fisher_f_exceeded(2, beside_curve_.degrees, significance);
  }

  /// Upper limit (97.5 % confidence) of a change in proportion to time over the run.
  double change_limit() {
    const Fit f = regression(Trend::line).fit(c_);
    return std::abs(f.coefficients[0]) + students_t_95(f.degrees) * std::sqrt(f.scale2() * f.variances[0]);
  }

  /// constant + a t^p, by Gauss and Newton: the regressors are t^p and its derivative with respect to p.
  Exponent power_law() {
    constexpr double least = 0.05, most = 20, longest_step = 0.5, close = 1e-5;
    constexpr int passes = 2, most_steps = 20;
    const Index count = c_.size();
    const std::size_t first = best_first();
    double p = BlockTimes::first_exponents[first];
    BlockTimes::Power x = times_.first_power(first, count);
    Regressions& pulses = times_.regressions(Trend::none, count);
    const auto fit = [&](std::size_t shape) { return pulses[shape].fit_beside(x.value, x.derivative, c_); };
    FitBeside f = fit(shape_);
    for (int pass = 0; pass < passes; ++pass) {
      for (int i = 0; i < most_steps; ++i) {
        const double step = std::clamp(f.z / f.x, -longest_step, longest_step);
        p = std::clamp(p + step, least, most);
        x = times_.power(p, count);
        if (!(std::abs(step) > close)) break;
        f = fit(shape_);
      }
      if (pass + 1 < passes) {
        std::array<FitBeside, noise_shapes> fits;
        for (std::size_t shape = 0; shape < noise_shapes; ++shape) fits[shape] = fit(shape);
        shape_ = likeliest_shape([&](std::size_t shape) { return pulses[shape].restricted(fits[shape]); });
        f = fits[shape_];
      }
    }
    f = fit(shape_);
    change_ = std::abs(f.x) * (1 - std::pow(times_.t()[0], p));
    misfit_ = c_ - x.value * f.x;
    const double error = std::sqrt(f.scale2() * (1 / f.pivot)) / std::abs(f.x);
    return {p, students_t_95(f.degrees) * error};
  }

  /// Change by t^p over the run; call after power_law().
  double change() const { return change_; }

  /// Half of the number of the strongest cosine beside t^p, where those that are too slow for a line come to half of
  /// the change from peak to peak.
  double slow_periods_beside_growth() const {
    const Low low = misfit_.head(lowest_line - 1).cwiseAbs2();
    Index at = 0;
    low.maxCoeff(&at);
    return peak_to_peak(low.sum()) > change_ / 2 ? static_cast<double>(at + 1) / 2 : 0;
  }

  /// The misfit that t^p leaves, from peak to peak, where that is smooth.
  double smooth_misfit() const {
    constexpr Index smooth = 4;
    constexpr double far_above = 20;
    const Low power = misfit_.cwiseAbs2();
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
    const Vector& smooth = this->smooth();
    const Vector steps = (smooth.tail(smooth.size() - 1) - smooth.head(smooth.size() - 1)).cwiseAbs2();
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
      const Spectrum log_v = (h + 0.5) * per_h, weight = log_v.array().exp().inverse();
      const Regression regression(edges, weight, log_v.sum());
      return -regression.restricted(regression.squares(below_));
    };
    constexpr double least = -1.5, most = 2.5;
    constexpr int bits = 16;
    const double h = boost::math::tools::brent_find_minima(minus_likelihood, least, most, bits).first;
    const double information = 0.5 * (per_h.array() - per_h.mean()).square().sum();
    return {h, students_t_95(static_cast<double>(used - 2)) / std::sqrt(information)};
  }

  /// The rest without the oscillations that were subtracted.
  double largest_rest() const {
    const double mean = sum(smooth().data(), smooth().size()) / static_cast<double>(smooth().size());
    return largest_distance(smooth().data(), smooth().size(), mean);
  }
  double largest_oscillation() const { return largest_oscillation_; }
  /// Number of its periods in the run.
  double slowest_line() const { return static_cast<double>(slowest_line_) / 2; }

 private:
  /// The most likely noise beside a trend.
  struct Noise {
    std::size_t shape = 0;            ///< of its variances
    double squares = 0, degrees = 0;  ///< those of Fit
    double scale2() const { return squares / degrees; }
  };

  /// Peak-to-peak amplitude of a sine whose cosines have this sum of squares.
  double peak_to_peak(double squares) const {
    return 2 * std::sqrt(2 * squares / static_cast<double>(times_.t().size()));
  }

  Spectrum without_polynomial(const Spectrum& c) const {
    const Matrix& x = times_.polynomial();
    const Coefficients a = times_.flat().fit(c).coefficients;
    return c - (x.col(0) * a[0] + x.col(1) * a[1]);
  }

  Noise likeliest(const Low& c, Trend trend) {
    Regressions& regressions = times_.regressions(trend, c.size());
    const auto squares = regressions.squares(c);
    const std::size_t shape = likeliest_shape([&](std::size_t k) { return regressions[k].restricted(squares[k]); });
    return {shape, squares[shape], regressions[shape].degrees()};
  }

  /// The regression for c_ with its noise.
  const Regression& regression(Trend trend) { return times_.regressions(trend, c_.size())[shape_]; }

  /// Takes out, one after the other, the oscillations that the blocks resolve.
  void without_lines() {
    constexpr int most_oscillations = 8;
    below_ = std::move(all_);
    if (strongest_line_) {
      const Matrix& trend = times_.orthonormal();
      Spectrum rest = without_polynomial(below_);
      smooth_ = drift_;
      for (int i = 0; i < most_oscillations; ++i) {
        const auto line = i == 0 ? strongest_line_ : line_in(cosines_, rest);
        if (!line) break;
        smooth_ -= fitted_oscillation(smooth_, trend, *line);
        slowest_line_ = i == 0 ? *line : std::min(slowest_line_, *line);
        below_ = cosines_.transform(smooth_);
        rest = without_polynomial(below_);
      }
      below_.conservativeResize(below_lines(cosines_, rest));
      const Vector oscillations = drift_ - smooth_;
      largest_oscillation_ = largest_size(oscillations.data(), oscillations.size());
    }
    c_ = below_.head(std::min(most_cosines, below_.size()));
  }

  /// The drift without its lines.
  const Vector& smooth() const { return strongest_line_ ? smooth_ : drift_; }

  /// Number of the first exponent with the least misfit.
  std::size_t best_first() {
    std::size_t best = 1;
    double least = std::numeric_limits<double>::infinity();
    std::deque<Regressions>& regressions = times_.first_regressions(c_.size());
    for (std::size_t k = 0; k < BlockTimes::first_exponents.size(); ++k) {
      const double squares = regressions[k][shape_].squares(c_);
      if (squares < least) {
        least = squares;
        best = k;
      }
    }
    return best;
  }

  BlockTimes& times_;
  const Cosines& cosines_;
  const Vector& drift_;
  Spectrum all_;                         ///< the drift's cosines, until separate()
  std::optional<Index> strongest_line_;  ///< the first one to be taken out
  alignas(64) Low with_lines_;           ///< the drift's cosines below its lowest line
  Spectrum below_;         ///< the drift's cosines without its lines, those that are well below what is left of them
  alignas(64) Low c_;      ///< the first of these, which trends are fitted to
  Noise beside_curve_;     ///< the noise in them beside a trend
  std::size_t shape_ = 0;  ///< shape of their variances
  Vector smooth_;          ///< the drift without its lines, where it has some
  Low misfit_;             ///< c_ without t^p
  double largest_oscillation_ = 0, change_ = 0;
  Index slowest_line_ = 0;
};

/// The series of a drift, over its largest deviation from its mean.
struct Series {
  BlockTimes& times;
  Vector drift;  ///< less its mean, over `size`
  double size = 0, end = 0;
};

std::optional<Series> series_of(const std::vector<BlockMean>& blocks) {
  if (blocks.size() < fewest_blocks) return std::nullopt;
  const auto n = static_cast<Index>(blocks.size());
  Vector drift(n);
  for (Index i = 0; i < n; ++i) drift[i] = blocks[static_cast<std::size_t>(i)].value;
  if (!all_finite(drift.data(), n)) return std::nullopt;
  const double largest = largest_size(drift.data(), n);
  drift.array() -= sum(drift.data(), n) / static_cast<double>(n);
  const double size = largest_size(drift.data(), n);
  if (!(size > std::numeric_limits<double>::epsilon() * largest)) return std::nullopt;
  drift /= size;
  BlockTimes* times = block_times(blocks);
  if (!times) return std::nullopt;
  return Series{*times, std::move(drift), size, blocks.back().t};
}

}  // namespace

std::optional<double> slope_half_width_95(const std::vector<BlockMean>& blocks) {
  const auto series = series_of(blocks);
  if (!series) return std::nullopt;
  return Estimator(series->times, series->drift).slope_half_width() * series->size / series->end;
}

std::optional<DriftGrowth> growth_of(const std::vector<BlockMean>& blocks) {
  const auto series = series_of(blocks);
  if (!series) return std::nullopt;
  const double size = series->size, end = series->end;
  Estimator estimate(series->times, series->drift);
  DriftGrowth growth;
  growth.slope_half_width_95 = estimate.slope_half_width() * size / end;
  estimate.separate();
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
