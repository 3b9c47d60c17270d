// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of points, by qhull (Barber, Dobkin & Huhdanpaa, The quickhull algorithm for convex hulls, 1996).
#pragma once

#include <array>
#include <span>

#include "collision/shape.hpp"
#include "collision/shapes/polytope.hpp"
#include "core/math/lanes.hpp"

namespace polhode::inline collision::inline shapes {

class ConvexHull final : public Shape {
 public:
  /// Points in m. Points inside the hull are left out; the others keep their order. Throws for fewer than 4 points, for
  /// points that are not finite, and for points in a plane, to 1e-10 of their extent.
  explicit ConvexHull(std::span<const Vector3<double>> points);

  /// The surface of the hull; coplanar facets are one face.
  const Polytope& polytope() const { return polytope_; }

  std::string_view kind() const override { return "convex_hull"; }
  Vector3<double> support(const Vector3<double>& d) const override { return polytope_.vertices[support_vertex(d)]; }
  std::uint32_t support_vertex(const Vector3<double>& d) const;
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override { return mass_; }

 private:
  std::uint32_t climb(const Vector3<double>& d) const;

  Polytope polytope_;
  MassProperties mass_;
  std::vector<Vector3<Lanes>> packs_;  ///< the vertices in groups of lane_count; the last group is filled with vertex 0
  std::array<std::uint32_t, 6> extreme_{};  ///< vertices furthest along ± each axis; hill climbing starts there
};

}  // namespace polhode::collision::shapes
