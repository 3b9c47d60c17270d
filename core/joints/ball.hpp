// SPDX-License-Identifier: BSD-3-Clause
// A ball joint: the two anchors coincide, d = 0. Rotations are free.
#pragma once

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Ball final : public TwoEndedJoint<S, Ball<S>> {
 public:
  static constexpr int equations = 3;
  static constexpr bool has_axes = false;
  static JointKind kind() {
    return {"ball", "two anchors coincide, rotations are free: d = 0", equations, JointEnds<S>::anchors()};
  }
  using TwoEndedJoint<S, Ball<S>>::TwoEndedJoint;

  void fill(const JointNow<S>& now, std::span<ConstraintRow<S>> rows) const { now.coincide(rows); }
};

}  // namespace polhode::core::joints
