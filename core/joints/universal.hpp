// SPDX-License-Identifier: BSD-3-Clause
// A universal joint: the anchors coincide and an axis of the first body stays perpendicular to an axis of the second,
// d = 0, a₁·a₂ = 0.
#pragma once

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Universal final : public TwoEndedJoint<S, Universal<S>> {
 public:
  static constexpr int equations = 4;
  static JointKind kind() {
    std::vector<Parameter> keys = JointEnds<S>::anchors_and_axis("a1, axis of the cross on the first body, its axes");
    keys.push_back({"axis_body_2", Vector3<double>::Zero(), "",
                    "a2, axis of the cross on the second body, its axes; in the world with one body",
                    Parameter::Need::required});
    return {"universal", "rotation about two perpendicular axes: d = 0, a1.a2 = 0", equations, std::move(keys)};
  }
  Universal(const JointParameters& p, std::span<const BodyStart> starts)
      : TwoEndedJoint<S, Universal>(p, starts), axis2_(p.of.vector("axis_body_2").normalized().cast<S>()) {}

  void fill(const JointNow<S>& now, std::span<ConstraintRow<S>> rows) const {
    now.coincide(rows);
    rows[3] = now.across(now.axes1.col(0), Vector3<S>(now.turn2 * axis2_));
  }

 private:
  Vector3<S> axis2_;
};

}  // namespace polhode::core::joints
