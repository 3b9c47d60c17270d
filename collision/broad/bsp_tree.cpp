// SPDX-License-Identifier: BSD-3-Clause
// Binary space partitioning by planes across the axes: Fuchs, Kedem and Naylor, "On Visible Surface Generation by a priori
// Tree Structures" (1980); with planes across the axes it is the k-d tree of Bentley (1975). A box is listed in every leaf
// that its fat box reaches, and only the boxes of one leaf are tested against each other. Of two that overlap, the lower
// corner of what they share lies in one leaf alone, and there the pair is reported.
//
// When a body leaves its fat box, its entries in the leaves are renewed. Leaves in which many gather are split at the median
// centre, where a plane tells enough of them apart; two that have become poor are joined.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/fat_boxes.hpp"
#include "collision/broad/pair_list.hpp"
#include "collision/broad_phase.hpp"

namespace polhode {
namespace {

using broad::Box;

using Index = std::uint32_t;
constexpr Index none = ~Index(0);
constexpr Index capacity = 16;         // entries of a leaf, before a plane is looked for
constexpr Index poor = 8;              // entries of two leaves, to be one again
constexpr double larger_side = 0.8;    // of the entries, at most, for a plane to be worth it
constexpr double both_sides = 1.7;     // entries on both sides together, over those before
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Node {
  double plane = 0;
  std::uint8_t axis = 0;
  Index child = none;     // below the plane; the next one is the rest; none: a leaf
  Index head = none;      // entries of a leaf
  Index count = 0;
  Index limit = capacity; // entries at which a plane is looked for
};

struct Entry {
  Index body = 0, next = none;
};

class BspTree final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    if (fat_.update(bounds)) {
      plant();
    } else {
      const auto left = fat_.left();
      // All out before any is put in: a split looks at the fat boxes of what is listed.
      for (std::size_t k = 0; k < left.size(); ++k) take_out(0, left[k], fat_.before(k));
      for (const Index body : left) put_in(0, body, fat_.fat(body));
    }
    stale_ = true;
  }

  std::span<const BodyPair> pairs() override {
    if (!stale_) return sorted_;
    found_.clear();
    Box all;
    all.low.fill(-infinity);
    all.high.fill(infinity);
    if (!nodes_.empty()) search(0, all);
    broad::leave_room(nodes_, 64 + 4 * fat_.size());
    broad::leave_room(entries_, 64 + 16 * fat_.size());
    broad::leave_room(free_nodes_, 64 + fat_.size());
    broad::leave_room(here_, 256);
    broad::leave_room(bodies_here_, 256);
    broad::leave_room(centres_, 256);
    sorted_ = found_.sorted(fat_.size());
    stale_ = false;
    return sorted_;
  }

 private:
  void plant() {
    nodes_.assign(1, Node{});
    free_nodes_.clear();
    entries_.clear();
    free_entry_ = none;
    for (Index body = 0; body < fat_.size(); ++body) link(0, body);
    split(0);
  }

  static bool reaches_below(const Node& n, const Box& b) { return b.low[n.axis] < n.plane; }
  static bool reaches_above(const Node& n, const Box& b) { return b.high[n.axis] >= n.plane; }

  void link(Index v, Index body) {
    Index e = free_entry_;
    if (e == none) {
      e = static_cast<Index>(entries_.size());
      entries_.emplace_back();
    } else {
      free_entry_ = entries_[e].next;
    }
    entries_[e] = {body, nodes_[v].head};
    nodes_[v].head = e;
    ++nodes_[v].count;
  }

  void release(Index e) {
    entries_[e].next = free_entry_;
    free_entry_ = e;
  }

  void put_in(Index v, Index body, const Box& box) {
    const Node node = nodes_[v];
    if (node.child == none) {
      link(v, body);
      if (nodes_[v].count > node.limit) split(v);
      return;
    }
    if (reaches_below(node, box)) put_in(node.child, body, box);
    if (reaches_above(node, box)) put_in(node.child + 1, body, box);
  }

  void take_out(Index v, Index body, const Box& box) {
    const Node node = nodes_[v];
    if (node.child == none) {
      Index* link = &nodes_[v].head;
      while (entries_[*link].body != body) link = &entries_[*link].next;
      const Index e = *link;
      *link = entries_[e].next;
      release(e);
      --nodes_[v].count;
      return;
    }
    if (reaches_below(node, box)) take_out(node.child, body, box);
    if (reaches_above(node, box)) take_out(node.child + 1, body, box);
    join(v);
  }

  /// Two poor leaves become one.
  void join(Index v) {
    const Index first = nodes_[v].child;
    const Node &a = nodes_[first], &b = nodes_[first + 1];
    if (a.child != none || b.child != none || a.count + b.count > poor) return;
    std::array<Index, poor> bodies{};
    std::size_t count = 0;
    for (const Index c : {first, first + 1}) {
      for (Index e = nodes_[c].head, after; e != none; e = after) {
        after = entries_[e].next;
        bodies[count++] = entries_[e].body;
        release(e);
      }
    }
    free_nodes_.push_back(first);
    nodes_[v].child = none;
    nodes_[v].head = none;
    nodes_[v].count = 0;
    nodes_[v].limit = capacity;
    const auto end = bodies.begin() + static_cast<std::ptrdiff_t>(count);
    std::sort(bodies.begin(), end);
    const auto last = std::unique(bodies.begin(), end);
    for (auto body = bodies.begin(); body != last; ++body) link(v, *body);
  }

  /// Looks for the plane that leaves the least on its larger side, and splits by it if it is worth it.
  void split(Index v) {
    if (nodes_[v].count <= capacity) return;
    const auto count = static_cast<double>(nodes_[v].count);
    double best = larger_side * count;
    bool found = false;
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      Node trial;
      trial.axis = axis;
      trial.plane = median(v, axis);
      if (!std::isfinite(trial.plane)) continue;
      double below = 0, above = 0;
      for (Index e = nodes_[v].head; e != none; e = entries_[e].next) {
        const Box& box = fat_.fat(entries_[e].body);
        below += reaches_below(trial, box);
        above += reaches_above(trial, box);
      }
      if (std::max(below, above) >= best || below + above > both_sides * count) continue;
      best = std::max(below, above);
      nodes_[v].axis = axis;
      nodes_[v].plane = trial.plane;
      found = true;
    }
    if (!found) {
      nodes_[v].limit = 2 * nodes_[v].count;
      return;
    }
    divide(v);
  }

  void divide(Index v) {
    Index first;
    if (free_nodes_.empty()) {
      first = static_cast<Index>(nodes_.size());
      nodes_.resize(nodes_.size() + 2);
    } else {
      first = free_nodes_.back();
      free_nodes_.pop_back();
    }
    nodes_[first] = nodes_[first + 1] = Node{};
    nodes_[v].child = first;
    Index e = nodes_[v].head;
    nodes_[v].head = none;
    nodes_[v].count = 0;
    while (e != none) {
      const Entry entry = entries_[e];
      release(e);
      const Box& box = fat_.fat(entry.body);
      if (reaches_below(nodes_[v], box)) link(first, entry.body);
      if (reaches_above(nodes_[v], box)) link(first + 1, entry.body);
      e = entry.next;
    }
    split(first);
    split(first + 1);
  }

  double median(Index v, std::size_t axis) {
    centres_.clear();
    for (Index e = nodes_[v].head; e != none; e = entries_[e].next) {
      centres_.push_back(centre(fat_.fat(entries_[e].body), axis));
    }
    const auto middle = centres_.begin() + static_cast<std::ptrdiff_t>(centres_.size() / 2);
    std::nth_element(centres_.begin(), middle, centres_.end());
    return *middle;
  }

  /// The pairs whose lower shared corner lies in the cell, which has no upper faces of its own.
  void search(Index v, const Box& cell) {
    const Node node = nodes_[v];
    if (node.child == none) return search_leaf(node, cell);
    Box part = cell;
    part.high[node.axis] = node.plane;
    search(node.child, part);
    part = cell;
    part.low[node.axis] = node.plane;
    search(node.child + 1, part);
  }

  void search_leaf(const Node& node, const Box& cell) {
    here_.clear();
    bodies_here_.clear();
    for (Index e = node.head; e != none; e = entries_[e].next) {
      const Index body = entries_[e].body;
      here_.push_back(fat_.box(body));
      bodies_here_.push_back(body);
    }
    for (std::size_t i = 0; i < here_.size(); ++i) {
      for (std::size_t j = i + 1; j < here_.size(); ++j) {
        if (overlap(here_[i], here_[j]) && shared_corner_within(here_[i], here_[j], cell)) {
          found_.add(bodies_here_[i], bodies_here_[j]);
        }
      }
    }
  }

  static bool shared_corner_within(const Box& a, const Box& b, const Box& cell) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double corner = std::max(a.low[k], b.low[k]);
      if (corner < cell.low[k] || (corner >= cell.high[k] && cell.high[k] < infinity)) return false;
    }
    return true;
  }

  broad::FatBoxes fat_;
  std::vector<Node> nodes_;  // the root first
  std::vector<Entry> entries_;
  std::vector<Index> free_nodes_;  // pairs of children that are not in use
  Index free_entry_ = none;        // a list of entries that are not in use
  std::vector<double> centres_;
  std::vector<Box> here_;          // the boxes of one leaf
  std::vector<Index> bodies_here_;
  broad::PairList found_;
  std::span<const BodyPair> sorted_;
  bool stale_ = false;
};

}  // namespace

BroadPhaseEntry bsp_tree() {
  return {"bsp_tree", "space cut by planes across the axes, boxes listed in every part that they reach",
          [] { return std::unique_ptr<BroadPhase>(new BspTree); }};
}

}  // namespace polhode
