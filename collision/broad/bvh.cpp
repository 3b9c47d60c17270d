// SPDX-License-Identifier: BSD-3-Clause
// A bounding volume hierarchy that follows the motion: a binary tree of boxes over fat leaves. Leaves that a body left
// get a new box in place, and the boxes above them are refitted, with tree rotations wherever these lower the surface
// area (Kopta, Ize, Spjut, Brunvand, Davis and Kensler, "Fast, Effective BVH Updates for Animated Scenes", 2012). A
// leaf that jumped is taken out and inserted where it adds the least area (Goldsmith and Salmon 1987; Catto, "Dynamic
// Bounding Volume Hierarchies", 2019).
//
// Pairs of fat boxes are kept from step to step. The tree is traversed against itself (van den Bergen 1999), but only
// where a leaf has changed, and the pairs that are kept are tested as they are.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/fat_boxes.hpp"
#include "collision/broad/kept_pairs.hpp"
#include "collision/broad_phase.hpp"

namespace polhode::inline collision::inline broad {
namespace {

using broad::FatBoxes;
using broad::PlainBox;

using Index = std::uint32_t;
constexpr Index none = ~Index(0);

double area(const PlainBox& b) {
  const double x = b.high[0] - b.low[0], y = b.high[1] - b.low[1], z = b.high[2] - b.low[2];
  return x * y + y * z + z * x;
}

struct Node {
  PlainBox box;
  Index parent = none, left = none, right = none;  // right: of a leaf its body, left none
  bool changed = false;                            // it, or something below it, since pairs were last looked for
  bool leaf() const { return left == none; }
};

class Bvh final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    built_ = false;
    if (fat_.update(bounds)) {
      begin_scene();
      build();
    } else {
      for (const Index body : fat_.left()) follow(body);
      if (jumps_ > fat_.size() / 4) build();
      else if (root_ != none) refit(root_);
    }
    if (root_ != none) traverse(root_);
    for (std::size_t i = 0; i < outside_.size(); ++i) search_outside(i);
    if (root_ != none) settle(root_);
    pairs_ = kept_.renew(fat_, bounds);
  }

  std::span<const BodyPair> pairs() override { return pairs_; }

  /// Its nodes, the leaves among them.
  void cells(std::vector<Bounds>& all) const override {
    if (root_ != none) cells_below(root_, all);
  }

 private:
  void cells_below(Index v, std::vector<Bounds>& all) const {
    const Node& node = nodes_[v];
    all.push_back(broad::bounds_of(node.box));
    if (node.leaf()) return;
    cells_below(node.left, all);
    cells_below(node.right, all);
  }

  void begin_scene() {
    leaf_.assign(fat_.size(), none);
    nodes_.reserve(2 * fat_.size() + 2);
    free_.reserve(2 * fat_.size() + 2);
    order_.reserve(fat_.size());
    outside_.reserve(fat_.size());
  }

  /// Builds the tree anew, by halves along the longest side.
  void build() {
    nodes_.clear();
    free_.clear();
    order_.clear();
    outside_.clear();
    jumps_ = 0;
    built_ = true;
    kept_.forget();
    for (Index i = 0; i < fat_.size(); ++i) {
      leaf_[i] = none;
      if (FatBoxes::too_large(fat_.fat(i))) outside_.push_back(i);
      else order_.push_back(i);
    }
    root_ = order_.empty() ? none : build(0, order_.size(), none);
  }

  Index build(std::size_t begin, std::size_t end, Index parent) {
    const Index v = new_node();
    nodes_[v].parent = parent;
    nodes_[v].changed = true;
    if (end - begin == 1) {
      nodes_[v].left = none;
      nodes_[v].right = order_[begin];
      nodes_[v].box = fat_.fat(order_[begin]);
      leaf_[order_[begin]] = v;
      return v;
    }
    std::array<double, 3> low, high;
    low.fill(1e300);
    high.fill(-1e300);
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double c = centre(fat_.fat(order_[i]), k);
        low[k] = std::min(low[k], c);
        high[k] = std::max(high[k], c);
      }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [&](Index a, Index b) {
      const double x = centre(fat_.fat(a), axis), y = centre(fat_.fat(b), axis);
      return x < y || (x == y && a < b);
    });
    const Index left = build(begin, middle, v), right = build(middle, end, v);
    nodes_[v].left = left;
    nodes_[v].right = right;
    nodes_[v].box = hull(nodes_[left].box, nodes_[right].box);
    return v;
  }

  Index new_node() {
    if (!free_.empty()) {
      const Index v = free_.back();
      free_.pop_back();
      nodes_[v] = Node{};
      return v;
    }
    nodes_.emplace_back();
    return static_cast<Index>(nodes_.size() - 1);
  }

  /// A body that left its fat box.
  void follow(Index body) {
    const PlainBox& box = fat_.fat(body);
    const bool fits = !FatBoxes::too_large(box);
    const Index leaf = leaf_[body];
    if (leaf == none && !fits) return;
    if (leaf != none && fits) {
      const Index parent = nodes_[leaf].parent;
      const bool near = parent == none || overlap(nodes_[parent].box, box);
      if (near) {
        nodes_[leaf].box = box;
        return mark(leaf);
      }
    }
    ++jumps_;
    if (leaf != none) remove(leaf);
    leaf_[body] = none;
    if (fits) {
      std::erase(outside_, body);
      insert(body);
    } else {
      outside_.push_back(body);
    }
  }

  void mark(Index v) {
    for (; v != none && !nodes_[v].changed; v = nodes_[v].parent) nodes_[v].changed = true;
  }

  void remove(Index leaf) {
    const Index parent = nodes_[leaf].parent;
    free_.push_back(leaf);
    if (parent == none) {
      root_ = none;
      return;
    }
    const Index sibling = nodes_[parent].left == leaf ? nodes_[parent].right : nodes_[parent].left;
    const Index above = nodes_[parent].parent;
    nodes_[sibling].parent = above;
    if (above == none) root_ = sibling;
    else replace_child(above, parent, sibling);
    free_.push_back(parent);
    for (Index v = above; v != none; v = nodes_[v].parent) {
      nodes_[v].box = hull(nodes_[nodes_[v].left].box, nodes_[nodes_[v].right].box);
    }
  }

  void replace_child(Index parent, Index old, Index by) {
    (nodes_[parent].left == old ? nodes_[parent].left : nodes_[parent].right) = by;
    nodes_[by].parent = parent;
  }

  /// Down to where it adds the least area.
  void insert(Index body) {
    const PlainBox box = fat_.fat(body);
    const Index leaf = new_node();
    nodes_[leaf].box = box;
    nodes_[leaf].right = body;
    leaf_[body] = leaf;
    if (root_ == none) {
      root_ = leaf;
      nodes_[leaf].changed = true;
      return;
    }
    Index v = root_;
    while (!nodes_[v].leaf()) {
      const double own = area(nodes_[v].box), with = area(hull(nodes_[v].box, box));
      const double inherited = with - own;
      const auto below = [&](Index child) {
        const PlainBox& c = nodes_[child].box;
        const double joined = area(hull(c, box));
        return inherited + (nodes_[child].leaf() ? joined : joined - area(c));
      };
      const double left = below(nodes_[v].left), right = below(nodes_[v].right);
      if (with < left && with < right) break;
      v = left < right ? nodes_[v].left : nodes_[v].right;
    }
    const Index above = nodes_[v].parent, parent = new_node();
    nodes_[parent] = {hull(nodes_[v].box, box), above, v, leaf, nodes_[v].changed};
    if (above == none) root_ = parent;
    else replace_child(above, v, parent);
    nodes_[v].parent = nodes_[leaf].parent = parent;
    for (Index u = above; u != none; u = nodes_[u].parent) nodes_[u].box = hull(nodes_[u].box, box);
    mark(leaf);
  }

  /// The boxes of what has changed, from below.
  void refit(Index v) {
    Node& node = nodes_[v];
    if (!node.changed || node.leaf()) return;
    refit(node.left);
    refit(node.right);
    rotate(v);
    node.box = hull(nodes_[node.left].box, nodes_[node.right].box);
  }

  /// Changes a child for a grandchild on the other side where that lowers the area most.
  void rotate(Index v) {
    Index best_child = none, best_grandchild = none;
    double best = 0;
    const Index children[2] = {nodes_[v].left, nodes_[v].right};
    for (int side = 0; side < 2; ++side) {
      const Index child = children[side], other = children[1 - side];
      const Node& o = nodes_[other];
      if (o.leaf()) continue;
      const double before = area(o.box);
      const double left = area(hull(nodes_[child].box, nodes_[o.right].box)) - before;  // child in the left's place
      const double right = area(hull(nodes_[child].box, nodes_[o.left].box)) - before;
      if (left < best) best = left, best_child = child, best_grandchild = o.left;
      if (right < best) best = right, best_child = child, best_grandchild = o.right;
    }
    if (best_child == none) return;
    const Index other = nodes_[best_grandchild].parent;
    replace_child(v, best_child, best_grandchild);
    replace_child(other, best_grandchild, best_child);
    Node& o = nodes_[other];
    o.box = hull(nodes_[o.left].box, nodes_[o.right].box);
    o.changed = true;
  }

  void traverse(Index v) {
    const Node& node = nodes_[v];
    if (!node.changed || node.leaf()) return;
    traverse(node.left);
    traverse(node.right);
    traverse(node.left, node.right);
  }

  void traverse(Index u, Index v) {
    const Node &a = nodes_[u], &b = nodes_[v];
    if (!(a.changed || b.changed) || !overlap(a.box, b.box)) return;
    if (a.leaf() && b.leaf()) return kept_.add(a.right, b.right);
    if (b.leaf() || (!a.leaf() && area(a.box) > area(b.box))) {
      traverse(a.left, v);
      traverse(a.right, v);
    } else {
      traverse(u, b.left);
      traverse(u, b.right);
    }
  }

  /// Nothing below has changed any more.
  void settle(Index v) {
    Node& node = nodes_[v];
    if (!node.changed) return;
    node.changed = false;
    if (node.leaf()) return;
    settle(node.left);
    settle(node.right);
  }

  /// A body that is not in the tree, against all that are and those outside behind it.
  void search_outside(std::size_t i) {
    const Index body = outside_[i];
    const auto test = [&](Index other) {
      const bool fresh = built_ || fat_.has_left(body) || fat_.has_left(other);
      if (fresh && overlap(fat_.fat(body), fat_.fat(other))) kept_.add(body, other);
    };
    for (Index other = 0; other < fat_.size(); ++other) {
      if (leaf_[other] != none) test(other);
    }
    for (std::size_t j = i + 1; j < outside_.size(); ++j) test(outside_[j]);
  }

  FatBoxes fat_;
  std::vector<Node> nodes_;
  std::vector<Index> free_, leaf_, order_, outside_;
  Index root_ = none;
  std::size_t jumps_ = 0;  // number of jumps since the tree was built
  bool built_ = false;     // the tree was built in this step, so that all pairs are to be found
  broad::KeptPairs kept_;
  std::span<const BodyPair> pairs_;
};

}  // namespace

BroadPhaseEntry bvh() {
  return {"bvh", "a binary tree of boxes over fat leaves, refitted and rotated, traversed where it changed",
          [] { return std::unique_ptr<BroadPhase>(new Bvh); }};
}

}  // namespace polhode::collision::broad
