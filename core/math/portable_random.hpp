// SPDX-License-Identifier: BSD-3-Clause
// Portable random numbers, directions and rotations: the same for a seed with every standard library, which the
// distributions of <random> are not.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline math {

/// A generator of the numbers of its seed.
class PortableRandom {
 public:
  explicit PortableRandom(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  double power_of_ten(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  bool chance(double p) { return uniform(0, 1) < p; }
  int below(int n) { return std::min(int(uniform(0, n)), n - 1); }
  double angle() { return uniform(-std::numbers::pi, std::numbers::pi); }

  /// Standard normal distribution (Box & Muller, 1958).
  double bell() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return radius * std::cos(angle());
  }
  Vector3<double> uniform_vector(double low, double high) {
    const double x = uniform(low, high), y = uniform(low, high);
    return {x, y, uniform(low, high)};
  }
  /// Uniform distribution on the unit sphere.
  Vector3<double> direction() {
    const double z = uniform(-1, 1), around = angle(), radius = std::sqrt(1 - z * z);
    return {radius * std::cos(around), radius * std::sin(around), z};
  }
  /// Uniform distribution on the rotations.
  Quaternion<double> turn() {
    const double w = bell(), x = bell(), y = bell();
    return Quaternion<double>(w, x, y, bell()).normalized();
  }
  Matrix3<double> rotation() { return rotation_matrix<double>(turn()); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace polhode::core::math
