// SPDX-License-Identifier: BSD-3-Clause
// The narrow phase `sat_course_report`: the test as the course report writes it (section 2.2, algorithm 2), over the
// face normals of A only. The vector to a vertex of B is taken from a point of the face, as it must be.
//
// It errs by design: three of the fifteen axes of two boxes leave pairs that are apart unnoticed. Its signed distance
// is the largest separation over those normals, and A against B is not B against A.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"

namespace polhode::inline collision::inline narrow {
namespace {

const Box& box(const Shape& shape) {
  if (shape.tag() == ShapeTag::box) return static_cast<const Box&>(shape);
  throw std::invalid_argument("sat_course_report: it needs faces and vertices, and knows those of boxes; a " +
                              std::string(shape.kind()) + " is for gjk");
}

class SatCourseReport final : public NarrowPhase {
 public:
  bool overlap(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory*) const override {
    return !(distance(a, at_a, b, at_b, nullptr).distance > 0);
  }

  Distance distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory*) const override {
    const Vector3<double>&half_a = box(a).half_extents(), &half_b = box(b).half_extents();
    for (const Pose* at : {&at_a, &at_b}) {
      if (at->position.allFinite() && at->rotation.allFinite()) continue;
      throw std::invalid_argument("sat_course_report: the pose of a box is not finite");
    }
    Distance most;
    most.distance = -std::numeric_limits<double>::infinity();
    for (int face = 0; face < 6; ++face) {
      const int k = face / 2;
      const Vector3<double> normal = at_a.rotation.col(k) * (face % 2 == 0 ? 1.0 : -1.0);
      const Vector3<double> on_face = at_a.position + half_a[k] * normal;
      double least = std::numeric_limits<double>::infinity();
      Vector3<double> nearest = on_face;
      for (int vertex = 0; vertex < 8; ++vertex) {
        const Vector3<double> corner(vertex & 1 ? half_b[0] : -half_b[0], vertex & 2 ? half_b[1] : -half_b[1],
                                     vertex & 4 ? half_b[2] : -half_b[2]);
        const Vector3<double> v = at_b.to_world(corner);
        const double outside = (v - on_face).dot(normal);
        if (outside < least) {
          least = outside;
          nearest = v;
        }
      }
      if (least > most.distance) most = {least, -normal, nearest - least * normal, nearest};
    }
    return most;
  }

  Manifold manifold(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, double margin,
                    PairMemory*) const override {
    const Distance d = distance(a, at_a, b, at_b, nullptr);
    Manifold one;
    if (d.distance > margin) return one;
    one.normal = d.normal;
    one.points[0] = {0.5 * (d.on_a + d.on_b), -d.distance, {}};
    one.count = 1;
    return one;
  }
};

}  // namespace

NarrowPhaseEntry sat_course_report() {
  return {"sat_course_report",
          "the face normals of A only, as the course report writes it: it reports overlaps that are none",
          [] { return std::unique_ptr<NarrowPhase>(new SatCourseReport); }};
}

}  // namespace polhode::collision::narrow
