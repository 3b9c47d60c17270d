// SPDX-License-Identifier: BSD-3-Clause
// A hinge (revolute joint): the anchors coincide and the axes are parallel, d = 0, n₁ × n₂ = 0.
#pragma once

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Hinge final : public TwoEndedJoint<S, Hinge<S>> {
 public:
  static constexpr int equations = 5;
  static JointKind kind() {
    return {"hinge", "rotation about an axis only: d = 0, n1 parallel to n2", equations,
            JointEnds<S>::anchors_and_axis("n, axis of the hinge, axes of the first body")};
  }
  using TwoEndedJoint<S, Hinge<S>>::TwoEndedJoint;

  void fill(const JointNow<S>& now, std::span<ConstraintRow<S>> rows) const {
    now.coincide(rows);
    now.parallel(rows.subspan(3));
  }
};

}  // namespace polhode::core::joints
