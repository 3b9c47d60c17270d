// SPDX-License-Identifier: BSD-3-Clause
// The box |x| <= hx, |y| <= hy, |z| <= hz in its own axes.
#pragma once

#include "collision/shape.hpp"

namespace polhode {

class Box final : public Shape {
 public:
  /// Half of each edge length, m. Throws std::invalid_argument if one is not positive and finite.
  explicit Box(const Vector3<double>& half_extents);

  const Vector3<double>& half_extents() const { return half_; }

  std::string_view kind() const override { return "box"; }
  Vector3<double> support(const Vector3<double>& d) const override;
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override;

 private:
  Vector3<double> half_;
};

}  // namespace polhode
