// SPDX-License-Identifier: BSD-3-Clause
// All points at most r away from a segment of length l on body axis 3; a ball if l = 0.
#pragma once

#include <cmath>

#include "collision/shape.hpp"

namespace polhode::inline collision::inline shapes {

class Capsule final : public Shape {
 public:
  Capsule(double radius, double length);  ///< the length is that of the segment; both in m

  double radius() const { return radius_; }
  double length() const { return 2 * half_; }

  std::string_view kind() const override { return "capsule"; }
  Vector3<double> support(const Vector3<double>& d) const override {
    return radius_ * d.stableNormalized() + Vector3<double>(0, 0, std::copysign(half_, d[2]));
  }
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override;

 private:
  double radius_, half_;
};

}  // namespace polhode::collision::shapes
