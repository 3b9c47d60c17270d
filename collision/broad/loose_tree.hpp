// SPDX-License-Identifier: BSD-3-Clause
// The loose quadtree (Dim 2: halves along x and y) and octree (Dim 3): Ulrich, "Loose Octrees", Game Programming Gems
// (2000); the trees are those of Finkel and Bentley (1974) and of Meagher (1980). A body is stored in the node that
// contains its centre, no deeper than the level whose cells are as wide as the body. Large bodies therefore stay in
// inner nodes, and a body extends beyond its cell by at most half a cell. Nodes with many bodies are split, and joined
// again when bodies leave.
//
// A body that stays in its cell stays in its node. In each step the bodies are laid out in the order of the tree, with
// the bounding box of each node and everything below it; the tree is then traversed against itself. Correctness of the
// pairs depends on these boxes alone, not on the nodes in which bodies are stored.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/pair_list.hpp"
#include "collision/broad_phase.hpp"

namespace polhode::inline collision::inline broad {

template <std::size_t Dim>
class LooseTree final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    const bool new_scene = bounds.size() != boxes_.size();
    take(bounds, boxes_);
    if (new_scene || astray_ > boxes_.size() / 8 + 8) plant();
    astray_ = 0;
    for (Index i = 0; i < boxes_.size(); ++i) {
      if (home_[i] != none && stays(i)) continue;
      if (home_[i] != none) take_out(i);
      if (!in_root(boxes_[i])) ++astray_;
      put_in(i);
    }
    stale_ = true;
  }

  std::span<const BodyPair> pairs() override {
    if (!stale_) return sorted_;
    found_.clear();
    laid_.clear();
    bodies_.clear();
    if (!nodes_.empty()) {
      lay_out(0);
      leave_room(nodes_, 256 + 2 * boxes_.size());
      leave_room(free_, 64 + boxes_.size() / 4);
      traverse(0);
    }
    sorted_ = found_.sorted(boxes_.size());
    stale_ = false;
    return sorted_;
  }

  /// The loose cells of the nodes that contain bodies: extended by half a cell on each side. Cells of a quadtree extend
  /// over the height of the scene.
  void cells(std::vector<Bounds>& all) const override {
    if (nodes_.empty()) return;
    Extent heights;
    for (const PlainBox& b : boxes_) heights.add(b, 2);
    cells_below(0, heights, all);
  }

 private:
  using Index = std::uint32_t;
  static constexpr Index none = ~Index(0);
  static constexpr Index children = Index(1) << Dim;
  static constexpr std::size_t capacity =
      8;  // bodies in a leaf before it is split; bodies too large for a child do not count
  static constexpr int deepest = 40;

  struct Node {
    std::array<double, Dim> middle{};
    double half = 0;  // half the edge length of the cell
    int depth = 0;
    Index parent = none, child = none;  // the first of its children, which are adjacent
    Index head = none;                  // head of the list of its bodies
    Index count = 0;
    Index begin = 0, own_end = 0;  // range of its own bodies in the layout
    PlainBox box{};                // bounding box of its bodies and of everything below
    bool empty = true;
  };

  /// Sets the root cell around the centres of all bodies with finite bounds.
  void plant() {
    std::array<double, Dim> low, high;
    low.fill(far);
    high.fill(-far);
    for (const PlainBox& b : boxes_) {
      for (std::size_t k = 0; k < Dim; ++k) {
        const double c = std::clamp(centre(b, k), -far, far);
        if (std::abs(c) == far) continue;
        low[k] = std::min(low[k], c);
        high[k] = std::max(high[k], c);
      }
    }
    nodes_.clear();
    free_.clear();
    Node root;
    for (std::size_t k = 0; k < Dim; ++k) {
      if (!(low[k] <= high[k])) continue;
      root.middle[k] = 0.5 * (low[k] + high[k]);
      root.half = std::max(root.half, 0.55 * (high[k] - low[k]));
    }
    if (root.half == 0) root.half = 1;
    nodes_.push_back(root);
    home_.assign(boxes_.size(), none);
    next_.assign(boxes_.size(), none);
    before_.assign(boxes_.size(), none);
    laid_.reserve(boxes_.size());
    bodies_.reserve(boxes_.size());
  }

  bool within(const PlainBox& b, const Node& node) const {
    for (std::size_t k = 0; k < Dim; ++k) {
      if (!(std::abs(centre(b, k) - node.middle[k]) <= node.half)) return false;
    }
    return true;
  }
  bool in_root(const PlainBox& b) const { return within(b, nodes_[0]); }

  /// True if a body may be stored in a child: it is no wider than a child's cell.
  static bool fits_below(const PlainBox& b, const Node& node) {
    return size_of(b) <= node.half && node.depth < deepest;
  }

  bool stays(Index i) const {
    const Node& node = nodes_[home_[i]];
    const bool as_deep_as_may_be = node.child == none || !fits_below(boxes_[i], node);
    return as_deep_as_may_be &&
           (node.parent == none || (size_of(boxes_[i]) <= 2 * node.half && within(boxes_[i], node)));
  }

  Index child_of(const Node& node, const PlainBox& b) const {
    Index which = 0;
    for (std::size_t k = 0; k < Dim; ++k) which |= Index(centre(b, k) >= node.middle[k]) << k;
    return node.child + which;
  }

  void put_in(Index i) {
    Index v = 0;
    while (nodes_[v].child != none && fits_below(boxes_[i], nodes_[v])) v = child_of(nodes_[v], boxes_[i]);
    link(i, v);
    if (nodes_[v].count > capacity && nodes_[v].child == none) split(v);
  }

  void link(Index i, Index v) {
    Node& node = nodes_[v];
    home_[i] = v;
    before_[i] = none;
    next_[i] = node.head;
    if (node.head != none) before_[node.head] = i;
    node.head = i;
    ++node.count;
  }

  void take_out(Index i) {
    Node& node = nodes_[home_[i]];
    (before_[i] == none ? node.head : next_[before_[i]]) = next_[i];
    if (next_[i] != none) before_[next_[i]] = before_[i];
    --node.count;
  }

  /// Moves bodies that fit into children, if there are enough of them.
  void split(Index v) {
    std::size_t fitting = 0;
    for (Index i = nodes_[v].head; i != none; i = next_[i]) fitting += fits_below(boxes_[i], nodes_[v]);
    if (fitting <= capacity) return;
    Index first;
    if (free_.empty()) {
      first = static_cast<Index>(nodes_.size());
      nodes_.resize(nodes_.size() + children);
    } else {
      first = free_.back();
      free_.pop_back();
    }
    for (Index c = 0; c < children; ++c) {
      Node child;
      child.half = 0.5 * nodes_[v].half;
      for (std::size_t k = 0; k < Dim; ++k) {
        child.middle[k] = nodes_[v].middle[k] + (c >> k & 1 ? child.half : -child.half);
      }
      child.depth = nodes_[v].depth + 1;
      child.parent = v;
      nodes_[first + c] = child;
    }
    nodes_[v].child = first;
    for (Index i = nodes_[v].head, after; i != none; i = after) {
      after = next_[i];
      if (!fits_below(boxes_[i], nodes_[v])) continue;
      take_out(i);
      link(i, child_of(nodes_[v], boxes_[i]));
    }
    for (Index c = 0; c < children; ++c) {
      if (nodes_[first + c].count > capacity) split(first + c);
    }
  }

  /// Lays out the bodies of a node and below, in the order of the tree. Returns their number.
  Index lay_out(Index v) {
    const auto begin = static_cast<Index>(laid_.size());
    PlainBox box{};
    for (Index i = nodes_[v].head; i != none; i = next_[i]) {
      box = laid_.size() == begin ? boxes_[i] : hull(box, boxes_[i]);
      laid_.push_back(boxes_[i]);
      bodies_.push_back(i);
    }
    const auto own_end = static_cast<Index>(laid_.size());
    bool empty = own_end == begin;
    bool leaves_below = true;
    if (nodes_[v].child != none) {
      for (Index c = nodes_[v].child; c < nodes_[v].child + children; ++c) {
        lay_out(c);
        const Node& child = nodes_[c];
        leaves_below &= child.child == none;
        if (child.empty) continue;
        box = empty ? child.box : hull(box, child.box);
        empty = false;
      }
    }
    const auto count = static_cast<Index>(laid_.size()) - begin;
    if (nodes_[v].child != none && leaves_below && count <= capacity / 2) join(v);
    Node& node = nodes_[v];
    node.begin = begin;
    node.own_end = node.child == none ? begin + count : own_end;
    node.box = box;
    node.empty = empty;
    return count;
  }

  /// Moves the bodies of the children back to the node, if they are few.
  void join(Index v) {
    const Index first = nodes_[v].child;
    for (Index c = first; c < first + children; ++c) {
      for (Index i = nodes_[c].head, after; i != none; i = after) {
        after = next_[i];
        take_out(i);
        link(i, v);
      }
    }
    nodes_[v].child = none;
    free_.push_back(first);
  }

  /// Finds all pairs at and below a node.
  void traverse(Index v) {
    const Node& node = nodes_[v];
    if (node.empty) return;
    for (Index i = node.begin; i < node.own_end; ++i) {
      for (Index j = i + 1; j < node.own_end; ++j) test(i, j);
    }
    if (node.child == none) return;
    for (Index c = node.child; c < node.child + children; ++c) {
      for (Index i = node.begin; i < node.own_end; ++i) search(c, i);
      traverse(c);
      for (Index d = c + 1; d < node.child + children; ++d) traverse(c, d);
    }
  }

  /// Finds all pairs of a body at or below u and a body at or below v; neither node is below the other.
  void traverse(Index u, Index v) {
    const Node &a = nodes_[u], &b = nodes_[v];
    if (a.empty || b.empty || !overlap(a.box, b.box)) return;
    for (Index i = a.begin; i < a.own_end; ++i) search(v, i);
    if (a.child == none) return;
    for (Index c = a.child; c < a.child + children; ++c) traverse(v, c);
  }

  /// Finds all pairs of a laid-out body with bodies at and below a node.
  void search(Index v, Index i) {
    const Node& node = nodes_[v];
    if (node.empty || !overlap(node.box, laid_[i])) return;
    for (Index j = node.begin; j < node.own_end; ++j) test(i, j);
    if (node.child == none) return;
    for (Index c = node.child; c < node.child + children; ++c) search(c, i);
  }

  /// Extent of all finite bounds along an axis.
  struct Extent {
    double low = far, high = -far;
    void add(const PlainBox& b, std::size_t axis) {
      if (!(b.low[axis] > -far && b.high[axis] < far)) return;
      low = std::min(low, b.low[axis]);
      high = std::max(high, b.high[axis]);
    }
  };

  /// The loose cell of a node, enlarged to contain bodies that extend further, as happens in the root.
  void cells_below(Index v, const Extent& heights, std::vector<Bounds>& all) const {
    const Node& node = nodes_[v];
    if (node.empty) return;
    Bounds cell;
    for (std::size_t k = 0; k < 3; ++k) {
      Extent extent = heights;
      if (k < Dim) {
        extent = {node.middle[k] - 2 * node.half, node.middle[k] + 2 * node.half};
        for (Index i = node.head; i != none; i = next_[i]) extent.add(boxes_[i], k);
      }
      const auto axis = static_cast<Eigen::Index>(k);
      cell.min()[axis] = extent.low;
      cell.max()[axis] = extent.high;
    }
    if (cell.min()[2] <= cell.max()[2]) all.push_back(cell);
    if (node.child == none) return;
    for (Index c = node.child; c < node.child + children; ++c) cells_below(c, heights, all);
  }

  void test(Index i, Index j) {
    if (overlap(laid_[i], laid_[j])) found_.add(bodies_[i], bodies_[j]);
  }

  static constexpr double far = 1e150;

  std::vector<PlainBox> boxes_;
  std::vector<Node> nodes_;                  // the root first
  std::vector<Index> free_;                  // blocks of four or eight children that are not in use
  std::vector<Index> home_, next_, before_;  // node of each body, and its neighbours in the list of that node
  std::size_t astray_ = 0;                   // bodies inserted in the last step that lie outside the root cell
  std::vector<PlainBox> laid_;               // boxes of the bodies in the order of the tree
  std::vector<Index> bodies_;
  PairList found_;
  std::span<const BodyPair> sorted_;
  bool stale_ = false;
};

}  // namespace polhode::collision::broad
