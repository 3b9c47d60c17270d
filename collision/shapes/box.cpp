// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/box.hpp"

#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/shape_inertia.hpp"
#include "collision/shapes/size_checks.hpp"

namespace polhode::inline collision::inline shapes {

namespace {

Polytope box_polytope(const Vector3<double>& h) {
  std::vector<Vector3<double>> vertices;
  for (unsigned k = 0; k < 8; ++k)
    vertices.push_back({k & 1 ? h[0] : -h[0], k & 2 ? h[1] : -h[1], k & 4 ? h[2] : -h[2]});
  return make_polytope(std::move(vertices),
                       {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

}  // namespace

Box::Box(const Vector3<double>& half_extents)
    : Shape(ShapeTag::box), half_(positive_sizes("box", "size", half_extents)) {
  polytope_ = box_polytope(half_);
}

Bounds Box::bounds(const Pose& pose) const {
  const Vector3<double> half = pose.rotation.cwiseAbs() * half_;
  return {pose.position - half, pose.position + half};
}

MassProperties Box::mass_properties() const {
  const double volume = 8 * half_.prod();
  return centered_mass(volume, box_moments(volume, 2 * half_));
}

ShapeEntry box() {
  return {"box",
          "a cuboid; its faces look along the body axes",
          {lengths_parameter("size", "full edge lengths a, b, c")},
          [](const ShapeParameters& p) -> ShapePointer { return std::make_shared<Box>(p.vector("size") / 2); },
          [](double mass, const ShapeParameters& p) { return box_moments(mass, p.vector("size")); },
          "I1 = m (b^2 + c^2)/12, ..."};
}

}  // namespace polhode::collision::shapes
