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
  Index head = none;      // the entries of a leaf, in chunks of which only the first may have room
  Index count = 0;
  Index limit = capacity; // entries at which a plane is looked for
};

/// Entries of a leaf side by side in memory, which one after the other in a list would be waited for.
struct Chunk {
  static constexpr Index room = 8;
  std::array<Index, room> body;
  std::array<RoundedBox, room> box;
  Index count = 0, next = none;
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
    broad::leave_room(chunks_, 64 + 2 * fat_.size());
    broad::leave_room(free_nodes_, 64 + fat_.size());
    broad::leave_room(centres_, 256);
  }

  void plant() {
    nodes_.assign(1, Node{});
    free_nodes_.clear();
    chunks_.clear();
    free_chunk_ = none;
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
    Index head = nodes_[v].head;
    if (head == none || chunks_[head].count == Chunk::room) {
      head = free_chunk_;
      if (head == none) {
        head = static_cast<Index>(chunks_.size());
        chunks_.emplace_back();
      } else {
        free_chunk_ = chunks_[head].next;
      }
      chunks_[head].count = 0;
      chunks_[head].next = nodes_[v].head;
      nodes_[v].head = head;
    }
    Chunk& chunk = chunks_[head];
    chunk.body[chunk.count] = body;
    chunk.box[chunk.count++] = RoundedBox(fat_.fat(body));
    ++nodes_[v].count;
  }

  /// The last entry of the first chunk goes, after it has taken the place of that of a body.
  void unlink(Index v, Index body) {
    Node& node = nodes_[v];
    Index c = node.head;
    std::size_t k = place_in(chunks_[c], body);
    while (k == chunks_[c].count) {
      c = chunks_[c].next;
      k = place_in(chunks_[c], body);
    }
    Chunk& head = chunks_[node.head];
    --head.count;
    chunks_[c].body[k] = head.body[head.count];
    chunks_[c].box[k] = head.box[head.count];
    if (head.count == 0) node.head = release(node.head);
    --node.count;
  }
  static std::size_t place_in(const Chunk& chunk, Index body) {
    std::size_t k = 0;
    while (k < chunk.count && chunk.body[k] != body) ++k;
    return k;
  }

  /// Returns the next one.
  Index release(Index c) {
    const Index next = chunks_[c].next;
    chunks_[c].next = free_chunk_;
    free_chunk_ = c;
    return next;
  }

  /// Calls visit(body) for the entries of a leaf.
  template <class Visit>
  void for_entries(Index head, const Visit& visit) const {
    for (Index c = head; c != none; c = chunks_[c].next) {
      for (std::size_t k = 0; k < chunks_[c].count; ++k) visit(chunks_[c].body[k]);
    }
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
    if (node.child == none) return unlink(v, body);
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
      for_entries(nodes_[c].head, [&](Index body) { bodies[count++] = body; });
      for (Index chunk = nodes_[c].head; chunk != none;) chunk = release(chunk);
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
      for_entries(nodes_[v].head, [&](Index body) {
        const Box& box = fat_.fat(body);
        below += reaches_below(trial, box);
        above += reaches_above(trial, box);
      });
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
    Index c = nodes_[v].head;
    nodes_[v].head = none;
    nodes_[v].count = 0;
    while (c != none) {
      const Chunk chunk = chunks_[c];
      c = release(c);
      for (std::size_t k = 0; k < chunk.count; ++k) {
        const Box& box = fat_.fat(chunk.body[k]);
        if (reaches_below(nodes_[v], box)) link(first, chunk.body[k]);
        if (reaches_above(nodes_[v], box)) link(first + 1, chunk.body[k]);
      }
    }
    split(first);
    split(first + 1);
  }

  double median(Index v, std::size_t axis) {
    centres_.clear();
    for_entries(nodes_[v].head, [&](Index body) { centres_.push_back(centre(fat_.fat(body), axis)); });
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
    for (Index c = nodes_[v].head; c != none; c = chunks_[c].next) {
      const Chunk& chunk = chunks_[c];
      for (std::size_t k = 0; k < chunk.count; ++k) {
        if (!may_overlap(rounded, chunk.box[k])) continue;
        const Index other = chunk.body[k];
        if (other == body || last_question_[other] == question_ || (other > body && fat_.has_left(other))) continue;
        last_question_[other] = question_;
        if (overlap(box, fat_.fat(other))) kept_.add(body, other);
      }
    }
  }

  broad::FatBoxes fat_;
  std::vector<Node> nodes_;  // the root first
  std::vector<Chunk> chunks_;
  std::vector<Index> free_nodes_;  // pairs of children that are not in use
  Index free_chunk_ = none;        // a list of chunks that are not in use
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
