// SPDX-License-Identifier: BSD-3-Clause
// A planar joint: the first anchor stays in the plane through the second anchor with the normal n₂, and the body turns
// about that normal only, n₂·d = 0, n₁ × n₂ = 0.
#pragma once

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Planar final : public TwoEndedJoint<S, Planar<S>> {
 public:
  static constexpr int equations = 3;
  static JointKind kind() {
    return {"planar", "motion in a plane: n2.d = 0, n1 parallel to n2", equations,
            JointEnds<S>::anchors_and_axis("n, normal of the plane, axes of the first body")};
  }
  using TwoEndedJoint<S, Planar<S>>::TwoEndedJoint;

  void fill(const JointNow<S>& now, std::span<ConstraintRow<S>> rows) const {
    rows[0] = now.along(now.axes2.col(0), JointEnd::second);
    now.parallel(rows.subspan(1));
  }
};

}  // namespace polhode::core::joints
