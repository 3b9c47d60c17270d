// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/minkowski_pair.hpp"

#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/sphere.hpp"

namespace polhode {

ConvexCore::ConvexCore(const Shape& s) : shape(&s) {
  switch (s.tag()) {
    case ShapeTag::sphere:
      kind = Kind::point;
      radius = static_cast<const Sphere&>(s).radius();
      break;
    case ShapeTag::capsule:
      radius = static_cast<const Capsule&>(s).radius();
      half = {0, 0, static_cast<const Capsule&>(s).length() / 2};
      kind = half[2] > 0 ? Kind::segment : Kind::point;
      break;
    case ShapeTag::box:
      kind = Kind::box;
      half = static_cast<const Box&>(s).half_extents();
      break;
    case ShapeTag::convex_hull:
      kind = Kind::hull;
      break;
    default:
      kind = Kind::smooth;
  }
}

}  // namespace polhode
