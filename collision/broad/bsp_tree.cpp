// SPDX-License-Identifier: BSD-3-Clause
// Binary space partitioning by planes across the axes: Fuchs, Kedem and Naylor, "On Visible Surface Generation by a priori
// Tree Structures" (1980); with planes across the axes it is the k-d tree of Bentley (1975). A box is listed in every leaf
// that its fat box reaches, and only the boxes of one leaf are tested against each other.
//
// When a body leaves its fat box, its entries in the leaves are renewed and looked through for new pairs; all others are
// kept. Leaves in which many gather are split at the median
// centre, where a plane tells enough of them apart; two that have become poor are joined.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/fat_boxes.hpp"
#include "collision/broad/kept_pairs.hpp"
#include "collision/broad/rounded_box.hpp"
#include "collision/broad_phase.hpp"

namespace polhode {
namespace {

using broad::Box;
using broad::RoundedBox;

using Index = std::uint32_t;
constexpr Index none = ~Index(0);
constexpr Index capacity = 16;         // entries of a leaf, before a plane is looked for
constexpr Index poor = 8;              // entries of two leaves, to be one again
constexpr double larger_side = 0.8;    // of the entries, at most, for a plane to be worth it
constexpr double both_sides = 1.7;     // entries on both sides together, over those before

struct Node {
  double plane = 0;
  std::uint8_t axis = 0;
  Index child = none;     // below the plane; the next one is the rest; none: a leaf
  Index head = none;      // entries of a leaf
  Index count = 0;
  Index limit = capacity; // entries at which a plane is looked for
};

struct Entry {
  RoundedBox box;
  Index body = 0, next = none;
};

class BspTree final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    if (fat_.update(bounds)) {
      kept_.forget();
      plant();
    } else {
      const auto left = fat_.left();
      // All out before any is put in: a split looks at the fat boxes of what is listed.
      for (std::size_t k = 0; k < left.size(); ++k) take_out(0, left[k], fat_.before(k));
      for (const Index body : left) put_in(0, body, fat_.fat(body));
    }
    for (const Index body : fat_.left()) {
      if (++question_ == 0) ask_anew();
      search(0, body, RoundedBox(fat_.fat(body)));
    }
    pairs_ = kept_.renew(fat_, bounds);
    leave_rooms();
  }

  std::span<const BodyPair> pairs() override { return pairs_; }

 private:
  void leave_rooms() {
    broad::leave_room(nodes_, 64 + 4 * fat_.size());
    broad::leave_room(entries_, 64 + 16 * fat_.size());
    broad::leave_room(free_nodes_, 64 + fat_.size());
    broad::leave_room(centres_, 256);
  }

  void plant() {
    nodes_.assign(1, Node{});
    free_nodes_.clear();
    entries_.clear();
    free_entry_ = none;
    ask_anew();
    for (Index body = 0; body < fat_.size(); ++body) link(0, body);
    split(0);
  }

  void ask_anew() {
    last_question_.assign(fat_.size(), 0);
    question_ = 1;
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
    entries_[e] = {RoundedBox(fat_.fat(body)), body, nodes_[v].head};
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

  /// The pairs of a body that left its fat box, each once: with bodies that did not, and before it.
  void search(Index v, Index body, const RoundedBox& rounded) {
    const Box& box = fat_.fat(body);
    while (nodes_[v].child != none) {
      const Node& node = nodes_[v];
      const bool below = reaches_below(node, box), above = reaches_above(node, box);
      if (below && above) search(node.child, body, rounded);
      v = node.child + Index(above);
    }
    for (Index e = nodes_[v].head; e != none; e = entries_[e].next) {
      const Entry& entry = entries_[e];
      if (!may_overlap(rounded, entry.box)) continue;
      const Index other = entry.body;
      if (other == body || last_question_[other] == question_ || (other > body && fat_.has_left(other))) continue;
      last_question_[other] = question_;
      if (overlap(box, fat_.fat(other))) kept_.add(body, other);
    }
  }

  broad::FatBoxes fat_;
  std::vector<Node> nodes_;  // the root first
  std::vector<Entry> entries_;
  std::vector<Index> free_nodes_;  // pairs of children that are not in use
  Index free_entry_ = none;        // a list of entries that are not in use
  std::vector<double> centres_;
  Index question_ = 0;                // the number of a search
  std::vector<Index> last_question_;  // of each body, the one that met it last
  broad::KeptPairs kept_;
  std::span<const BodyPair> pairs_;
};

}  // namespace

BroadPhaseEntry bsp_tree() {
  return {"bsp_tree", "space cut by planes across the axes, boxes listed in every part that they reach",
          [] { return std::unique_ptr<BroadPhase>(new BspTree); }};
}

}  // namespace polhode
