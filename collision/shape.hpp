// SPDX-License-Identifier: BSD-3-Clause
// The port of shapes: the queries of broad and narrow phases to a solid, in its own axes. A new shape is one file and
// one line in the catalogue.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string_view>

#include "collision/pose.hpp"

namespace polhode::inline collision {

using Bounds = Eigen::AlignedBox3d;  ///< closed box along the world's axes, m

/// Volume (m³), centroid (m) and inertia about the centroid (m⁵, for a density of 1 kg/m³), in the shape's axes.
struct MassProperties {
  double volume = 0;
  Vector3<double> centroid = Vector3<double>::Zero();
  Matrix3<double> inertia = Matrix3<double>::Zero();
};

/// The shapes that narrow phases treat in closed form. Any other convex shape is treated by its support function alone.
enum class ShapeTag : std::uint8_t {
  sphere,
  box,
  capsule,
  cylinder,
  ellipsoid,
  convex_hull,
  compound,
  half_space,
  other
};

/// A closed convex solid, or a compound of such solids. Immutable. Constructors throw std::invalid_argument, with the
/// reason, if a size is zero, negative or not finite.
class Shape {
 public:
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  virtual ~Shape() = default;

  ShapeTag tag() const { return tag_; }
  virtual std::string_view kind() const = 0;  ///< name in the catalogue: "box"

  /// A point of the shape that is furthest along the direction d, which is not zero and need not be of unit length. A
  /// half-space has such a point along its normal only, and throws for other directions.
  virtual Vector3<double> support(const Vector3<double>& d) const = 0;

  /// The smallest axis-aligned box around the shape at a pose.
  virtual Bounds bounds(const Pose& pose) const = 0;

  /// False only for a half-space, which has no volume and never moves.
  virtual bool finite() const { return true; }
  virtual MassProperties mass_properties() const = 0;

 protected:
  explicit Shape(ShapeTag tag = ShapeTag::other) : tag_(tag) {}

 private:
  ShapeTag tag_;
};

using ShapePointer = std::shared_ptr<const Shape>;

}  // namespace polhode::collision
