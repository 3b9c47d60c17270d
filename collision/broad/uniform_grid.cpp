// SPDX-License-Identifier: BSD-3-Clause
// A uniform grid without bounds, with a coarser one above it for boxes that are too large: the hierarchical hash grid of
// Ericson, "Real-Time Collision Detection" (2005), section 7.2, after Mirtich, "Impulse-based Dynamic Simulation" (1996),
// section 3.4. Cells are as large as common boxes are; the cells of each further level are four times as wide.
//
// A box stands in the cell of its lower corner, on the first level on which it reaches no further than the next cell.
// Boxes that overlap then stand in neighbouring cells; this needs no more than that rounding keeps the order of numbers.
// Cells are hashed by a linear function (Teschner et al. 2003 use another one), so that the neighbours of a cell are
// at the same distances in memory wherever it is, and a sweep through the cells reads a few streams.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/pair_list.hpp"
#include "collision/broad/rounded_box.hpp"
#include "collision/broad_phase.hpp"

namespace polhode {
namespace {

using broad::Box;
using broad::RoundedBox;

constexpr std::size_t most_levels = 16;
constexpr double coarser = 4;             // cells of the next level
constexpr double common = 2;              // times the median size: still a common box
constexpr double cell_of_size = 1.25;     // edge of a cell over the largest common size
constexpr double slots_per_body = 2;
constexpr std::uint8_t too_large = most_levels;

constexpr std::int64_t last_cell = std::int64_t(1) << 52;  // on either side; beyond, numbers are further apart than cells

using Cell = std::array<std::int64_t, 3>;

/// One level: cells of an edge, hashed to slots first … first + mask.
struct Level {
  double per_metre = 1;
  std::uint32_t bodies = 0, first = 0, mask = 0, step_y = 0, step_z = 0;

  std::uint32_t slot(const Cell& c) const {
    return (std::uint32_t(c[0]) + step_y * std::uint32_t(c[1]) + step_z * std::uint32_t(c[2])) & mask;
  }
  std::int64_t cell(double x) const {
    constexpr auto most = static_cast<double>(last_cell);
    return static_cast<std::int64_t>(std::floor(std::clamp(x * per_metre, -most, most)));
  }
  Cell cell(const std::array<double, 3>& x) const { return {cell(x[0]), cell(x[1]), cell(x[2])}; }
};

/// Cells up to two apart must have slots of their own.
bool neighbours_are_told_apart(std::uint32_t step_y, std::uint32_t step_z, std::uint32_t mask) {
  for (int z = -2; z <= 2; ++z) {
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) {
        const std::uint32_t slot = std::uint32_t(x) + step_y * std::uint32_t(y) + step_z * std::uint32_t(z);
        if ((x != 0 || y != 0 || z != 0) && (slot & mask) == 0) return false;
      }
    }
  }
  return true;
}

void choose_steps(Level& level) {
  // Far from all fractions with small denominators (Roberts' R2 sequence, after the plastic number).
  const auto part = [&](double of) { return static_cast<std::uint32_t>(of * (double(level.mask) + 1)) | 1u; };
  level.step_y = part(0.7548776662466927);
  level.step_z = part(0.5698402909980532);
  while (!neighbours_are_told_apart(level.step_y, level.step_z, level.mask)) {
    level.step_y = (level.step_y + 2) & level.mask;
    if (level.step_y == 1) level.step_z = (level.step_z + 2) & level.mask;
  }
}

class UniformGrid final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    broad::take(bounds, boxes_);
    choose_cells();
    place();
    sort();
    stale_ = true;
  }

  std::span<const BodyPair> pairs() override {
    if (!stale_) return sorted_;
    found_.clear();
    for (std::size_t l = 0; l < most_levels; ++l) {
      if (levels_[l].bodies > 0) search_level(l);
    }
    search_large();
    sorted_ = found_.sorted(boxes_.size());
    stale_ = false;
    return sorted_;
  }

 private:
  /// Where a body stands.
  struct Place {
    std::uint32_t slot = 0;  // of its level
    std::uint8_t level = 0;
    std::uint8_t reach = 0;  // bit k: into the next cell along axis k
  };
  struct Entry {
    RoundedBox box;
    std::uint32_t body = 0;
    std::uint32_t reach = 0;
  };

  /// So that most bodies are on the first level. Cells stay as they are while sizes do, more or less.
  void choose_cells() {
    constexpr std::size_t most_samples = 512;
    sample_.clear();
    const std::size_t stride = boxes_.size() / most_samples + 1;
    for (std::size_t i = 0; i < boxes_.size(); i += stride) {
      const double size = size_of(boxes_[i]);
      if (size <= largest_size) sample_.push_back(size);
    }
    broad::leave_room(sample_, most_samples + 1);
    if (sample_.empty()) return;
    const auto middle = sample_.begin() + static_cast<std::ptrdiff_t>(sample_.size() / 2);
    std::nth_element(sample_.begin(), middle, sample_.end());
    const double median = *middle;
    if (median >= 0.8 * median_ && median <= 1.25 * median_) return;
    median_ = median;
    double largest = median;
    for (const Box& b : boxes_) {
      const double size = size_of(b);
      if (size > largest && size <= common * median) largest = size;
    }
    double edge = cell_of_size * largest;
    if (!(edge >= smallest_edge)) edge = edge_for_points();
    for (Level& level : levels_) {
      level.per_metre = 1 / edge;
      edge *= coarser;
    }
  }

  /// Boxes without any size: cells by how far apart they are.
  double edge_for_points() const {
    double reach = 0;
    for (const Box& b : boxes_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = std::abs(b.low[k]);
        if (x <= largest_size) reach = std::max(reach, x);
      }
    }
    return std::max(reach / std::cbrt(double(boxes_.size())), smallest_edge);
  }

  void place() {
    places_.resize(boxes_.size());
    for (Level& level : levels_) level.bodies = 0;
    large_.clear();
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      Place& p = places_[i];
      p.level = 0;
      while (p.level < most_levels && !fits(boxes_[i], levels_[p.level], p)) ++p.level;
      if (p.level == too_large) {
        large_.push_back(static_cast<std::uint32_t>(i));
      } else {
        ++levels_[p.level].bodies;
      }
    }
    broad::leave_room(large_);
  }

  /// Whether the box reaches no further than the next cell; then notes along which axes it does.
  static bool fits(const Box& b, const Level& level, Place& p) {
    const Cell low = level.cell(b.low), high = level.cell(b.high);
    const std::int64_t x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    if ((x > 1) | (y > 1) | (z > 1)) return false;
    if (*std::min_element(low.begin(), low.end()) == -last_cell) return false;
    if (*std::max_element(high.begin(), high.end()) == last_cell) return false;
    p.reach = static_cast<std::uint8_t>(x | y << 1 | z << 2);
    return true;
  }

  /// By slots, by counting.
  void sort() {
    std::uint32_t slots = 0;
    for (Level& level : levels_) {
      if (level.bodies == 0) continue;
      std::uint32_t size = 64;
      while (size < slots_per_body * level.bodies) size *= 2;
      if (level.mask + 1 != size || level.step_y == 0) {
        level.mask = size - 1;
        choose_steps(level);
      }
      level.first = slots;
      slots += size;
    }
    if (starts_.capacity() < slots + 1) starts_.reserve(2 * slots + 1024);
    starts_.assign(slots + 1, 0);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      Place& p = places_[i];
      if (p.level == too_large) continue;
      const Level& level = levels_[p.level];
      p.slot = level.first + level.slot(level.cell(boxes_[i].low));
      ++starts_[p.slot + 1];
    }
    for (std::uint32_t s = 0; s < slots; ++s) starts_[s + 1] += starts_[s];
    entries_.resize(boxes_.size());
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const Place& p = places_[i];
      if (p.level == too_large) continue;
      entries_[starts_[p.slot]++] = {RoundedBox(boxes_[i]), static_cast<std::uint32_t>(i), p.reach};
    }
    for (std::uint32_t s = slots; s > 0; --s) starts_[s] = starts_[s - 1];
    if (slots > 0) starts_[0] = 0;
  }

  void search_level(std::size_t l) {
    const Level& level = levels_[l];
    bool more_above = false;
    for (std::size_t k = l + 1; k < most_levels; ++k) more_above |= levels_[k].bodies > 0;
    for (std::uint32_t s = 0; s <= level.mask; ++s) {
      const std::uint32_t begin = starts_[level.first + s], end = starts_[level.first + s + 1];
      for (std::uint32_t i = begin; i < end; ++i) {
        const Entry& e = entries_[i];
        test(e, i + 1, end);
        const std::uint32_t x = e.reach & 1, y = e.reach >> 1 & 1;
        if (x) row(e, level, s + 1, 1);
        if (y) row(e, level, s + level.step_y - 1, x + 2);
        if (e.reach & 4) {
          row(e, level, s + level.step_z - level.step_y - 1, x + 2);
          row(e, level, s + level.step_z - 1, x + 2);
          if (y) row(e, level, s + level.step_z + level.step_y - 1, x + 2);
        }
        if (more_above) search_above(e, l);
      }
    }
  }

  /// The boxes of `count` cells in a row.
  void row(const Entry& e, const Level& level, std::uint32_t slot, std::uint32_t count) {
    slot &= level.mask;
    if (slot + count <= level.mask + 1) {
      test(e, starts_[level.first + slot], starts_[level.first + slot + count]);
      return;
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t s = level.first + ((slot + k) & level.mask);
      test(e, starts_[s], starts_[s + 1]);
    }
  }

  /// The larger boxes that a box may overlap.
  void search_above(const Entry& e, std::size_t l) {
    const Box& box = boxes_[e.body];
    for (std::size_t k = l + 1; k < most_levels; ++k) {
      const Level& level = levels_[k];
      if (level.bodies == 0) continue;
      const Cell low = level.cell(box.low), high = level.cell(box.high);
      for (std::int64_t z = low[2] - 1; z <= high[2]; ++z) {
        for (std::int64_t y = low[1] - 1; y <= high[1]; ++y) {
          row(e, level, level.slot({low[0] - 1, y, z}), static_cast<std::uint32_t>(high[0] - low[0] + 2));
        }
      }
    }
  }

  void test(const Entry& e, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t j = begin; j < end; ++j) {
      const Entry& other = entries_[j];
      if (!may_overlap(e.box, other.box)) continue;
      if (surely_overlap(e.box, other.box) || overlap(boxes_[e.body], boxes_[other.body])) found_.add(e.body, other.body);
    }
  }

  /// Boxes too large for any grid, half-spaces above all: a few, tested against everything.
  void search_large() {
    const auto in_grid = static_cast<std::uint32_t>(boxes_.size() - large_.size());
    for (std::size_t i = 0; i < large_.size(); ++i) {
      const std::uint32_t body = large_[i];
      test({RoundedBox(boxes_[body]), body, 0}, 0, in_grid);
      for (std::size_t j = i + 1; j < large_.size(); ++j) {
        if (overlap(boxes_[body], boxes_[large_[j]])) found_.add(body, large_[j]);
      }
    }
  }

  static constexpr double largest_size = 1e150, smallest_edge = 1e-150;

  std::array<Level, most_levels> levels_;
  double median_ = -1;
  std::vector<double> sample_;
  std::vector<Box> boxes_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> large_;   // on no level
  std::vector<std::uint32_t> starts_;  // of each slot, in entries_
  std::vector<Entry> entries_;         // by slots
  broad::PairList found_;
  std::span<const BodyPair> sorted_;
  bool stale_ = false;
};

}  // namespace

BroadPhaseEntry uniform_grid() {
  return {"uniform_grid", "boxes in cells of their own size, hashed; larger boxes in coarser grids above",
          [] { return std::unique_ptr<BroadPhase>(new UniformGrid); }};
}

}  // namespace polhode
