// SPDX-License-Identifier: BSD-3-Clause
// The boxes of a cell of uniform_grid, or of a leaf of bsp_tree, side by side in a block of two lines of memory: seven
// bits for a side, relative to the cell, so that a word holds one side of eight boxes, and all are compared with a box
// in a few instructions (Lamport, "Multiple Byte Processing with Full-Word Instructions", 1975). Numbers are rounded
// down throughout, which keeps their order: no overlap is missed, and one by less than a unit may be none.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace polhode::inline collision::inline broad::cells {

using Index = std::uint32_t;
inline constexpr Index no_block = 0;  ///< stands for a missing block; stays empty

/// Beginning and end of a box in units of 1/64 of a cell; a half cell has 32.
struct Reach {
  std::array<std::int64_t, 3> low, high;
};
inline constexpr int half_cell_bits = 5, cell_bits = half_cell_bits + 1;

/// Hash key of a cell: its level and its numbers along the axes, 20 bits each. Cells with equal keys are far apart.
using Key = std::uint64_t;
inline constexpr Key no_key = ~Key(0);
inline constexpr int key_bits = 20;
inline constexpr std::int64_t key_mask = (1 << key_bits) - 1;
inline Key key_part(std::int64_t number, std::size_t axis) {
  return static_cast<Key>(number & key_mask) << (key_bits * static_cast<int>(axis));
}
inline Key key_part(std::size_t level) { return Key(level) << (3 * key_bits); }
inline std::size_t level_of(Key key) { return static_cast<std::size_t>(key >> (3 * key_bits)); }

/// Sixteen lanes of one byte each, in two words.
using Word = std::uint64_t;
using Words [[gnu::vector_size(16)]] = Word;
inline constexpr std::size_t lanes = 16, lanes_of_word = 8;
inline constexpr Word in_all_lanes = 0x0101010101010101, top_bits = 0x80 * in_all_lanes;
inline constexpr std::int64_t largest = 127;  // largest number below the top bit

inline Words both(Word word) { return Words{word, word}; }

/// Calls visit(lane) for each lane whose bit is set.
template <class Visit>
void for_lanes(Words bits, const Visit& visit) {
  for (std::size_t half = 0; half < 2; ++half) {
    for (Word word = bits[half]; word != 0; word &= word - 1) {
      visit(lanes_of_word * half + static_cast<std::size_t>(std::countr_zero(word)) / 8);
    }
  }
}

/// Limits for the sides of a box that overlaps the queried box, one byte for each lane, with the top bits set. Sides
/// beyond the reach of the cell are clamped.
struct Limits {
  Limits() = default;
  Limits(std::int64_t low, std::int64_t high)
      : begins(words(std::clamp<std::int64_t>(high, 0, largest - 1))),
        ends(words(largest - std::clamp<std::int64_t>(low, 0, largest))) {}
  Limits(std::int64_t low, std::int64_t high, std::int64_t cell)
      : Limits(low - (cell << cell_bits), high - (cell << cell_bits)) {}
  static Words words(std::int64_t side) { return both(static_cast<Word>(side) * in_all_lanes | top_bits); }
  Words begins{}, ends{};
};

/// The sides of up to sixteen boxes, relative to the beginning of their cell.
struct Sides {
  std::array<Words, 3> begins, ends;  // sides by lane; an end is stored as its distance from the largest number

  void set(std::size_t lane, const Reach& in_cell) {
    for (std::size_t k = 0; k < 3; ++k) {
      set(begins[k], lane, in_cell.low[k]);
      set(ends[k], lane, largest - in_cell.high[k]);
    }
  }
  /// Copies the box in lane `from` of `other`, which may be this block.
  void set(std::size_t lane, const Sides& other, std::size_t from) {
    const std::size_t half = from / lanes_of_word, at = 8 * (from % lanes_of_word);
    for (std::size_t k = 0; k < 3; ++k) {
      set(begins[k], lane, static_cast<std::int64_t>(other.begins[k][half] >> at & 0xFF));
      set(ends[k], lane, static_cast<std::int64_t>(other.ends[k][half] >> at & 0xFF));
    }
  }
  /// Marks a lane as empty: its box begins beyond the cell and after every query.
  void hide(std::size_t lane) { set(begins[0], lane, largest); }
  void hide_all() {
    begins.fill(both(largest * in_all_lanes));
    ends.fill(Words{});
  }
  bool full() const { return (free(0) | free(1)) == 0; }
  bool empty() const { return (free(0) & free(1)) == empty_bits; }
  std::size_t free_lane() const {
    const std::size_t half = free(0) == 0;
    return lanes_of_word * half + static_cast<std::size_t>(std::countr_zero(free(half))) / 8;
  }

  /// The top bits of the lanes whose box overlaps the queried one: a subtraction that borrows nothing from the top bit
  /// means that the side is within its limit.
  Words overlapping(const Limits& x, const Limits& y, const Limits& z) const {
    return (x.begins - begins[0]) & (x.ends - ends[0]) & (y.begins - begins[1]) & (y.ends - ends[1]) &
           (z.begins - begins[2]) & (z.ends - ends[2]) & both(top_bits);
  }

 private:
  static constexpr Word empty_bits = in_all_lanes << cell_bits;
  Word free(std::size_t half) const { return begins[0][half] & empty_bits; }
  static void set(Words& side, std::size_t lane, std::int64_t to) {
    const std::size_t half = lane / lanes_of_word, at = 8 * (lane % lanes_of_word);
    side[half] = (side[half] & ~(Word(0xFF) << at)) | static_cast<Word>(to) << at;
  }
};

/// Up to sixteen fat boxes of one cell; a cell that holds more has several blocks.
struct alignas(64) Block : Sides {
  Key key;
  Index next;  // next cell with the same hash; set in the first block of a cell
  Index more;  // next block of this cell

  std::size_t level() const { return level_of(key); }

  void set(std::size_t lane, Reach r) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t from = r.low[k] >> cell_bits << cell_bits;
      r.low[k] -= from;
      r.high[k] -= from;
    }
    Sides::set(lane, r);
  }
};
static_assert(sizeof(Block) == 128);

}  // namespace polhode::collision::broad::cells
