// SPDX-License-Identifier: BSD-3-Clause
// Binary space partitioning by planes across the axes: Fuchs, Kedem and Naylor, "On Visible Surface Generation by a priori
// Tree Structures" (1980); with planes across the axes it is the k-d tree of Bentley (1975). A box is listed in every leaf
// that its fat box reaches, and only the boxes of one leaf are tested against each other.
//
// When a body leaves its fat box, one way down the tree finds the leaves of the old box and of the new one; its entries there
// are renewed, and the leaves of the new one looked through for new pairs. All others are kept. Memory is what this waits
// for: all ways down come first, so that it is known beforehand which leaves are next. Then leaves in which many gather are
// split at the median centre, where a plane tells enough of them apart, and two that have become poor are joined.
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

constexpr std::size_t leaves_ahead = 24, heads_ahead = 16, chunks_ahead = 8;  // visits, when memory is asked for them

/// What is read on the way down.
struct Node {
  double plane = 0;
  Index child = none;  // below the plane; the next one is the rest; none: a leaf
  std::uint8_t axis = 0;
};

/// What else there is of a node.
struct Leaf {
  Index head = none;       // the entries, in chunks of which only the first may have room
  Index count = 0;
  Index limit = capacity;  // entries at which a plane is looked for
  Index parent = none;     // of an inner node too
};

/// A body that left its fat box, at a leaf that the old one or the new one reaches.
struct Visit {
  Index leaf, body;
  bool was, is;
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
      plant();
    } else {
      follow();
    }
    pairs_ = kept_.renew(fat_, bounds);
    leave_rooms();
  }

  std::span<const BodyPair> pairs() override { return pairs_; }

 private:
  void leave_rooms() {
    broad::leave_room(nodes_, 64 + 4 * fat_.size());
    broad::leave_room(leaves_, 64 + 4 * fat_.size());
    broad::leave_room(visits_, 64 + 8 * fat_.size());
    broad::leave_room(chunks_, 64 + 2 * fat_.size());
    broad::leave_room(free_nodes_, 64 + fat_.size());
    broad::leave_room(centres_, 256);
  }

  void plant() {
    kept_.forget();
    nodes_.assign(1, Node{});
    leaves_.assign(1, Leaf{});
    free_nodes_.clear();
    chunks_.clear();
    free_chunk_ = none;
    ask_anew();
    for (Index body = 0; body < fat_.size(); ++body) link(0, body);
    split(0);
    for (Index body = 0; body < fat_.size(); ++body) {
      ask();
      search(0, body);
    }
  }

  void follow() {
    visits_.clear();
    const auto left = fat_.left();
    for (std::size_t k = 0; k < left.size(); ++k) visit(0, {0, left[k], true, true}, fat_.before(k), fat_.fat(left[k]));
    Index asked = none;
    for (std::size_t k = 0; k < visits_.size(); ++k) {
      fetch_ahead(k);
      const Visit& v = visits_[k];
      if (!v.is) {
        unlink(v.leaf, v.body);
        continue;
      }
      if (v.was) renew(v.leaf, v.body);
      else link(v.leaf, v.body);
      if (v.body != asked) ask();
      asked = v.body;
      search(v.leaf, v.body);  // those whose entries are still to be renewed will find the pair
    }
    for (const Visit& v : visits_) {
      if (!v.is) join_above(v.leaf);
    }
    for (const Visit& v : visits_) {
      if (!v.was && nodes_[v.leaf].child == none && leaves_[v.leaf].count > leaves_[v.leaf].limit) split(v.leaf);
    }
  }

  /// Notes the leaves at and below v that the box before or now reaches; the visit says which of them reach v.
  void visit(Index v, Visit at, const Box& before, const Box& now) {
    while (nodes_[v].child != none) {
      const Node node = nodes_[v];
      Visit above = at;
      above.was = broad::all(at.was, reaches_above(node, before));
      above.is = broad::all(at.is, reaches_above(node, now));
      at.was = broad::all(at.was, reaches_below(node, before));
      at.is = broad::all(at.is, reaches_below(node, now));
      const bool go_below = at.was || at.is, go_above = above.was || above.is;
      if (go_below && go_above) visit(node.child, at, before, now);
      if (go_above) at = above;
      v = node.child + Index(go_above);
    }
    at.leaf = v;
    visits_.push_back(at);
  }

  void fetch_ahead(std::size_t k) const {
    if (k + leaves_ahead < visits_.size()) broad::fetch(leaves_[visits_[k + leaves_ahead].leaf]);
    if (k + heads_ahead < visits_.size()) {
      const Index head = leaves_[visits_[k + heads_ahead].leaf].head;
      if (head != none) broad::fetch(chunks_[head]);
    }
    if (k + chunks_ahead < visits_.size()) {
      const Visit& soon = visits_[k + chunks_ahead];
      const Index head = leaves_[soon.leaf].head;
      if (head != none && chunks_[head].next != none) broad::fetch(chunks_[chunks_[head].next]);
      broad::fetch(fat_.fat(soon.body));
    }
  }

  /// The number of a search, by which it knows whom it has met.
  void ask() {
    if (++question_ == 0) ask_anew();
  }
  void ask_anew() {
    last_question_.assign(fat_.size(), 0);
    question_ = 1;
  }

  static bool reaches_below(const Node& n, const Box& b) { return b.low[n.axis] < n.plane; }
  static bool reaches_above(const Node& n, const Box& b) { return b.high[n.axis] >= n.plane; }

  void link(Index v, Index body) {
    Index head = leaves_[v].head;
    if (head == none || chunks_[head].count == Chunk::room) {
      head = free_chunk_;
      if (head == none) {
        head = static_cast<Index>(chunks_.size());
        chunks_.emplace_back();
      } else {
        free_chunk_ = chunks_[head].next;
      }
      chunks_[head].count = 0;
      chunks_[head].next = leaves_[v].head;
      leaves_[v].head = head;
    }
    Chunk& chunk = chunks_[head];
    chunk.body[chunk.count] = body;
    chunk.box[chunk.count++] = RoundedBox(fat_.fat(body));
    ++leaves_[v].count;
  }

  struct Place {
    Index chunk;
    std::size_t entry;
  };
  /// Of a body that is listed.
  Place place_of(Index v, Index body) const {
    Place p{leaves_[v].head, 0};
    while ((p.entry = place_in(chunks_[p.chunk], body)) == chunks_[p.chunk].count) p.chunk = chunks_[p.chunk].next;
    return p;
  }

  void renew(Index v, Index body) {
    const Place p = place_of(v, body);
    chunks_[p.chunk].box[p.entry] = RoundedBox(fat_.fat(body));
  }

  /// The last entry of the first chunk goes, after it has taken the place of that of a body.
  void unlink(Index v, Index body) {
    const Place p = place_of(v, body);
    Leaf& leaf = leaves_[v];
    Chunk& head = chunks_[leaf.head];
    --head.count;
    chunks_[p.chunk].body[p.entry] = head.body[head.count];
    chunks_[p.chunk].box[p.entry] = head.box[head.count];
    if (head.count == 0) leaf.head = release(leaf.head);
    --leaf.count;
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

  /// From the parent of a leaf upwards.
  void join_above(Index v) {
    do {
      v = leaves_[v].parent;
    } while (v != none && join(v));
  }

  /// Two poor leaves become one.
  bool join(Index v) {
    const Index first = nodes_[v].child;
    const std::array<Leaf, 2> both = {leaves_[first], leaves_[first + 1]};
    if (nodes_[first].child != none || nodes_[first + 1].child != none || both[0].count + both[1].count > poor) return false;
    std::array<Index, poor> bodies{};
    std::size_t count = 0;
    for (const Leaf& leaf : both) {
      for_entries(leaf.head, [&](Index body) { bodies[count++] = body; });
      for (Index chunk = leaf.head; chunk != none;) chunk = release(chunk);
    }
    leaves_[first] = leaves_[first + 1] = Leaf{};
    free_nodes_.push_back(first);
    nodes_[v].child = none;
    leaves_[v] = Leaf{.parent = leaves_[v].parent};
    const auto end = bodies.begin() + static_cast<std::ptrdiff_t>(count);
    std::sort(bodies.begin(), end);
    const auto last = std::unique(bodies.begin(), end);
    for (auto body = bodies.begin(); body != last; ++body) link(v, *body);
    return true;
  }

  /// Looks for the plane that leaves the least on its larger side, and splits by it if it is worth it.
  void split(Index v) {
    if (leaves_[v].count <= capacity) return;
    const auto count = static_cast<double>(leaves_[v].count);
    double best = larger_side * count;
    bool found = false;
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      Node trial;
      trial.axis = axis;
      trial.plane = median(v, axis);
      if (!std::isfinite(trial.plane)) continue;
      double below = 0, above = 0;
      for_entries(leaves_[v].head, [&](Index body) {
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
      leaves_[v].limit = 2 * leaves_[v].count;
      return;
    }
    divide(v);
  }

  void divide(Index v) {
    Index first;
    if (free_nodes_.empty()) {
      first = static_cast<Index>(nodes_.size());
      nodes_.resize(nodes_.size() + 2);
      leaves_.resize(nodes_.size());
    } else {
      first = free_nodes_.back();
      free_nodes_.pop_back();
    }
    nodes_[first] = nodes_[first + 1] = Node{};
    leaves_[first] = leaves_[first + 1] = Leaf{.parent = v};
    nodes_[v].child = first;
    Index c = leaves_[v].head;
    leaves_[v].head = none;
    leaves_[v].count = 0;
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
    for_entries(leaves_[v].head, [&](Index body) { centres_.push_back(centre(fat_.fat(body), axis)); });
    const auto middle = centres_.begin() + static_cast<std::ptrdiff_t>(centres_.size() / 2);
    std::nth_element(centres_.begin(), middle, centres_.end());
    return *middle;
  }

  /// At and below v the pairs of a body that left its fat box: with bodies that did not, and before it.
  void search(Index v, Index body) {
    const Box& box = fat_.fat(body);
    while (nodes_[v].child != none) {
      const Node& node = nodes_[v];
      const bool below = reaches_below(node, box), above = reaches_above(node, box);
      if (below && above) search(node.child, body);
      v = node.child + Index(above);
    }
    const RoundedBox rounded(box);
    for (Index c = leaves_[v].head; c != none; c = chunks_[c].next) {
      const Chunk& chunk = chunks_[c];
      for (std::size_t k = 0; k < chunk.count; ++k) {
        if (!may_overlap(rounded, chunk.box[k])) continue;
        const Index other = chunk.body[k];
        if (other == body || last_question_[other] == question_ || (other > body && fat_.has_left(other))) continue;
        last_question_[other] = question_;
        if (surely_overlap(rounded, chunk.box[k]) || overlap(box, fat_.fat(other))) kept_.add(body, other);
      }
    }
  }

  broad::FatBoxes fat_;
  std::vector<Node> nodes_;  // the root first
  std::vector<Leaf> leaves_;  // of the same numbers
  std::vector<Visit> visits_;
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
