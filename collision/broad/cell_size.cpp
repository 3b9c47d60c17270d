// SPDX-License-Identifier: BSD-3-Clause
#include "collision/broad/cell_size.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace polhode::inline collision::inline broad {
namespace {

constexpr double common = 2;                // times the median size: still a common box
constexpr double half_cell_of_size = 1.05;  // half the edge of a cell over the largest common size
constexpr double still_right = 1.3;         // half a cell over what it would be now, or the other way round
constexpr double smallest_edge = 1e-150;    // m

/// Boxes without any size: cells by how far apart they are.
double edge_for_points(const FatBoxes& boxes) {
  double reach = 0;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (FatBoxes::too_large(boxes.fat(i))) continue;
    for (const double x : boxes.fat(i).low) reach = std::max(reach, std::abs(x));
  }
  return std::max(reach / std::cbrt(double(boxes.size())), smallest_edge);
}

}  // namespace

bool CellSize::choose(const FatBoxes& boxes) {
  const double most = common * median_size(boxes);
  double largest_size = -1;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const double size = FatBoxes::too_large(boxes.fat(i)) ? -1 : size_of(boxes.fat(i));
    if (size <= most) largest_size = std::max(largest_size, size);
  }
  if (largest_size < 0) return false;
  double edge = half_cell_of_size * largest_size;
  if (!(edge >= smallest_edge)) edge = edge_for_points(boxes);
  if (largest_size <= half_cell_ && edge <= still_right * half_cell_ && half_cell_ <= still_right * edge) return false;
  half_cell_ = edge;
  return true;
}

/// The median size of a sample of the bodies; negative if there is none.
double CellSize::median_size(const FatBoxes& boxes) {
  constexpr std::size_t most_samples = 512;
  sample_.clear();
  sample_.reserve(most_samples + 1);
  const std::size_t stride = boxes.size() / most_samples + 1;
  for (std::size_t i = 0; i < boxes.size(); i += stride) {
    const PlainBox& b = boxes.fat(static_cast<std::uint32_t>(i));
    if (!FatBoxes::too_large(b)) sample_.push_back(size_of(b));
  }
  if (sample_.empty()) return -1;
  const auto middle = sample_.begin() + static_cast<std::ptrdiff_t>(sample_.size() / 2);
  std::nth_element(sample_.begin(), middle, sample_.end());
  return *middle;
}

}  // namespace polhode::collision::broad
