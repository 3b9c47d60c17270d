// SPDX-License-Identifier: BSD-3-Clause
// The solid ellipsoid Σ (x_i/s_i)² ≤ 1.
#pragma once

#include "collision/shape.hpp"

namespace polhode::inline collision::inline shapes {

class Ellipsoid final : public Shape {
 public:
  explicit Ellipsoid(const Vector3<double>& semi_axes);  ///< m

  const Vector3<double>& semi_axes() const { return semi_axes_; }

  std::string_view kind() const override { return "ellipsoid"; }
  Vector3<double> support(const Vector3<double>& d) const override;
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override;

 private:
  Vector3<double> semi_axes_;
};

}  // namespace polhode::collision::shapes
