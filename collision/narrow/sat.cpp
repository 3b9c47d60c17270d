// SPDX-License-Identifier: BSD-3-Clause
// The narrow phase `sat`: separating axes. Boxes have a path of their own; a compound answers with its parts: the least
// distance, or the deepest of the parts that overlap.
#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

#include "collision/narrow/box_manifold.hpp"
#include "collision/narrow/contact_patch.hpp"
#include "collision/narrow/hull_sat.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/compound.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

bool both_boxes(const Shape& a, const Shape& b) { return a.tag() == ShapeTag::box && b.tag() == ShapeTag::box; }

BoxAt box_at(const Shape& shape, const Pose& pose) { return {static_cast<const Box&>(shape).half_extents(), pose}; }

[[noreturn]] void refuse(const Shape& a, const Shape& b) {
  throw std::invalid_argument("sat: it has no separating axes for " + std::string(a.kind()) + " and " +
                              std::string(b.kind()) + "; take gjk");
}

bool has_polytopes(const Shape& s) { return has_separating_axes(s) || s.tag() == ShapeTag::compound; }

/// Two of them, or one and a half-space.
void check(const Shape& a, const Shape& b) {
  if (has_polytopes(a) && (has_polytopes(b) || b.tag() == ShapeTag::half_space)) return;
  if (!has_polytopes(b) || a.tag() != ShapeTag::half_space) refuse(a, b);
}

Distance signed_distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b) {
  if (both_boxes(a, b)) return boxes_distance(box_at(a, at_a), box_at(b, at_b));
  if (a.tag() == ShapeTag::compound || b.tag() == ShapeTag::compound) {
    const bool parts_of_a = a.tag() == ShapeTag::compound;
    Distance least{std::numeric_limits<double>::infinity()};
    for (const Compound::Part& part : static_cast<const Compound&>(parts_of_a ? a : b).parts()) {
      const Distance d = parts_of_a ? signed_distance(*part, at_a, b, at_b) : signed_distance(a, at_a, *part, at_b);
      if (d.distance < least.distance) least = d;
    }
    return least;
  }
  if (has_separating_axes(a) && has_separating_axes(b)) return hulls_distance(a, at_a, b, at_b);
  if (has_separating_axes(a) && b.tag() == ShapeTag::half_space) return above_half_space(a, at_a, b, at_b);
  if (has_separating_axes(b) && a.tag() == ShapeTag::half_space) return mirrored(above_half_space(b, at_b, a, at_a));
  refuse(a, b);
}

class Sat final : public NarrowPhase {
 public:
  bool overlap(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory*) const override {
    if (both_boxes(a, b)) return boxes_overlap(box_at(a, at_a), box_at(b, at_b));
    return signed_distance(a, at_a, b, at_b).distance <= 0;
  }

  Distance distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory*) const override {
    return signed_distance(a, at_a, b, at_b);
  }

  Manifold manifold(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, double margin,
                    PairMemory*) const override {
    if (both_boxes(a, b)) return boxes_manifold(box_at(a, at_a), box_at(b, at_b), margin);
    check(a, b);
    if (a.tag() == ShapeTag::compound || b.tag() == ShapeTag::compound)
      return compound_patch(*this, a, at_a, b, at_b, margin);
    return contact_patch(a, at_a, b, at_b, signed_distance(a, at_a, b, at_b), margin);
  }
};

}  // namespace

NarrowPhaseEntry sat() {
  return {"sat", "largest separation over all face normals and products of edges",
          [] { return std::unique_ptr<NarrowPhase>(new Sat); }};
}

}  // namespace polhode::collision::narrow
