// SPDX-License-Identifier: BSD-3-Clause
// A massless rod: the anchors keep their distance, |d| = l. With n = d/|d|: dg/dt = n·ḋ.
#pragma once

#include <cmath>

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Distance final : public TwoEndedJoint<S, Distance<S>> {
 public:
  static constexpr int equations = 1;
  static constexpr bool has_axes = false;
  static JointKind kind() {
    std::vector<Parameter> keys = JointEnds<S>::anchors();
    keys.push_back({"length", 0.0, "m", "l; 0: the distance at the start", Parameter::Need::optional,
                    Parameter::Range::non_negative});
    return {"distance", "two anchors keep their distance: |d| = l", equations, std::move(keys)};
  }
  Distance(const JointParameters& p, std::span<const BodyStart> starts)
      : TwoEndedJoint<S, Distance>(p, starts), length_(S(p.of.number("length"))) {
    if (p.of.number("length") == 0) length_ = S(start_distance(p, starts));
  }

  void fill(const JointNow<S>& now, std::span<ConstraintRow<S>> rows) const {
    const S length = now.d.norm();
    const Vector3<S> n = now.d / length;
    ConstraintRow<S>& row = rows[0];
    row = now.along(n, JointEnd::world);
    row.residual = length - length_;
    const S radial = n.dot(now.rate);
    row.gamma -= (now.rate.squaredNorm() - radial * radial) / length;
  }

 private:
  static double start_distance(const JointParameters& p, std::span<const BodyStart> starts) {
    const JointEnds<double> ends(p, starts);
    std::vector<BodyMotion<double>> bodies;
    for (const BodyStart& s : starts) {
      bodies.push_back(
          {s.position, rotation_matrix<double>(s.orientation), Vector3<double>::Zero(), Vector3<double>::Zero()});
    }
    return ends.now<false>(bodies).d.norm();
  }

  S length_;
};

}  // namespace polhode::core::joints
