// SPDX-License-Identifier: BSD-3-Clause
// The size of the cells of a grid, from the sizes of the boxes in it.
#pragma once

#include <vector>

#include "collision/broad/fat_boxes.hpp"

namespace polhode::inline collision::inline broad {

/// Half the edge of a cell: a little more than the largest common box. A box is common up to twice the median size.
class CellSize {
 public:
  /// False if the size stays, as it does while it is about right for the boxes and the largest common one fits.
  bool choose(const FatBoxes& boxes);
  /// The next choose() ignores the present size.
  void forget() { half_cell_ = -1; }

  double half_cell() const { return half_cell_; }  ///< m

 private:
  double median_size(const FatBoxes& boxes);

  double half_cell_ = -1;
  std::vector<double> sample_;
};

}  // namespace polhode::collision::broad
