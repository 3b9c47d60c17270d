// SPDX-License-Identifier: BSD-3-Clause
// The narrow phase `sat`: separating axes.
#include <stdexcept>
#include <string>

#include "collision/narrow/box_manifold.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"

namespace polhode {
namespace {

bool both_boxes(const Shape& a, const Shape& b) { return a.tag() == ShapeTag::box && b.tag() == ShapeTag::box; }

BoxAt box_at(const Shape& shape, const Pose& pose) { return {static_cast<const Box&>(shape).half_extents(), pose}; }

[[noreturn]] void refuse(const Shape& a, const Shape& b) {
  throw std::invalid_argument("sat: it has no separating axes for " + std::string(a.kind()) + " and " + std::string(b.kind()) +
                              "; take gjk");
}

class Sat final : public NarrowPhase {
 public:
  bool overlap(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory*) const override {
    if (both_boxes(a, b)) return boxes_overlap(box_at(a, at_a), box_at(b, at_b));
    refuse(a, b);
  }

  Distance distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory*) const override {
    if (both_boxes(a, b)) return boxes_distance(box_at(a, at_a), box_at(b, at_b));
    refuse(a, b);
  }

  Manifold manifold(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, double margin,
                    PairMemory*) const override {
    if (both_boxes(a, b)) return boxes_manifold(box_at(a, at_a), box_at(b, at_b), margin);
    refuse(a, b);
  }
};

}  // namespace

NarrowPhaseEntry sat() {
  return {"sat", "largest separation over all face normals and products of edges",
          [] { return std::unique_ptr<NarrowPhase>(new Sat); }};
}

}  // namespace polhode
