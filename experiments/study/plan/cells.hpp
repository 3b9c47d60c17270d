// SPDX-License-Identifier: BSD-3-Clause
// The cells of a study: the product of its dimensions, in which a key that does not affect a run has one value. A cell
// is made from its number alone; no list of cells is held.
//
// Whether an option affects a run depends on the scenario and on the options that decide (RunOption::decides). For each
// combination of these there is a block of cells, which is a plain product.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/study/plan/dimension.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline plan {

struct Cell {
  std::string_view scenario;  ///< scenario as it is written in the study; valid as long as the Cells
  std::vector<std::pair<const RunOption*, OptionValue>> options;  ///< those that the study gives and that apply
  std::vector<Override> varied;                                   ///< sorted by key
};

class Cells {
 public:
  /// `start` gives the configuration of a run of a scenario before any option is set, and the scenario without
  /// overrides.
  struct Start {
    RunConfig config;
    const Scenario* scenario;
  };
  Cells(std::vector<Dimension> dimensions, const std::function<Start(const std::string& scenario)>& start);

  /// The number of cells; as a double, since it may be larger than any integer.
  double count() const { return count_; }

  /// The tables of points in words.
  std::vector<std::string> tables() const;

  /// The place of a cell: a product, and a point of each dimension.
  struct Place {
    std::size_t block = 0;
    std::vector<std::size_t> points{};  ///< point of each dimension
  };
  /// Finds cell k, below count().
  void find(std::size_t k, Place& place) const;

  /// The cell. Throws InputError for a value that the option cannot have.
  Cell at(const Place& place) const;
  Cell at(std::size_t k) const;

  const std::string& scenario(const Place& place) const { return blocks_[place.block].scenario; }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  /// True if the key of the dimension affects the runs of the cells of that product.
  bool applies(std::size_t block, std::size_t dimension, std::size_t key) const {
    return blocks_[block].applies[dimension][key];
  }
  /// The value that the cell gives to a key of the scenario; its text is empty if the cell gives none.
  Override override_at(const Place& place, std::size_t dimension, std::size_t key) const;

 private:
  using Points = std::vector<std::uint32_t>;
  struct Block {
    std::vector<std::vector<bool>> applies;  ///< true if the key affects a run, by dimension and key
    std::vector<Points> points;              ///< points of each dimension; empty: all points
    std::vector<std::size_t> sizes;          ///< number of points of each dimension
    double first = 0;                        ///< number of its first cell
    std::string scenario;
  };

  std::vector<Dimension> dimensions_;
  std::vector<Block> blocks_;
  double count_ = 0;
};

}  // namespace polhode::study::plan
