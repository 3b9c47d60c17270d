// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/half_space.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/size_checks.hpp"

namespace polhode::inline collision::inline shapes {

HalfSpace::HalfSpace(const Vector3<double>& normal, double offset) : Shape(ShapeTag::half_space) {
  const double length = normal.stableNorm();
  if (!std::isfinite(length) || length == 0) {
    throw std::invalid_argument("a half_space needs a normal that is finite and not zero");
  }
  if (!std::isfinite(offset)) {
    throw std::invalid_argument("a half_space needs a finite offset in m, not " + in_words(offset));
  }
  normal_ = normal.stableNormalized();
  offset_ = offset / length;
  if (!std::isfinite(offset_)) {
    throw std::invalid_argument(
        "a half_space has its plane at offset/|normal|, which is beyond what a double can hold; "
        "give a longer normal, or an offset less than " +
        in_words(offset));
  }
}

Vector3<double> HalfSpace::support(const Vector3<double>& d) const {
  if (d.cross(normal_).isZero(0) && d.dot(normal_) > 0) return offset_ * normal_;
  throw std::invalid_argument("a half_space reaches to infinity along every direction but its normal");
}

Bounds HalfSpace::bounds(const Pose& pose) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Bounds bounds(Vector3<double>::Constant(-infinity), Vector3<double>::Constant(infinity));
  const Vector3<double> n = pose.rotation * normal_;
  for (int i = 0; i < 3; ++i) {
    if (n[(i + 1) % 3] != 0 || n[(i + 2) % 3] != 0) continue;
    const double plane = pose.position[i] + std::copysign(offset_, n[i] * offset_);
    if (n[i] > 0) bounds.max()[i] = plane;
    else bounds.min()[i] = plane;
  }
  return bounds;
}

MassProperties HalfSpace::mass_properties() const {
  throw std::logic_error("a half_space has no volume: it is for static bodies only");
}

ShapeEntry half_space() {
  using enum Parameter::Need;
  return {"half_space",
          "all points with n.x <= c, for static bodies only",
          {{"normal", Vector3<double>(0, 0, 1), "",
            "n, out of the solid, taken as given: the plane is at c/|n| along it", optional},
           {"offset", 0.0, "m", "c, the distance of the plane from the origin where n has length 1", optional}},
          [](const ShapeParameters& p) -> ShapePointer {
            return std::make_shared<HalfSpace>(p.vector("normal"), p.number("offset"));
          }};
}

}  // namespace polhode::collision::shapes
