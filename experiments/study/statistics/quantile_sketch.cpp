// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/quantile_sketch.hpp"

#include <algorithm>
#include <cmath>

namespace polhode::study::inline statistics {
namespace {

/// Bin k holds the magnitudes in (ratio^(k−1), ratio^k].
const double log_ratio = std::log((1 + QuantileSketch::relative_error) / (1 - QuantileSketch::relative_error));

std::int32_t bin_of(double magnitude) { return static_cast<std::int32_t>(std::ceil(std::log(magnitude) / log_ratio)); }

/// The magnitude that differs from both ends of the bin by the same share.
double middle_of(std::int32_t bin) { return 2 * std::exp(bin * log_ratio) / (1 + std::exp(log_ratio)); }

}  // namespace

void QuantileSketch::add(double value) {
  ++count_;
  least_ = std::min(least_, value);
  largest_ = std::max(largest_, value);
  if (value == 0) ++zeros_;
  else ++(value < 0 ? negative_ : positive_)[bin_of(std::abs(value))];
}

std::optional<double> QuantileSketch::quantile(double share) const {
  if (count_ == 0) return std::nullopt;
  const auto rank = static_cast<std::uint64_t>(std::llround(share * static_cast<double>(count_ - 1)));
  if (rank == 0) return least_;
  if (rank == count_ - 1) return largest_;
  const auto within = [&](double value) { return std::clamp(value, least_, largest_); };
  std::uint64_t below = 0;
  for (auto bin = negative_.rbegin(); bin != negative_.rend(); ++bin) {
    below += bin->second;
    if (rank < below) return within(-middle_of(bin->first));
  }
  below += zeros_;
  if (rank < below) return 0;
  for (const auto& [bin, counted] : positive_) {
    below += counted;
    if (rank < below) return within(middle_of(bin));
  }
  return largest_;
}

}  // namespace polhode::study::statistics
