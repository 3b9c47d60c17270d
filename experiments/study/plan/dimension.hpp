// SPDX-License-Identifier: BSD-3-Clause
// One factor of the product that a study is: an axis of its grid, or a table of points (zip, random, cells).
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/plan/study_axes.hpp"
#include "experiments/study/record/run_options.hpp"

namespace polhode::study::inline plan {

struct DimensionKey {
  const RunOption* option;  ///< null: a key of the scenario
  std::string name;
  std::string label;  ///< name in error messages; empty: a key of --vary
};

/// A value as conditions read it.
struct Glance {
  enum class Kind { none, number, text, unknown };  ///< none: the point does not give the key; unknown: see value()
  Kind kind = Kind::unknown;
  double number = 0;
  std::string_view text{};
};

struct Dimension {
  std::vector<DimensionKey> keys;
  std::size_t size = 0;  ///< number of points
  std::string word{};    ///< "zip", "random", "cells"; empty: an axis of the grid
  /// The value of a key in a point: that of an option, or a TOML text; none if the point does not give the key. Empty
  /// while only the points are counted.
  std::function<OptionValue(std::size_t point, std::size_t key)> value{};
  /// The same value without a text made, or a check that the option can have it. Texts live as long as this function or
  /// a copy of it.
  std::function<Glance(std::size_t point, std::size_t key)> look{};
  /// The place of that value in a file, if it has one of its own.
  std::function<std::string(std::size_t point, std::size_t key)> place{};
};

/// All dimensions of the study: the scenarios first, then those with keys of the scenario, then the others in the order
/// of the run options. Throws InputError. `counted`: axes of numbers are counted and not made; the count is exact, but
/// for numbers given twice.
std::vector<Dimension> dimensions(const StudyAxes& study, bool counted);

}  // namespace polhode::study::plan
