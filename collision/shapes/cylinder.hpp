// SPDX-License-Identifier: BSD-3-Clause
// The solid cylinder of radius r and length l about body axis 3.
#pragma once

#include "collision/shape.hpp"

namespace polhode::inline collision::inline shapes {

class Cylinder final : public Shape {
 public:
  Cylinder(double radius, double length);  ///< m

  double radius() const { return radius_; }
  double length() const { return 2 * half_; }

  std::string_view kind() const override { return "cylinder"; }
  Vector3<double> support(const Vector3<double>& d) const override;
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override;

 private:
  double radius_, half_;
};

}  // namespace polhode::collision::shapes
