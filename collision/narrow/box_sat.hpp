// SPDX-License-Identifier: BSD-3-Clause
// Two boxes by separating axes: the three face normals of each and the nine products of their edges.
// Source: Gottschalk, Lin & Manocha, OBBTree, 1996; the depth and the distance below.
//
// The depth is the true minimum over the fifteen axes; no axis is preferred. For an edge product the unit vector is
// formed first, and both boxes are projected on it. Nearly parallel edges then lose no digits: in A's axes, the product
// of an axis of A with an axis of B consists of two entries of the relative rotation, without any subtraction. The
// largest separation is only a lower bound of the distance; if a vertex is nearest, the distance is that of the vertex
// to the other box.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "collision/broad_phase.hpp"
#include "collision/contact.hpp"
#include "collision/pose.hpp"

namespace polhode::inline collision::inline narrow {

/// A box at a pose, by reference.
struct BoxAt {
  const Vector3<double>& half;  ///< m
  const Pose& pose;
};

/// One of the fifteen axes.
struct BoxAxis {
  int index = 0;          ///< 0–2 faces of A, 3–5 faces of B, 6 + 3i + j edge i of A × edge j of B
  double separation = 0;  ///< separation along the normal, negative if the boxes overlap, m
  Vector3<double> normal = Vector3<double>::Zero();  ///< unit normal from A to B, in A's axes
};

/// B in the axes of A.
struct RelativeBoxes {
  Vector3<double> half_a, half_b;
  Matrix3<double> b_in_a;  ///< column j is axis j of B in A's axes
  Vector3<double> offset;  ///< centre of B in A's axes, m
  double scale;            ///< length to which round-off is relative, m

  RelativeBoxes(const BoxAt& a, const BoxAt& b);
};

/// Order of the two boxes, so that A against B and B against A are the same computation.
bool in_order(const BoxAt& a, const BoxAt& b);

/// The axis along which the boxes are furthest apart, or overlap least; or the first face axis along which they are
/// more than `enough` (m) apart, if there is one. Throws std::invalid_argument if a pose is not finite.
BoxAxis best_axis(const RelativeBoxes& boxes, double enough = std::numeric_limits<double>::infinity());

/// True if the closed boxes overlap or touch. Exact whenever gap or overlap is larger than round-off. Throws
/// std::invalid_argument if a pose is not finite.
bool boxes_overlap(const BoxAt& a, const BoxAt& b);

/// Signed distance. A against B mirrors B against A exactly, unless the boxes agree in all numbers. Throws
/// std::invalid_argument if a pose is not finite.
Distance boxes_distance(const BoxAt& a, const BoxAt& b);

/// A box at a pose, by value, for queries of many pairs.
struct PosedBox {
  Vector3<double> half = Vector3<double>::Ones();  ///< m
  Pose pose{};
};

/// overlap[k] = boxes_overlap of pair k, several pairs side by side in SIMD lanes.
void boxes_overlap(std::span<const PosedBox> boxes, std::span<const BodyPair> pairs, std::span<std::uint8_t> overlap);

}  // namespace polhode::collision::narrow
