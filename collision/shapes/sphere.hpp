// SPDX-License-Identifier: BSD-3-Clause
// The ball |x| ≤ r.
#pragma once

#include "collision/shape.hpp"

namespace polhode::inline collision::inline shapes {

class Sphere final : public Shape {
 public:
  explicit Sphere(double radius);  ///< m

  double radius() const { return radius_; }

  std::string_view kind() const override { return "sphere"; }
  Vector3<double> support(const Vector3<double>& d) const override { return radius_ * d.stableNormalized(); }
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override;

 private:
  double radius_;
};

}  // namespace polhode::collision::shapes
