// SPDX-License-Identifier: BSD-3-Clause
// A slider (prismatic joint): motion along an axis of the first body, without rotation, u₁·d = v₁·d = 0.
#pragma once

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Slider final : public TwoEndedJoint<S, Slider<S>> {
 public:
  static constexpr int equations = 5;
  static JointKind kind() {
    return {"slider", "motion along an axis without rotation: u1.d = v1.d = 0, frames parallel", equations,
            JointEnds<S>::anchors_and_axis("n, direction of the slider, axes of the first body")};
  }
  using TwoEndedJoint<S, Slider<S>>::TwoEndedJoint;

  void fill(const JointNow<S>& now, std::span<ConstraintRow<S>> rows) const {
    rows[0] = now.along(now.axes1.col(1), JointEnd::first);
    rows[1] = now.along(now.axes1.col(2), JointEnd::first);
    now.parallel(rows.subspan(2));
    rows[4] = now.across(now.axes1.col(1), now.axes2.col(2));
  }
};

}  // namespace polhode::core::joints
