// SPDX-License-Identifier: BSD-3-Clause
// Random values of a key: "uniform(0.5, 3)". The value of a point depends on the seed, the name of the key and the
// number of the point alone, so that a study with more points or more keys keeps the values that it had. All platforms
// draw the same bits: the numbers come from a counter-based generator (Philox4x32-10: Salmon, Moraes, Dror & Shaw,
// SC 2011), and are made into values with + - * / and square roots, which IEEE 754 rounds correctly.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/record/run_options.hpp"

namespace polhode::study::inline plan {

/// The uniform numbers of one point of one key.
class PointRandom {
 public:
  PointRandom(std::uint64_t seed, std::string_view key, std::uint32_t point);
  double uniform();  ///< number in (0, 1), a multiple of 2^-53

 private:
  std::uint64_t seed_, key_;
  std::uint32_t point_, block_ = 0;
  double next_ = 0;  ///< the second number of the last block; 0: none
};

class Distribution {
 public:
  /// Reads a distribution of the values of an option (null: of a key of the scenario). Throws InputError, which begins
  /// with the label.
  static Distribution parse(const std::string& text, const RunOption* option, const std::string& label);

  /// The value of a point: that of the option, or a TOML text. Throws InputError if the option cannot have that number.
  OptionValue draw(std::uint64_t seed, std::string_view key, std::uint32_t point) const;

  /// The number that draw() makes a value of, which it checks and this does not; absent: it draws no numbers.
  std::optional<double> number(std::uint64_t seed, std::string_view key, std::uint32_t point) const;
  /// The values among which draw() chooses, and the one of a point; null and unspecified: it is no choice.
  const std::vector<OptionValue>* choices() const { return choices_.get(); }
  std::size_t choice(std::uint64_t seed, std::string_view key, std::uint32_t point) const;

 private:
  // One of these is set.
  std::function<double(PointRandom&)> number_;
  std::shared_ptr<const std::vector<OptionValue>> choices_;
  std::function<std::string(PointRandom&)> text_;
  std::function<OptionValue(double)> value_of_number_;  ///< set with number_
};

/// Names and parameters of the distributions: {"uniform", {"from", "to"}}.
struct DistributionKind {
  std::string_view name;
  std::vector<std::string_view> parameters;
};
const std::vector<DistributionKind>& distribution_kinds();

}  // namespace polhode::study::plan
