// SPDX-License-Identifier: BSD-3-Clause
// All points with n·x ≤ c: a floor. It has no volume, and never moves.
#pragma once

#include "collision/shape.hpp"

namespace polhode::inline collision::inline shapes {

class HalfSpace final : public Shape {
 public:
  /// normal: n, outward, of any length but 0; offset: c, body axes; the plane is c/|n| (m) from the origin along n.
  /// Throws std::invalid_argument if that distance is not finite.
  explicit HalfSpace(const Vector3<double>& normal, double offset = 0);

  const Vector3<double>& normal() const { return normal_; }  ///< unit normal
  double offset() const { return offset_; }  ///< signed distance of the plane from the origin along the normal, m

  bool finite() const override { return false; }
  std::string_view kind() const override { return "half_space"; }
  Vector3<double> support(const Vector3<double>& d) const override;
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override;

 private:
  Vector3<double> normal_;
  double offset_ = 0;
};

}  // namespace polhode::collision::shapes
