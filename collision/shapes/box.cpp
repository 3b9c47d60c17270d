// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/box.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace polhode {

Box::Box(const Vector3<double>& half_extents) : half_(half_extents) {
  for (int k = 0; k < 3; ++k) {
    if (std::isfinite(half_[k]) && half_[k] > 0) continue;
    throw std::invalid_argument("box: half extent " + std::to_string(k) + " is " + std::to_string(half_[k]) +
                                " m; it must be positive and finite");
  }
}

Vector3<double> Box::support(const Vector3<double>& d) const {
  return {std::copysign(half_[0], d[0]), std::copysign(half_[1], d[1]), std::copysign(half_[2], d[2])};
}

Bounds Box::bounds(const Pose& pose) const {
  const Vector3<double> reach = pose.rotation.cwiseAbs() * half_;
  return {pose.position - reach, pose.position + reach};
}

MassProperties Box::mass_properties() const {
  MassProperties m;
  m.volume = 8 * half_[0] * half_[1] * half_[2];
  const Vector3<double> squares = half_.cwiseProduct(half_);
  m.inertia.diagonal() = (Vector3<double>::Constant(squares.sum()) - squares) * (m.volume / 3);
  return m;
}

}  // namespace polhode
