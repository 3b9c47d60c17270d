// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/pair_order.hpp"

#include <array>

#include "collision/shapes/half_space.hpp"

namespace polhode::inline collision::inline narrow {

namespace {

/// −1, 0 or 1, by the first number that differs.
template <class V>
int compare(const V& a, const V& b) {
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (a.data()[i] != b.data()[i]) return a.data()[i] < b.data()[i] ? -1 : 1;
  }
  return 0;
}

/// Compares two shapes by kind, bounds, centroid and inertia; half-spaces by kind, bounds, normal and offset.
int compare_shapes(const Shape& a, const Shape& b) {
  if (&a == &b) return 0;
  if (const int by_kind = a.kind().compare(b.kind()); by_kind != 0) return by_kind;
  const Bounds box_a = a.bounds({}), box_b = b.bounds({});
  if (const int c = compare(box_a.min(), box_b.min()); c != 0) return c;
  if (const int c = compare(box_a.max(), box_b.max()); c != 0) return c;
  if (a.tag() == ShapeTag::half_space && b.tag() == ShapeTag::half_space) {
    const auto &floor_a = static_cast<const HalfSpace&>(a), &floor_b = static_cast<const HalfSpace&>(b);
    if (const int c = compare(floor_a.normal(), floor_b.normal()); c != 0) return c;
    return floor_a.offset() < floor_b.offset() ? -1 : floor_a.offset() > floor_b.offset();
  }
  if (!a.finite() || !b.finite()) return 0;
  const MassProperties mass_a = a.mass_properties(), mass_b = b.mass_properties();
  if (const int c = compare(mass_a.centroid, mass_b.centroid); c != 0) return c;
  return compare(mass_a.inertia, mass_b.inertia);
}

}  // namespace

bool exchanged_at_equal_x(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b) {
  int c = compare(at_a.position, at_b.position);
  if (c == 0) c = compare(at_a.rotation, at_b.rotation);
  if (c == 0) c = compare_shapes(a, b);
  return c > 0;
}

}  // namespace polhode::collision::narrow
