// SPDX-License-Identifier: BSD-3-Clause
// The box |x_i| ≤ h_i.
#pragma once

#include <cmath>

#include "collision/shape.hpp"
#include "collision/shapes/polytope.hpp"

namespace polhode::inline collision::inline shapes {

class Box final : public Shape {
 public:
  explicit Box(const Vector3<double>& half_extents);  ///< m

  const Vector3<double>& half_extents() const { return half_; }

  /// Vertex k is at ±h: bit i of k set means + on axis i. Face 2i has the normal −axis i, face 2i + 1 the normal +axis
  /// i.
  const Polytope& polytope() const { return polytope_; }

  std::string_view kind() const override { return "box"; }
  Vector3<double> support(const Vector3<double>& d) const override {
    return {std::copysign(half_[0], d[0]), std::copysign(half_[1], d[1]), std::copysign(half_[2], d[2])};
  }
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override;

 private:
  Vector3<double> half_;
  Polytope polytope_;
};

}  // namespace polhode::collision::shapes
