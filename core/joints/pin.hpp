// SPDX-License-Identifier: BSD-3-Clause
// A pin of a planar mechanism: the anchors coincide as seen along an axis of the first body, u₁·d = v₁·d = 0. It does
// not repeat the equations that keep the bodies in their planes.
#pragma once

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Pin final : public TwoEndedJoint<S, Pin<S>> {
 public:
  static constexpr int equations = 2;
  static JointKind kind() {
    return {"pin", "two anchors coincide as seen along an axis: u1.d = v1.d = 0", equations,
            JointEnds<S>::anchors_and_axis("n, direction of view, axes of the first body")};
  }
  using TwoEndedJoint<S, Pin<S>>::TwoEndedJoint;

  void fill(const JointNow<S>& now, std::span<ConstraintRow<S>> rows) const {
    rows[0] = now.along(now.axes1.col(1), JointEnd::first);
    rows[1] = now.along(now.axes1.col(2), JointEnd::first);
  }
};

}  // namespace polhode::core::joints
