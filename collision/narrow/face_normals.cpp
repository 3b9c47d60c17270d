// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/face_normals.hpp"

#include <array>

namespace polhode::inline collision::inline narrow {

namespace {

double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

}  // namespace

Vector3<double> accurate_cross(const Vector3<double>& a, const Vector3<double>& b) {
  return {difference_of_products(a[1], b[2], a[2], b[1]), difference_of_products(a[2], b[0], a[0], b[2]),
          difference_of_products(a[0], b[1], a[1], b[0])};
}

Vector3<double> nearest_face_normal(const ConvexCore& core, const Vector3<double>& d) {
  if (core.kind == ConvexCore::Kind::box) {
    int axis = 0;
    d.cwiseAbs().maxCoeff(&axis);
    Vector3<double> n = Vector3<double>::Zero();
    n[axis] = std::copysign(1.0, d[axis]);
    return n;
  }
  const Polytope::Face* best = nullptr;
  double most = -2;
  for (const Polytope::Face& face : core.hull().polytope().faces) {
    const double along = face.normal.dot(d);
    if (along > most) {
      most = along;
      best = &face;
    }
  }
  return best->normal;
}

Vector3<double> nearest_edge_product(const MinkowskiCorner& c0, const MinkowskiCorner& c1, const MinkowskiCorner& c2,
                                     const Vector3<double>& n) {
  const std::array<Vector3<double>, 3> edges_a = {c1.a - c0.a, c2.a - c1.a, c0.a - c2.a};
  const std::array<Vector3<double>, 3> edges_b = {c1.turned_b - c0.turned_b, c2.turned_b - c1.turned_b,
                                                  c0.turned_b - c2.turned_b};
  Vector3<double> best = Vector3<double>::Zero();
  double most = 0.995;
  for (const Vector3<double>& u : edges_a) {
    if (u.isZero(0)) continue;
    for (const Vector3<double>& v : edges_b) {
      const Vector3<double> x = accurate_cross(u, v);
      const double size = x.norm();
      if (!(size > 0)) continue;
      const double along = x.dot(n) / size;
      if (std::abs(along) <= most) continue;
      most = std::abs(along);
      best = x * (std::copysign(1.0, along) / size);
    }
  }
  return best;
}

}  // namespace polhode::collision::narrow
