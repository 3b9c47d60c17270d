// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/minkowski_pair.hpp"

#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/sphere.hpp"

namespace polhode::inline collision::inline narrow {

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
    case ShapeTag::convex_hull: kind = Kind::hull; break;
    default: kind = Kind::smooth;
  }
}

std::uint32_t ConvexCore::support_of_others(const Vector3<double>& d, Vector3<double>& x) const {
  switch (kind) {
    case Kind::point: x.setZero(); return 0;
    case Kind::segment: x = {0, 0, std::copysign(half[2], d[2])}; return unsigned(!std::signbit(d[2]));
    case Kind::hull: {
      const std::uint32_t i = hull().support_vertex(d);
      x = hull().polytope().vertices[i];
      return i;
    }
    default: x = shape->support(d); return no_vertex;
  }
}

std::uint32_t ConvexCore::vertex_count_of_others() const {
  switch (kind) {
    case Kind::point: return 1;
    case Kind::segment: return 2;
    case Kind::hull: return std::uint32_t(hull().polytope().vertices.size());
    default: return 0;
  }
}

void ConvexCore::vertex_of_others(std::uint32_t i, Vector3<double>& x) const {
  switch (kind) {
    case Kind::segment: x = {0, 0, i & 1 ? half[2] : -half[2]}; break;
    case Kind::hull: x = hull().polytope().vertices[i]; break;
    default: x.setZero();
  }
}

}  // namespace polhode::collision::narrow
