// SPDX-License-Identifier: BSD-3-Clause
// Two boxes by separating axes: the three face normals of each and the nine products of their edges.
// Source: Gottschalk, Lin & Manocha, OBBTree, 1996; the depth and the distance below.
//
// The depth is the true minimum over the fifteen axes, no axis preferred. Of an edge product the unit vector is formed
// first and both boxes are projected on it: then nearly parallel edges cost no digits, since in A's axes the product of
// an axis of A with an axis of B consists of two entries of the relative rotation, without any subtraction.
// The largest separation is only a lower bound of the distance; where a vertex is nearest, the distance is that of the
// vertex from the other box.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "collision/broad_phase.hpp"
#include "collision/contact.hpp"
#include "collision/pose.hpp"

namespace polhode::inline collision {

/// A box where it stands, by reference.
struct BoxAt {
  const Vector3<double>& half;  ///< m
  const Pose& pose;
};

/// One of the fifteen axes.
struct BoxAxis {
  int index = 0;          ///< 0–2 faces of A, 3–5 faces of B, 6 + 3i + j edge i of A × edge j of B
  double separation = 0;  ///< m, along the normal; negative: overlap
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit, in A's axes, from A to B
};

/// B as A sees it.
struct RelativeBoxes {
  Vector3<double> half_a, half_b;
  Matrix3<double> b_in_a;  ///< column j is axis j of B in A's axes
  Vector3<double> offset;  ///< centre of B in A's axes, m
  double scale;            ///< m, what round-off is measured by

  RelativeBoxes(const BoxAt& a, const BoxAt& b);
};

/// The order in which two boxes are looked at, so that A against B and B against A are one computation.
bool in_order(const BoxAt& a, const BoxAt& b);

/// Along which the boxes are furthest apart, or overlap least; the first face along which they are further apart than
/// `enough` (m), if there is one. Throws std::invalid_argument if a pose is not finite.
BoxAxis best_axis(const RelativeBoxes& boxes, double enough = std::numeric_limits<double>::infinity());

/// Closed boxes: true where they touch. Right wherever they are apart, or overlap, by more than round-off. Throws
/// std::invalid_argument if a pose is not finite.
bool boxes_overlap(const BoxAt& a, const BoxAt& b);

/// Signed distance. Boxes that are the same in all numbers have no order; else A against B mirrors B against A exactly.
/// Throws std::invalid_argument if a pose is not finite.
Distance boxes_distance(const BoxAt& a, const BoxAt& b);

/// A box where it stands, for many pairs at once.
struct PosedBox {
  Vector3<double> half = Vector3<double>::Ones();  ///< m
  Pose pose{};
};

/// overlap[k] = boxes_overlap of pair k, several pairs side by side in SIMD lanes.
void boxes_overlap(std::span<const PosedBox> boxes, std::span<const BodyPair> pairs, std::span<std::uint8_t> overlap);

}  // namespace polhode
