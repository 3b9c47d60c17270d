// SPDX-License-Identifier: BSD-3-Clause
// Binary space partitioning by planes across the axes: Fuchs, Kedem and Naylor, "On Visible Surface Generation by a
// priori Tree Structures" (1980); with planes across the axes it is the k-d tree of Bentley (1975). A box is listed in
// every leaf that its fat box reaches, and only the boxes of one leaf are tested against each other.
//
// When a body leaves its fat box, one way down the tree finds the leaves of the old box and of the new one; its entries
// there are renewed, and the new leaves are searched for new pairs. All others are kept. Most of the time is spent
// waiting for memory: all ways down come first, so that the next leaves are known beforehand; and the boxes of a leaf
// are tested all at once, seven bits for a side (broad/cell_block.hpp), and what is hit is then tested on the boxes
// themselves. Then leaves with many boxes are split at the median centre, where a plane separates enough of them, and
// two that have become poor are joined.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/cell_block.hpp"
#include "collision/broad/fat_boxes.hpp"
#include "collision/broad/kept_pairs.hpp"
#include "collision/broad_phase.hpp"

namespace polhode::inline collision::inline broad {
namespace {

using broad::PlainBox;
using broad::cells::lanes;
using broad::cells::Limits;
using broad::cells::Reach;

using Index = std::uint32_t;
constexpr Index none = ~Index(0);
constexpr Index capacity = 16;       // entries of a leaf, before a plane is looked for
constexpr Index poor = 8;            // entries of two leaves, to be one again
constexpr double larger_side = 0.8;  // largest share of the entries on one side of a plane that is worth it
constexpr double both_sides = 1.7;   // entries on both sides together, over those before

constexpr std::size_t leaves_ahead = 24, heads_ahead = 16, chunks_ahead = 8;  // visits by which memory is fetched ahead

/// The part of a node that is read while descending.
struct Node {
  double plane = 0;
  Index child = none;  // number of the child below the plane; the next number is the other child; none: a leaf
  std::uint8_t axis = 0;
};

/// The units in which a leaf counts the sides of its boxes, from 1 to 126. What is beyond is taken for the first or the
/// last, which keeps the order of numbers, whatever the units are.
struct Frame {
  static constexpr int units = 126;

  std::array<float, 3> origin{};
  float per_metre = 0;

  Frame() = default;
  explicit Frame(const PlainBox& b) : per_metre(static_cast<float>((units - 2) / size_of(b))) {
    for (std::size_t k = 0; k < 3; ++k) origin[k] = static_cast<float>(b.low[k]);
  }
  std::int64_t side(double x, std::size_t k) const {
    const double u = (x - double(origin[k])) * double(per_metre);
    return u > 0 ? 1 + static_cast<std::int64_t>(std::min(u, double(units - 1))) : 1;  // 1 also where u is no number
  }
  Reach reach(const PlainBox& b) const {
    Reach r;
    for (std::size_t k = 0; k < 3; ++k) {
      r.low[k] = side(b.low[k], k);
      r.high[k] = side(b.high[k], k);
    }
    return r;
  }
};

/// The rest of a node.
struct alignas(32) Leaf {
  Index head = none;  // the entries, in chunks of which only the first may have room
  Index count = 0;
  Index limit = capacity;  // entries at which a plane is looked for
  Index parent = none;     // parent of an inner node too
  Frame frame{};
};

/// A body that left its fat box, at a leaf that the old one or the new one reaches.
struct Visit {
  Index leaf, body;
  bool was, is;
};

/// Entries of a leaf side by side in memory, in as many lanes from the first on. Which bodies they are stands
/// elsewhere.
struct alignas(64) Chunk : broad::cells::Sides {
  Index count = 0, next = none;
  Chunk() { hide_all(); }
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

  /// The parts into which its planes cut the box around all bodies.
  void cells(std::vector<Bounds>& all) const override {
    Around around;
    for (Index body = 0; body < fat_.size(); ++body) around.add(fat_.fat(body));
    if (around.any) cells_below(0, around.box, all);
  }

 private:
  void cells_below(Index v, const PlainBox& part, std::vector<Bounds>& all) const {
    const Node& node = nodes_[v];
    if (node.child == none) {
      all.push_back(broad::bounds_of(part));
      return;
    }
    PlainBox below = part, above = part;
    below.high[node.axis] = above.low[node.axis] = std::clamp(node.plane, part.low[node.axis], part.high[node.axis]);
    cells_below(node.child, below, all);
    cells_below(node.child + 1, above, all);
  }

  void leave_rooms() {
    broad::leave_room(nodes_, 64 + 4 * fat_.size());
    broad::leave_room(leaves_, 64 + 4 * fat_.size());
    broad::leave_room(visits_, 64 + 8 * fat_.size());
    broad::leave_room(chunks_, 64 + 2 * fat_.size());
    broad::leave_room(bodies_in_, lanes * chunks_.capacity());
    broad::leave_room(free_nodes_, 64 + fat_.size());
    broad::leave_room(centres_, 256);
  }

  void plant() {
    kept_.forget();
    nodes_.assign(1, Node{});
    Around all;
    for (Index body = 0; body < fat_.size(); ++body) all.add(fat_.fat(body));
    leaves_.assign(1, Leaf{.frame = all.frame()});
    free_nodes_.clear();
    chunks_.clear();
    bodies_in_.clear();
    free_chunk_ = none;
    ask_anew();
    for (Index body = 0; body < fat_.size(); ++body) link(0, body);
    split(0);
    for (Index body = 0; body < fat_.size(); ++body) {
      ask();
      search(0, body);
    }
    settle_hits();
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
    settle_hits();
    for (const Visit& v : visits_) {
      if (!v.is) join_above(v.leaf);
    }
    for (const Visit& v : visits_) {
      if (!v.was && nodes_[v.leaf].child == none && leaves_[v.leaf].count > leaves_[v.leaf].limit) split(v.leaf);
    }
  }

  /// Notes the leaves at and below v that the box before or now reaches; a visit holds which of the boxes reach v.
  void visit(Index v, Visit at, const PlainBox& before, const PlainBox& now) {
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
      if (head != none) fetch_chunk(head);
    }
    if (k + chunks_ahead < visits_.size()) {
      const Visit& soon = visits_[k + chunks_ahead];
      const Index head = leaves_[soon.leaf].head;
      if (head != none && chunks_[head].next != none) fetch_chunk(chunks_[head].next);
      broad::fetch(fat_.fat(soon.body));
    }
  }
  void fetch_chunk(Index c) const {
    broad::fetch(chunks_[c]);
    broad::fetch(bodies_in_[lanes * c]);
    broad::fetch(bodies_in_[lanes * c + lanes - 1]);
  }

  /// Begins a search with a number of its own, which marks the bodies that it has met.
  void ask() {
    if (++question_ != 0) return;
    settle_hits();
    ask_anew();
  }
  void ask_anew() {
    last_question_.assign(fat_.size(), 0);
    question_ = 1;
  }

  static bool reaches_below(const Node& n, const PlainBox& b) { return b.low[n.axis] < n.plane; }
  static bool reaches_above(const Node& n, const PlainBox& b) { return b.high[n.axis] >= n.plane; }

  void link(Index v, Index body) {
    Index head = leaves_[v].head;
    if (head == none || chunks_[head].count == lanes) {
      head = free_chunk_;
      if (head == none) {
        head = static_cast<Index>(chunks_.size());
        chunks_.emplace_back();
        bodies_in_.resize(lanes * chunks_.size());
      } else {
        free_chunk_ = chunks_[head].next;
      }
      chunks_[head] = Chunk{};
      chunks_[head].next = leaves_[v].head;
      leaves_[v].head = head;
    }
    Chunk& chunk = chunks_[head];
    bodies_in_[lanes * head + chunk.count] = body;
    chunk.set(chunk.count++, leaves_[v].frame.reach(fat_.fat(body)));
    ++leaves_[v].count;
  }

  struct Place {
    Index chunk;
    std::size_t entry;
  };
  /// The place of a body that is in the leaf.
  Place place_of(Index v, Index body) const {
    Place p{leaves_[v].head, 0};
    while ((p.entry = place_in(p.chunk, body)) == chunks_[p.chunk].count) p.chunk = chunks_[p.chunk].next;
    return p;
  }

  void renew(Index v, Index body) {
    const Place p = place_of(v, body);
    chunks_[p.chunk].set(p.entry, leaves_[v].frame.reach(fat_.fat(body)));
  }

  /// The last entry of the first chunk goes, after it has taken the place of that of a body.
  void unlink(Index v, Index body) {
    const Place p = place_of(v, body);
    Leaf& leaf = leaves_[v];
    Chunk& head = chunks_[leaf.head];
    --head.count;
    bodies_in_[lanes * p.chunk + p.entry] = bodies_in_[lanes * leaf.head + head.count];
    chunks_[p.chunk].set(p.entry, head, head.count);
    head.hide(head.count);
    if (head.count == 0) leaf.head = release(leaf.head);
    --leaf.count;
  }
  std::size_t place_in(Index c, Index body) const {
    std::size_t k = 0;
    while (k < chunks_[c].count && bodies_in_[lanes * c + k] != body) ++k;
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
      for (std::size_t k = 0; k < chunks_[c].count; ++k) visit(bodies_in_[lanes * c + k]);
    }
  }

  /// Joins poor leaves, from the parent of a leaf upwards.
  void join_above(Index v) {
    do {
      v = leaves_[v].parent;
    } while (v != none && join(v));
  }

  /// Two poor leaves become one.
  bool join(Index v) {
    const Index first = nodes_[v].child;
    const std::array<Leaf, 2> both = {leaves_[first], leaves_[first + 1]};
    if (nodes_[first].child != none || nodes_[first + 1].child != none || both[0].count + both[1].count > poor)
      return false;
    std::array<Index, poor> bodies{};
    std::size_t count = 0;
    for (const Leaf& leaf : both) {
      for_entries(leaf.head, [&](Index body) { bodies[count++] = body; });
      for (Index chunk = leaf.head; chunk != none;) chunk = release(chunk);
    }
    leaves_[first] = leaves_[first + 1] = Leaf{};
    free_nodes_.push_back(first);
    nodes_[v].child = none;
    const auto end = bodies.begin() + static_cast<std::ptrdiff_t>(count);
    Around around;
    std::for_each(bodies.begin(), end, [&](Index body) { around.add(fat_.fat(body)); });
    leaves_[v] = Leaf{.parent = leaves_[v].parent, .frame = around.frame()};
    std::sort(bodies.begin(), end);
    const auto last = std::unique(bodies.begin(), end);
    for (auto body = bodies.begin(); body != last; ++body) link(v, *body);
    return true;
  }

  /// Finds the plane that leaves the least on its larger side, and splits by it if it is worth it.
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
        const PlainBox& box = fat_.fat(body);
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
    Around below, above;
    for_entries(leaves_[v].head, [&](Index body) {
      const PlainBox& box = fat_.fat(body);
      if (reaches_below(nodes_[v], box)) below.add(box);
      if (reaches_above(nodes_[v], box)) above.add(box);
    });
    leaves_[first] = Leaf{.parent = v, .frame = below.frame()};
    leaves_[first + 1] = Leaf{.parent = v, .frame = above.frame()};
    nodes_[v].child = first;
    Index c = leaves_[v].head;
    leaves_[v].head = none;
    leaves_[v].count = 0;
    while (c != none) {
      std::array<Index, lanes> bodies;
      const std::size_t count = chunks_[c].count;
      std::copy_n(&bodies_in_[lanes * c], lanes, bodies.begin());
      c = release(c);
      for (std::size_t k = 0; k < count; ++k) {
        const PlainBox& box = fat_.fat(bodies[k]);
        if (reaches_below(nodes_[v], box)) link(first, bodies[k]);
        if (reaches_above(nodes_[v], box)) link(first + 1, bodies[k]);
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

  /// Finds the pairs, at and below v, of a body that left its fat box: with bodies that did not, and with those before
  /// it.
  void search(Index v, Index body) {
    const PlainBox& box = fat_.fat(body);
    while (nodes_[v].child != none) {
      const Node& node = nodes_[v];
      const bool below = reaches_below(node, box), above = reaches_above(node, box);
      if (below && above) search(node.child, body);
      v = node.child + Index(above);
    }
    const Reach r = leaves_[v].frame.reach(box);
    const Limits x(r.low[0], r.high[0]), y(r.low[1], r.high[1]), z(r.low[2], r.high[2]);
    for (Index c = leaves_[v].head; c != none; c = chunks_[c].next) {
      broad::cells::for_lanes(chunks_[c].overlapping(x, y, z),
                              [&](std::size_t lane) { hit(body, bodies_in_[lanes * c + lane]); });
    }
  }

  /// Stores a candidate pair. Candidates are tested later, many together, so that memory latencies overlap.
  void hit(Index body, Index other) {
    if (other == body || (other > body && fat_.has_left(other))) return;
    broad::fetch(last_question_[other]);
    broad::fetch(fat_.fat(other));
    hits_[hit_count_++] = {body, other, question_};
    if (hit_count_ == hits_.size()) settle_hits();
  }

  void settle_hits() {
    for (std::size_t k = 0; k < hit_count_; ++k) {
      const Hit& h = hits_[k];
      if (last_question_[h.other] == h.question) continue;
      last_question_[h.other] = h.question;
      if (overlap(fat_.fat(h.body), fat_.fat(h.other))) kept_.add(h.body, h.other);
    }
    hit_count_ = 0;
  }

  /// The box around boxes, as far as it has bounds.
  struct Around {
    PlainBox box{};
    bool any = false;
    void add(const PlainBox& b) {
      if (broad::FatBoxes::too_large(b)) return;
      box = any ? hull(box, b) : b;
      any = true;
    }
    Frame frame() const { return any ? Frame(box) : Frame(); }
  };

  broad::FatBoxes fat_;
  std::vector<Node> nodes_;   // the root first
  std::vector<Leaf> leaves_;  // leaves with the numbers of their nodes
  std::vector<Visit> visits_;
  std::vector<Chunk> chunks_;
  std::vector<Index> bodies_in_;   // the lanes of the chunks
  std::vector<Index> free_nodes_;  // pairs of children that are not in use
  Index free_chunk_ = none;        // a list of chunks that are not in use
  std::vector<double> centres_;
  struct Hit {
    Index body, other, question;
  };
  std::array<Hit, 256> hits_;
  std::size_t hit_count_ = 0;
  Index question_ = 0;                // the number of a search
  std::vector<Index> last_question_;  // number of the last search that met each body
  broad::KeptPairs kept_;
  std::span<const BodyPair> pairs_;
};

}  // namespace

BroadPhaseEntry bsp_tree() {
  return {"bsp_tree", "space cut by planes across the axes, boxes listed in every part that they reach",
          [] { return std::unique_ptr<BroadPhase>(new BspTree); }};
}

}  // namespace polhode::collision::broad
