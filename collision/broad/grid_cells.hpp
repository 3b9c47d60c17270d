// SPDX-License-Identifier: BSD-3-Clause
// The cells of a hierarchical grid that some boxes overlap, each once, for drawing.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "collision/broad/cell_block.hpp"
#include "collision/shape.hpp"

namespace polhode::inline collision::inline broad {

class GridCells {
 public:
  /// Adds the cells of a box that overlaps at most two cells along each axis.
  void add(std::size_t level, const cells::Reach& reach) {
    for (int corner = 0; corner < 8; ++corner) {
      Cell cell{static_cast<std::int64_t>(level)};
      for (std::size_t k = 0; k < 3; ++k)
        cell[k + 1] = (corner >> k & 1 ? reach.high[k] : reach.low[k]) >> cells::cell_bits;
      reached_.push_back(cell);
    }
  }

  /// Appends all cells as boxes; `edge_of(level)` is the edge length (m) of a cell.
  template <class EdgeOf>
  void append_to(std::vector<Bounds>& all, const EdgeOf& edge_of) {
    std::sort(reached_.begin(), reached_.end());
    reached_.erase(std::unique(reached_.begin(), reached_.end()), reached_.end());
    for (const Cell& cell : reached_) {
      const double edge = edge_of(static_cast<std::size_t>(cell[0]));
      const Vector3<double> numbers{double(cell[1]), double(cell[2]), double(cell[3])};
      all.emplace_back(edge * numbers, edge * (numbers + Vector3<double>::Ones()));
    }
  }

 private:
  using Cell = std::array<std::int64_t, 4>;  // level, then the numbers along the axes
  std::vector<Cell> reached_;
};

}  // namespace polhode::collision::broad
