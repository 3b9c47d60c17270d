// SPDX-License-Identifier: BSD-3-Clause
// A uniform grid without bounds, with coarser ones above it for boxes that are too large: the hierarchical hash grid of
// Ericson, "Real-Time Collision Detection" (2005), section 7.2, after Mirtich, "Impulse-based Dynamic Simulation"
// (1996), section 3.4. Half a cell is as large as common boxes are (broad/cell_size.hpp); the cells of each further
// level are four times as wide.
//
// The grid holds fat boxes, and only a body that left its own is placed again; pairs of fat boxes are kept. A box
// stands in the cell of its lower corner, on the first level on which it reaches no further than the next half cell.
// Boxes that overlap a box stand in two cells along each axis at most; this needs no more than that rounding keeps the
// order of numbers. The boxes of a cell are tested all at once, seven bits for a side (broad/cell_block.hpp), and what
// is hit is then tested on the boxes themselves.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/cell_block.hpp"
#include "collision/broad/cell_size.hpp"
#include "collision/broad/fat_boxes.hpp"
#include "collision/broad/grid_cells.hpp"
#include "collision/broad/kept_pairs.hpp"
#include "collision/broad_phase.hpp"

namespace polhode::inline collision::inline broad {
namespace {

using namespace broad::cells;
using broad::FatBoxes;
using broad::PlainBox;

constexpr Index none = ~Index(0), on_no_level = none - 1;
constexpr std::size_t most_levels = 16;
constexpr double coarser = 4;  // cells of the next level
constexpr std::size_t slots_per_body = 1;
constexpr std::size_t boxes_ahead = 8, blocks_ahead = 6;  // bodies by which memory is fetched ahead
constexpr std::uint32_t steps_between_looks = 32;         // steps from one check of the sizes of boxes to the next

class UniformGrid final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    if (fat_.update(bounds)) {
      begin_scene();
    } else if (++steps_ % steps_between_looks == 0 && choose_cells()) {
      clear();
      place_all(fat_.size(), [](std::size_t k) { return static_cast<Index>(k); });
    }
    const auto left = fat_.left();
    place_all(left.size(), [&](std::size_t k) { return left[k]; });
    for (std::size_t k = 0; k < movers_.size(); ++k) {
      if (k + blocks_ahead < movers_.size()) {
        fetch_blocks(movers_[k + blocks_ahead].home);
        broad::fetch(fat_.fat(movers_[k + blocks_ahead].body));
      }
      search(movers_[k].body, movers_[k].home);
    }
    settle_hits();
    pairs_ = kept_.renew(fat_, bounds);
  }

  std::span<const BodyPair> pairs() override { return pairs_; }

  /// The cells that bodies overlap, on all levels.
  void cells(std::vector<Bounds>& all) const override {
    broad::GridCells reached;
    for (Index body = 0; body < fat_.size(); ++body) {
      const Home home = home_of(fat_.fat(body));
      if (home.key != no_key) reached.add(level_of(home.key), home.reach);
    }
    reached.append_to(all, [this](std::size_t level) { return (1 << cell_bits) / per_metre_[level]; });
  }

 private:
  void begin_scene() {
    cell_size_.forget();
    steps_ = 0;
    choose_cells();
    int bits = 6;
    while (std::size_t(1) << bits < slots_per_body * fat_.size()) ++bits;
    slots_.resize(std::size_t(1) << bits);
    // No two cells share a slot in a cube of about as many cells as there are slots; the odd steps fill all slots from
    // any row of cells.
    step_y_ = (Index(1) << (bits + 2) / 3) + 1;
    step_z_ = (Index(1) << (2 * bits + 2) / 3) + 1;
    blocks_.reserve(fat_.size() + 1);  // each but the first holds a body
    bodies_in_.reserve(lanes * blocks_.capacity());
    large_.reserve(fat_.size());
    homes_.reserve(fat_.size());
    movers_.reserve(fat_.size());
    starts_.reserve(slots_.size() + 1);
    clear();
    kept_.forget();
  }

  void clear() {
    std::fill(slots_.begin(), slots_.end(), no_block);
    blocks_.clear();
    bodies_in_.clear();
    free_block_ = no_block;
    new_block(no_key);
    place_.assign(fat_.size(), none);
    large_.clear();
    bodies_.fill(0);
    levels_ = 0;
  }

  /// False if the cells keep their size.
  bool choose_cells() {
    if (!cell_size_.choose(fat_)) return false;
    double edge = cell_size_.half_cell();
    for (double& per_metre : per_metre_) {
      per_metre = (1 << half_cell_bits) / edge;
      edge *= coarser;
    }
    return true;
  }

  /// Beyond so many units, where numbers are further apart than cells, all is one cell.
  static std::int64_t units(double x, double per_metre) {
    constexpr double most = 0x1p56;
    return static_cast<std::int64_t>(std::floor(std::clamp(x * per_metre, -most, most)));
  }

  Reach reach(const PlainBox& b, std::size_t level) const {
    const double per_metre = per_metre_[level];
    Reach r;
    for (std::size_t k = 0; k < 3; ++k) {
      r.low[k] = units(b.low[k], per_metre);
      r.high[k] = units(b.high[k], per_metre);
    }
    return r;
  }

  /// The cell in which a box stands; no_key where it is too large for all levels.
  struct Home {
    Key key = no_key;
    Reach reach{};
  };

  Home home_of(const PlainBox& box) const {
    Home home;
    if (FatBoxes::too_large(box)) return home;
    for (std::size_t level = 0; level < most_levels; ++level) {
      home.reach = reach(box, level);
      const auto fits = [&r = home.reach](std::size_t k) {
        return (r.high[k] >> half_cell_bits) - (r.low[k] >> half_cell_bits) <= 1;
      };
      if (!broad::all(fits(0), fits(1), fits(2))) continue;
      home.key = key_part(level);
      for (std::size_t k = 0; k < 3; ++k) home.key |= key_part(home.reach.low[k] >> cell_bits, k);
      break;
    }
    return home;
  }

  /// Places bodies, and leaves them in movers_ in the order of their cells' slots: of those that are looked up one
  /// after the other many need the same blocks, and blocks that are new together stand in this order in memory.
  template <class BodyAt>
  void place_all(std::size_t count, const BodyAt& body_at) {
    const auto fewer = std::bit_floor(std::clamp<std::size_t>(count, 1, slots_.size()));
    const int shift = std::countr_zero(slots_.size()) - std::countr_zero(fewer);
    const auto start = [&](const Home& home) { return (hash(home.key) & (slots_.size() - 1)) >> shift; };
    homes_.resize(count);
    starts_.assign(fewer + 1, 0);
    for (std::size_t k = 0; k < count; ++k) {
      if (k + boxes_ahead < count) broad::fetch(fat_.fat(body_at(k + boxes_ahead)));
      homes_[k] = home_of(fat_.fat(body_at(k)));
      ++starts_[start(homes_[k]) + 1];
      fetch_slots(homes_[k]);
      broad::fetch(place_[body_at(k)]);
    }
    for (std::size_t k = 0; k < fewer; ++k) starts_[k + 1] += starts_[k];
    movers_.resize(count);
    for (std::size_t k = 0; k < count; ++k) movers_[starts_[start(homes_[k])]++] = {body_at(k), homes_[k]};
    for (std::size_t k = 0; k < count; ++k) {
      if (k + blocks_ahead < count) {
        const Index soon = place_[movers_[k + blocks_ahead].body];
        if (soon < on_no_level) broad::fetch(blocks_[soon / lanes]);
      }
      place(movers_[k].body, movers_[k].home);
    }
  }

  Index hash(Key key) const {
    const auto part = [&](int axis) { return static_cast<Index>(key >> (axis * key_bits)) & Index(key_mask); };
    return part(0) + step_y_ * part(1) + step_z_ * part(2);
  }
  Index& slot(Key key) { return slots_[hash(key) & (slots_.size() - 1)]; }

  /// The first block of a cell, from one of its chain on.
  Index cell_in(Index b, Key key) const {
    while (b != no_block && blocks_[b].key != key) b = blocks_[b].next;
    return b;
  }

  void place(Index body, const Home& home) {
    const Index old = place_[body];
    if (home.key == no_key) {
      if (old == on_no_level) return;
      if (old != none) take_out(body);
      place_[body] = on_no_level;
      large_.push_back(body);
      return;
    }
    const Key key = home.key;
    if (old == on_no_level) {
      std::erase(large_, body);
    } else if (old != none) {
      Block& block = blocks_[old / lanes];
      if (block.key == key) return block.set(old % lanes, home.reach);
      take_out(body);
    }
    Index& chain = slot(key);
    const Index head = cell_in(chain, key);
    Index b = head;
    while (b != no_block && blocks_[b].full()) b = blocks_[b].more;
    if (b == no_block) {
      b = new_block(key);
      if (head == no_block) {
        blocks_[b].next = chain;
        chain = b;
      } else {
        blocks_[b].more = blocks_[head].more;
        blocks_[head].more = b;
      }
    }
    Block& block = blocks_[b];
    const std::size_t lane = block.free_lane();
    block.set(lane, home.reach);
    place_[body] = b * Index(lanes) + static_cast<Index>(lane);
    bodies_in_[place_[body]] = body;
    ++bodies_[block.level()];
    levels_ = std::max(levels_, block.level() + 1);
  }

  void take_out(Index body) {
    const Index b = place_[body] / Index(lanes), lane = place_[body] % Index(lanes);
    place_[body] = none;
    Block& block = blocks_[b];
    --bodies_[block.level()];
    block.hide(lane);
    if (!block.empty()) return;
    Index* link = &slot(block.key);
    while (blocks_[*link].key != block.key) link = &blocks_[*link].next;
    if (*link != b) {
      link = &blocks_[*link].more;
      while (*link != b) link = &blocks_[*link].more;
      *link = block.more;
    } else if (block.more != no_block) {
      blocks_[block.more].next = block.next;
      *link = block.more;
    } else {
      *link = block.next;
    }
    block.key = no_key;
    block.next = free_block_;
    free_block_ = b;
  }

  Index new_block(Key key) {
    Index b = free_block_;
    if (b == no_block) {
      b = static_cast<Index>(blocks_.size());
      blocks_.emplace_back();
      bodies_in_.resize(lanes * blocks_.size());
    } else {
      free_block_ = blocks_[b].next;
    }
    Block& block = blocks_[b];
    block.key = key;
    block.next = block.more = no_block;
    block.hide_all();
    return b;
  }

  /// The lowest of the cells that may hold what overlaps a box.
  static std::int64_t first_cell(std::int64_t low) { return ((low >> half_cell_bits) - 1) >> 1; }

  /// The rows of two cells each that are searched first.
  std::array<Index, 4> rows(const Home& home) const {
    Key key = 0;
    for (std::size_t k = 0; k < 3; ++k) key |= key_part(first_cell(home.reach.low[k]), k);
    const Index first = hash(key);
    return {first, first + step_y_, first + step_z_, first + step_y_ + step_z_};
  }
  void fetch_slots(const Home& home) const {
    if (home.key == no_key) return;
    for (const Index row : rows(home)) broad::fetch(slots_[row & (slots_.size() - 1)]);
  }
  void fetch_blocks(const Home& home) const {
    if (home.key == no_key) return;
    for (const Index row : rows(home)) {
      broad::fetch(blocks_[slots_[row & (slots_.size() - 1)]]);
      broad::fetch(blocks_[slots_[(row + 1) & (slots_.size() - 1)]]);
    }
  }

  /// The new pairs of a body that left its fat box.
  void search(Index body, const Home& home) {
    if (home.key == no_key) return search_all(body);
    for (std::size_t level = 0; level < levels_; ++level) {
      if (bodies_[level] == 0) continue;
      search_level(body, level, level == level_of(home.key) ? home.reach : reach(fat_.fat(body), level));
    }
    for (const Index other : large_) found(body, other);
  }

  void search_level(Index body, std::size_t level, const Reach& r) {
    std::array<std::int64_t, 3> low, high, most{};
    double cells = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = first_cell(r.low[k]);
      high[k] = r.high[k] >> cell_bits;
      most[k] = high[k] - low[k];
      cells *= static_cast<double>(most[k] + 1);
    }
    if (broad::all(most[0] <= 1, most[1] <= 1, most[2] <= 1)) return search_eight(body, r, level, low);
    const bool few =
        *std::max_element(most.begin(), most.end()) < key_mask && cells <= static_cast<double>(blocks_.size());
    if (!few) {
      for (Index other = 0; other < fat_.size(); ++other) {
        if (place_[other] < on_no_level && blocks_[place_[other] / lanes].level() == level) found(body, other);
      }
      return;
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      const Limits in_z(r.low[2], r.high[2], z);
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        const Limits in_y(r.low[1], r.high[1], y);
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          const Limits in_x(r.low[0], r.high[0], x);
          const Key key = key_part(level) | key_part(x, 0) | key_part(y, 1) | key_part(z, 2);
          for (Index b = cell_in(slot(key), key); b != no_block; b = blocks_[b].more) {
            hit_lanes(body, b, blocks_[b].overlapping(in_x, in_y, in_z));
          }
        }
      }
    }
  }

  void hit_lanes(Index body, Index b, Words in_lanes) {
    for_lanes(in_lanes, [&](std::size_t lane) { hit(body, b * Index(lanes) + static_cast<Index>(lane)); });
  }

  /// A cell and its upper neighbours: what nearly all questions come to. Without branches until something is hit.
  void search_eight(Index body, const Reach& r, std::size_t level, const std::array<std::int64_t, 3>& low) {
    std::array<std::array<Limits, 2>, 3> limits;
    std::array<std::array<Key, 2>, 3> part;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t side = 0; side < 2; ++side) {
        const std::int64_t cell = low[k] + static_cast<std::int64_t>(side);
        limits[k][side] = Limits(r.low[k], r.high[k], cell);
        part[k][side] = key_part(cell, k);
      }
    }
    std::array<Index, 8> block;
    std::array<Key, 8> keys;
    for (std::size_t c = 0; c < 8; ++c) {
      keys[c] = key_part(level) | part[0][c & 1] | part[1][c >> 1 & 1] | part[2][c >> 2];
      block[c] = slot(keys[c]);
    }
    Words hits{};
    unsigned rest = 0;  // bit c: the cell is not the first in its chain, or has another block
    for (std::size_t c = 0; c < 8; ++c) {
      const Block& b = blocks_[block[c]];
      const Word here = Word(0) - Word(b.key == keys[c]);  // all bits or none, instead of a branch
      const Words in_lanes = b.overlapping(limits[0][c & 1], limits[1][c >> 1 & 1], limits[2][c >> 2]);
      hits |= (in_lanes & both(here)) >> static_cast<int>(7 - c);
      const Index onward = (b.more & static_cast<Index>(here)) | (b.next & ~static_cast<Index>(here));
      rest |= unsigned(onward != no_block) << c;
    }
    for (std::size_t half = 0; half < 2; ++half) {
      for (Word word = hits[half]; word != 0; word &= word - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(word));
        hit(body, block[bit % 8] * Index(lanes) + static_cast<Index>(lanes_of_word * half + bit / 8));
      }
    }
    for (; rest != 0; rest &= rest - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(rest));
      const Block& first = blocks_[block[c]];
      for (Index b = first.key == keys[c] ? first.more : cell_in(first.next, keys[c]); b != no_block;
           b = blocks_[b].more) {
        hit_lanes(body, b, blocks_[b].overlapping(limits[0][c & 1], limits[1][c >> 1 & 1], limits[2][c >> 2]));
      }
    }
  }

  /// Stores a candidate pair. Candidates are tested later, many together, so that memory latencies overlap.
  void hit(Index body, Index place) {
    broad::fetch(bodies_in_[place]);
    hits_[hit_count_++] = {body, place};
    if (hit_count_ == hits_.size()) settle_hits();
  }

  void settle_hits() {
    std::size_t fresh = 0;
    for (std::size_t k = 0; k < hit_count_; ++k) {
      const Index body = hits_[k].body, other = bodies_in_[hits_[k].other];
      broad::fetch(fat_.fat(other));
      hits_[fresh] = {body, other};
      fresh += is_fresh(body, other);
    }
    for (std::size_t k = 0; k < fresh; ++k) {
      if (overlap(fat_.fat(hits_[k].body), fat_.fat(hits_[k].other))) kept_.add(hits_[k].body, hits_[k].other);
    }
    hit_count_ = 0;
  }

  /// True if the pair is reported for this body. If both left their fat boxes, it is reported for the later one only.
  bool is_fresh(Index body, Index other) const {
    return (int(other < body) | (int(other > body) & int(!fat_.has_left(other)))) != 0;
  }
  void found(Index body, Index other) {
    if (is_fresh(body, other) && overlap(fat_.fat(body), fat_.fat(other))) kept_.add(body, other);
  }

  /// A body too large for any grid, a half-space above all.
  void search_all(Index body) {
    for (Index other = 0; other < fat_.size(); ++other) found(body, other);
  }

  FatBoxes fat_;
  broad::KeptPairs kept_;
  broad::CellSize cell_size_;                    // size of the cells of the first level
  std::array<double, most_levels> per_metre_{};  // units
  std::array<Index, most_levels> bodies_{};      // number of bodies on each level
  struct Hit {
    Index body, other;  // number of the body, or its place
  };
  std::array<Hit, 1024> hits_;
  std::size_t hit_count_ = 0;
  std::size_t levels_ = 0;         // number of levels that have ever held a body
  std::vector<Index> slots_;       // the first block of each hash
  Index step_y_ = 1, step_z_ = 1;  // steps of the hash from a cell to the next
  std::vector<Block> blocks_;
  std::vector<Index> bodies_in_;  // the lanes of the blocks
  Index free_block_ = no_block;   // a list of those not in use
  struct Mover {
    Index body;
    Home home;
  };
  std::vector<Home> homes_;    // cells of the bodies that are being placed
  std::vector<Mover> movers_;  // the same in the order of their cells' slots
  std::vector<Index> starts_;  // beginnings of the groups of slots in movers_
  std::vector<Index> place_;   // block and lane of each body
  std::vector<Index> large_;   // bodies on no level
  std::uint32_t steps_ = 0;
  std::span<const BodyPair> pairs_;
};

}  // namespace

BroadPhaseEntry uniform_grid() {
  return {"uniform_grid", "fat boxes in cells of their own size, hashed; larger boxes in coarser grids above",
          [] { return std::unique_ptr<BroadPhase>(new UniformGrid); }};
}

}  // namespace polhode::collision::broad
