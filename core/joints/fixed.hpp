// SPDX-License-Identifier: BSD-3-Clause
// A fixed joint: the anchors coincide and the second body does not turn against the first, d = 0 and three directions
// of the first body stay perpendicular to three of the second.
#pragma once

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Fixed final : public TwoEndedJoint<S, Fixed<S>> {
 public:
  static constexpr int equations = 6;
  static JointKind kind() {
    return {"fixed", "no relative motion: d = 0, frames parallel", equations, JointEnds<S>::anchors()};
  }
  Fixed(const JointParameters& p, std::span<const BodyStart> starts) : TwoEndedJoint<S, Fixed>(p, starts) {}

  void fill(const JointNow<S>& now, std::span<ConstraintRow<S>> rows) const {
    now.coincide(rows);
    now.parallel(rows.subspan(3));
    rows[5] = now.across(now.axes1.col(1), now.axes2.col(2));
  }
};

}  // namespace polhode::core::joints
