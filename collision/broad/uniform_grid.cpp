// SPDX-License-Identifier: BSD-3-Clause
// A uniform grid without bounds, with coarser ones above it for boxes that are too large: the hierarchical hash grid of
// Ericson, "Real-Time Collision Detection" (2005), section 7.2, after Mirtich, "Impulse-based Dynamic Simulation" (1996),
// section 3.4. Half a cell is as large as common boxes are; the cells of each further level are four times as wide.
//
// The grid holds fat boxes, and only a body that left its own is looked up again; pairs of fat boxes are kept. A box stands
// in the cell of its lower corner, on the first level on which it reaches no further than the next half cell. What
// overlaps a box stands in two cells along each axis at most; this needs no more than that rounding keeps the order of
// numbers. The boxes of a cell stand side by side in blocks of eight, so that all are compared at once.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/fat_boxes.hpp"
#include "collision/broad/kept_pairs.hpp"
#include "collision/broad/rounded_box.hpp"
#include "collision/broad_phase.hpp"

namespace polhode {
namespace {

using broad::Box;
using broad::FatBoxes;
using broad::RoundedBox;

using Index = std::uint32_t;
constexpr Index none = ~Index(0), on_no_level = none - 1;
constexpr Index no_block = 0;  // stands for all that are not there, and stays empty
constexpr std::size_t most_levels = 16;
constexpr double coarser = 4;               // cells of the next level
constexpr double common = 2;                // times the median size: still a common box
constexpr double half_cell_of_size = 1.02;  // half the edge of a cell over the largest common size
constexpr std::size_t slots_per_body = 2;
constexpr std::size_t ahead = 2;  // bodies, when memory is asked for their blocks
constexpr std::uint32_t steps_between_looks = 64;  // at the sizes of boxes

/// The half cells that a box reaches.
struct Reach {
  std::array<std::int64_t, 3> low, high;
};

/// A cell's level and its numbers along the axes, of which 20 bits count: cells of one key are far apart.
using Key = std::uint64_t;
constexpr int key_bits = 20;
constexpr std::int64_t key_mask = (1 << key_bits) - 1;
Key key_part(std::int64_t number, std::size_t axis) {
  return static_cast<Key>(number & key_mask) << (key_bits * static_cast<int>(axis));
}
Key key_part(std::size_t level) { return Key(level) << (3 * key_bits); }

/// Up to eight fat boxes of one cell; a cell that holds more has several blocks.
struct alignas(64) Block {
  static constexpr std::size_t lanes = 8;
  static constexpr unsigned full = (1u << lanes) - 1;
  static constexpr float nowhere = std::numeric_limits<float>::infinity();
  using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;
  using Hits [[gnu::vector_size(lanes * sizeof(float))]] = std::int32_t;

  Lanes low[3], high[3];
  std::array<Index, lanes> body;
  Key key;
  Index hash;
  Index next;     // of those with the same hash
  unsigned used;  // bit k: lane k

  std::size_t level() const { return static_cast<std::size_t>(key >> (3 * key_bits)); }

  void set(std::size_t lane, const RoundedBox& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k][lane] = b.low[k];
      high[k][lane] = b.high[k];
    }
  }
  /// An empty lane overlaps nothing.
  void hide(std::size_t lane) { low[0][lane] = nowhere; }

  /// Sets a bit in those lanes that overlap the box.
  void overlapping(const RoundedBox& b, unsigned bit, Hits& hits) const {
    const Hits hit = (low[0] <= b.high[0]) & (high[0] >= b.low[0]) & (low[1] <= b.high[1]) & (high[1] >= b.low[1]) &
                     (low[2] <= b.high[2]) & (high[2] >= b.low[2]);
    hits |= hit & (Hits{1, 1, 1, 1, 1, 1, 1, 1} << static_cast<int>(bit));
  }
};

class UniformGrid final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    if (fat_.update(bounds)) {
      begin_scene();
    } else if (++steps_ % steps_between_looks == 0 && choose_cells()) {
      clear();
      for (Index body = 0; body < fat_.size(); ++body) place(body, home_of(fat_.fat(body)));
    }
    const auto left = fat_.left();
    const std::size_t count = left.size();
    homes_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      homes_[k] = home_of(fat_.fat(left[k]));
      fetch_slots(homes_[k]);
      broad::fetch(place_[left[k]]);
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (k + ahead < count && place_[left[k + ahead]] < on_no_level) broad::fetch(blocks_[place_[left[k + ahead]] / Block::lanes]);
      place(left[k], homes_[k]);
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (k + ahead < count) fetch_blocks(homes_[k + ahead]);
      search(left[k], homes_[k]);
    }
    pairs_ = kept_.renew(fat_, bounds);
  }

  std::span<const BodyPair> pairs() override { return pairs_; }

 private:
  void begin_scene() {
    median_ = -1;
    steps_ = 0;
    choose_cells();
    std::size_t slots = 64;
    while (slots < slots_per_body * fat_.size()) slots *= 2;
    slots_.resize(slots);
    // Far from all fractions with small denominators (Roberts' R2 sequence, after the plastic number).
    step_y_ = static_cast<Index>(0.7548776662466927 * double(slots)) | 1u;
    step_z_ = static_cast<Index>(0.5698402909980532 * double(slots)) | 1u;
    blocks_.reserve(fat_.size() + 1);  // each but the first holds a body
    large_.reserve(fat_.size());
    homes_.reserve(fat_.size());
    clear();
    kept_.forget();
  }

  void clear() {
    std::fill(slots_.begin(), slots_.end(), no_block);
    blocks_.clear();
    free_block_ = no_block;
    blocks_[new_block()].key = ~Key(0);
    place_.assign(fat_.size(), none);
    large_.clear();
    bodies_.fill(0);
    levels_ = 0;
  }

  /// So that most bodies are on the first level. False where cells stay, as they do while sizes are more or less the same.
  bool choose_cells() {
    constexpr std::size_t most_samples = 512;
    sample_.clear();
    sample_.reserve(most_samples + 1);
    const std::size_t stride = fat_.size() / most_samples + 1;
    for (std::size_t i = 0; i < fat_.size(); i += stride) {
      const Box& b = fat_.fat(static_cast<Index>(i));
      if (!FatBoxes::too_large(b)) sample_.push_back(size_of(b));
    }
    if (sample_.empty()) return false;
    std::sort(sample_.begin(), sample_.end());
    const double median = sample_[sample_.size() / 2];
    if (median >= 0.8 * median_ && median <= 1.25 * median_) return false;
    median_ = median;
    const double largest = *(std::upper_bound(sample_.begin(), sample_.end(), common * median) - 1);
    double edge = half_cell_of_size * largest;
    if (!(edge >= smallest_edge)) edge = edge_for_points();
    for (double& per_metre : per_metre_) {
      per_metre = 1 / edge;
      edge *= coarser;
    }
    return true;
  }

  /// Boxes without any size: cells by how far apart they are.
  double edge_for_points() const {
    double reach = 0;
    for (Index i = 0; i < fat_.size(); ++i) {
      if (FatBoxes::too_large(fat_.fat(i))) continue;
      for (const double x : fat_.fat(i).low) reach = std::max(reach, std::abs(x));
    }
    return std::max(reach / std::cbrt(double(fat_.size())), smallest_edge);
  }

  /// Beyond so many cells, where numbers are further apart than these, all is one cell.
  static std::int64_t half_cell(double x, double per_metre) {
    constexpr double most = 0x1p51;
    return static_cast<std::int64_t>(std::floor(std::clamp(x * per_metre, -most, most)));
  }

  Reach reach(const Box& b, std::size_t level) const {
    const double per_metre = per_metre_[level];
    Reach r;
    for (std::size_t k = 0; k < 3; ++k) {
      r.low[k] = half_cell(b.low[k], per_metre);
      r.high[k] = half_cell(b.high[k], per_metre);
    }
    return r;
  }

  /// Where a box stands; `level` is most_levels where it is too large for all.
  struct Home {
    std::size_t level;
    Reach reach;
  };

  Home home_of(const Box& box) const {
    Home home{most_levels, {}};
    if (FatBoxes::too_large(box)) return home;
    for (home.level = 0; home.level < most_levels; ++home.level) {
      home.reach = reach(box, home.level);
      const Reach& r = home.reach;
      if (broad::all(r.high[0] - r.low[0] <= 1, r.high[1] - r.low[1] <= 1, r.high[2] - r.low[2] <= 1)) break;
    }
    return home;
  }

  Index hash(std::int64_t x, std::int64_t y, std::int64_t z) const { return Index(x) + step_y_ * Index(y) + step_z_ * Index(z); }
  Index& slot(Index hash) { return slots_[hash & (slots_.size() - 1)]; }

  /// From one on, the first block of a cell.
  Index block_of(Index b, Key key) const {
    while (b != no_block && blocks_[b].key != key) b = blocks_[b].next;
    return b;
  }

  void place(Index body, const Home& home) {
    const Index old = place_[body];
    if (home.level == most_levels) {
      if (old == on_no_level) return;
      if (old != none) take_out(body);
      place_[body] = on_no_level;
      large_.push_back(body);
      return;
    }
    const RoundedBox box(fat_.fat(body));
    const std::int64_t x = home.reach.low[0] >> 1, y = home.reach.low[1] >> 1, z = home.reach.low[2] >> 1;
    const Key key = key_part(home.level) | key_part(x, 0) | key_part(y, 1) | key_part(z, 2);
    if (old == on_no_level) {
      std::erase(large_, body);
    } else if (old != none) {
      Block& block = blocks_[old / Block::lanes];
      if (block.key == key) return block.set(old % Block::lanes, box);
      take_out(body);
    }
    Index& head = slot(hash(x, y, z));
    Index b = block_of(head, key);
    while (b != no_block && blocks_[b].used == Block::full) b = block_of(blocks_[b].next, key);
    if (b == no_block) {
      b = new_block();
      blocks_[b].key = key;
      blocks_[b].hash = hash(x, y, z);
      blocks_[b].next = head;
      head = b;
    }
    Block& block = blocks_[b];
    const auto lane = static_cast<std::size_t>(std::countr_one(block.used));
    block.used |= 1u << lane;
    block.body[lane] = body;
    block.set(lane, box);
    place_[body] = b * Index(Block::lanes) + static_cast<Index>(lane);
    ++bodies_[home.level];
    levels_ = std::max(levels_, home.level + 1);
  }

  void take_out(Index body) {
    const Index b = place_[body] / Index(Block::lanes), lane = place_[body] % Index(Block::lanes);
    place_[body] = none;
    Block& block = blocks_[b];
    --bodies_[block.level()];
    block.used &= ~(1u << lane);
    block.hide(lane);
    if (block.used != 0) return;
    Index* link = &slot(block.hash);
    while (*link != b) link = &blocks_[*link].next;
    *link = block.next;
    block.key = ~Key(0);
    block.next = free_block_;
    free_block_ = b;
  }

  Index new_block() {
    Index b = free_block_;
    if (b == no_block) {
      b = static_cast<Index>(blocks_.size());
      blocks_.emplace_back();
    } else {
      free_block_ = blocks_[b].next;
    }
    Block& block = blocks_[b];
    block.used = 0;
    block.next = no_block;
    for (std::size_t lane = 0; lane < Block::lanes; ++lane) block.hide(lane);
    return b;
  }

  /// The rows of two cells each that are searched first.
  std::array<Index, 4> rows(const Home& home) const {
    const Reach& r = home.reach;
    const Index first = hash((r.low[0] - 1) >> 1, (r.low[1] - 1) >> 1, (r.low[2] - 1) >> 1);
    return {first, first + step_y_, first + step_z_, first + step_y_ + step_z_};
  }
  void fetch_slots(const Home& home) const {
    if (home.level == most_levels) return;
    for (const Index row : rows(home)) broad::fetch(slots_[row & (slots_.size() - 1)]);
  }
  void fetch_blocks(const Home& home) const {
    if (home.level == most_levels) return;
    for (const Index row : rows(home)) {
      broad::fetch(blocks_[slots_[row & (slots_.size() - 1)]]);
      broad::fetch(blocks_[slots_[(row + 1) & (slots_.size() - 1)]]);
    }
  }

  /// The new pairs of a body that left its fat box.
  void search(Index body, const Home& home) {
    const Box& box = fat_.fat(body);
    if (FatBoxes::too_large(box)) return search_all(body);
    for (std::size_t level = 0; level < levels_; ++level) {
      if (bodies_[level] > 0) search_level(body, level, level == home.level ? home.reach : reach(box, level));
    }
    for (const Index other : large_) found(body, other);
  }

  void search_level(Index body, std::size_t level, const Reach& r) {
    const RoundedBox rounded(fat_.fat(body));
    std::array<std::int64_t, 3> low, high, most{};
    double cells = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = (r.low[k] - 1) >> 1;
      high[k] = r.high[k] >> 1;
      most[k] = high[k] - low[k];
      cells *= static_cast<double>(most[k] + 1);
    }
    if (broad::all(most[0] <= 1, most[1] <= 1, most[2] <= 1)) return search_eight(body, rounded, level, low);
    const bool few = *std::max_element(most.begin(), most.end()) < key_mask && cells <= static_cast<double>(blocks_.size());
    if (!few) {
      for (const Block& block : blocks_) {
        if (block.level() == level) search_block(body, rounded, block);
      }
      return;
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        const Key key = key_part(level) | key_part(y, 1) | key_part(z, 2);
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          search_cell(body, rounded, slot(hash(x, y, z)), key | key_part(x, 0));
        }
      }
    }
  }

  void search_cell(Index body, const RoundedBox& rounded, Index first, Key key) {
    for (Index b = block_of(first, key); b != no_block; b = block_of(blocks_[b].next, key)) {
      search_block(body, rounded, blocks_[b]);
    }
  }

  void search_block(Index body, const RoundedBox& rounded, const Block& block) {
    Block::Hits hits{};
    block.overlapping(rounded, 0, hits);
    for (std::size_t lane = 0; lane < Block::lanes; ++lane) {
      if (hits[lane] != 0) found(body, block.body[lane]);
    }
  }

  /// A cell and its upper neighbours: what nearly all questions come to. Without branches until something is hit.
  void search_eight(Index body, const RoundedBox& rounded, std::size_t level, const std::array<std::int64_t, 3>& low) {
    std::array<Index, 8> block;
    std::array<Key, 8> keys;
    Index more = no_block;
    for (std::size_t c = 0; c < 8; ++c) {
      const std::int64_t x = low[0] + std::int64_t(c & 1), y = low[1] + std::int64_t(c >> 1 & 1), z = low[2] + std::int64_t(c >> 2);
      keys[c] = key_part(level) | key_part(x, 0) | key_part(y, 1) | key_part(z, 2);
      block[c] = slot(hash(x, y, z));
    }
    Block::Hits in_lane{};
    for (std::size_t c = 0; c < 8; ++c) {
      block[c] = block_of(block[c], keys[c]);
      const Block& b = blocks_[block[c]];
      b.overlapping(rounded, unsigned(c), in_lane);
      more |= b.next;
    }
    std::uint64_t hits = 0;
    for (std::size_t lane = 0; lane < Block::lanes; ++lane) hits |= std::uint64_t(std::uint32_t(in_lane[lane])) << (8 * lane);
    for (; hits != 0; hits &= hits - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(hits));
      found(body, blocks_[block[bit % 8]].body[bit / 8]);
    }
    if (more == no_block) return;
    for (std::size_t c = 0; c < 8; ++c) search_cell(body, rounded, blocks_[block[c]].next, keys[c]);
  }

  /// Of two that both left their fat boxes, the later one finds the pair.
  void found(Index body, Index other) {
    const bool fresh = other < body || (other > body && !fat_.has_left(other));
    if (fresh && overlap(fat_.fat(body), fat_.fat(other))) kept_.add(body, other);
  }

  /// A body too large for any grid, a half-space above all.
  void search_all(Index body) {
    for (Index other = 0; other < fat_.size(); ++other) found(body, other);
  }

  static constexpr double smallest_edge = 1e-150;

  FatBoxes fat_;
  broad::KeptPairs kept_;
  std::array<double, most_levels> per_metre_{};  // half cells
  std::array<Index, most_levels> bodies_{};      // how many on each level
  std::size_t levels_ = 0;                       // that have ever held one
  std::vector<Index> slots_;                     // the first block of each hash
  Index step_y_ = 1, step_z_ = 1;                // of the hash, from a cell to the next
  std::vector<Block> blocks_;
  Index free_block_ = no_block;                      // a list of those not in use
  std::vector<Home> homes_;                      // of those that left their fat boxes
  std::vector<Index> place_;                     // of each body: its block and lane
  std::vector<Index> large_;                     // on no level
  double median_ = -1;
  std::vector<double> sample_;
  std::uint32_t steps_ = 0;
  std::span<const BodyPair> pairs_;
};

}  // namespace

BroadPhaseEntry uniform_grid() {
  return {"uniform_grid", "fat boxes in cells of their own size, hashed; larger boxes in coarser grids above",
          [] { return std::unique_ptr<BroadPhase>(new UniformGrid); }};
}

}  // namespace polhode
