// SPDX-License-Identifier: BSD-3-Clause
// The narrow phase `sat`: separating axes.
#include <stdexcept>
#include <string>

#include "collision/narrow/box_sat.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"

namespace polhode {
namespace {

const Box* as_box(const Shape& shape) { return dynamic_cast<const Box*>(&shape); }

[[noreturn]] void refuse(const Shape& a, const Shape& b) {
  throw std::invalid_argument("sat: it has no separating axes for " + std::string(a.kind()) + " and " + std::string(b.kind()) +
                              "; take gjk");
}

class Sat final : public NarrowPhase {
 public:
  bool overlap(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory*) const override {
    const Box *box_a = as_box(a), *box_b = as_box(b);
    if (box_a && box_b) return boxes_overlap({box_a->half_extents(), at_a}, {box_b->half_extents(), at_b});
    refuse(a, b);
  }

  Distance distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory*) const override {
    const Box *box_a = as_box(a), *box_b = as_box(b);
    if (box_a && box_b) return boxes_distance({box_a->half_extents(), at_a}, {box_b->half_extents(), at_b});
    refuse(a, b);
  }

  Manifold manifold(const Shape& a, const Pose&, const Shape& b, const Pose&, double, PairMemory*) const override {
    refuse(a, b);
  }
};

}  // namespace

NarrowPhaseEntry sat() {
  return {"sat", "largest separation over all face normals and products of edges",
          [] { return std::unique_ptr<NarrowPhase>(new Sat); }};
}

}  // namespace polhode
