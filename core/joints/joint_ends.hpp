// SPDX-License-Identifier: BSD-3-Clause
// The two ends of a joint: an anchor and, for joints with axes, a frame on the first body and on the second body or the
// world. The frame (n, u, v) of the second end is that of the first at the start. The functions below are the equations
// from which the kinds of joints are put together.
//
// Notation: x₁ = p₁ + r₁ is the anchor on the first body, r₁ = R₁ s₁; likewise x₂ = p₂ + r₂; d = x₁ − x₂.
// The derivatives follow from dr/dt = ω × r. Source: Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems
// (1989), chapter 9, in the notation above.
#pragma once

#include <optional>
#include <vector>

#include "core/math/flatten.hpp"
#include "core/problem/joint_kind.hpp"

namespace polhode::inline core::inline joints {

/// Right-handed orthonormal frame (n, u, v) with n along the axis, as columns.
inline Matrix3<double> frame_with(const Vector3<double>& axis) {
  Matrix3<double> frame;
  frame.col(0) = axis.normalized();
  frame.col(1) = frame.col(0).unitOrthogonal();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

/// The end to which a direction is fixed.
enum class JointEnd { world, first, second };

/// Anchors, axes and motions of the two ends at one instant, world axes.
template <class S>
struct JointNow {
  Vector3<S> r1, r2;   ///< anchors from the reference points, m
  Vector3<S> d, rate;  ///< x₁ − x₂, m, and its rate, m/s
  Vector3<S> centripetal;  ///< acceleration of d for v̇ = 0, ω̇ = 0: ω₁ × (ω₁ × r₁) − ω₂ × (ω₂ × r₂), m/s²
  Vector3<S> w1, w2;        ///< angular velocities, rad/s
  Matrix3<S> axes1, axes2;  ///< columns n, u, v of the frames of the two ends
  Matrix3<S> turn2;         ///< rotation of the second body; of the world: identity

  /// g = e·d for a direction e that is fixed to one of the ends.
  ConstraintRow<S> along(const Vector3<S>& e, JointEnd fixed_to) const {
    ConstraintRow<S> row;
    row.residual = e.dot(d);
    row.first = {e, r1.cross(e)};
    row.second = {-e, -r2.cross(e)};
    row.gamma = -e.dot(centripetal);
    if (fixed_to != JointEnd::world) {
      const Vector3<S>& w = fixed_to == JointEnd::first ? w1 : w2;
      (fixed_to == JointEnd::first ? row.first : row.second).torque += e.cross(d);
      const Vector3<S> e_rate = w.cross(e);
      row.gamma -= S(2) * e_rate.dot(rate) + w.cross(e_rate).dot(d);
    }
    return row;
  }

  /// g = a·b for a direction a fixed to the first end and b fixed to the second.
  ConstraintRow<S> across(const Vector3<S>& a, const Vector3<S>& b) const {
    ConstraintRow<S> row;
    row.angular = true;
    row.residual = a.dot(b);
    const Vector3<S> c = a.cross(b);
    row.first.torque = c;
    row.second.torque = -c;
    row.gamma = -(w1 - w2).dot(w1.cross(a).cross(b) + a.cross(w2.cross(b)));
    return row;
  }

  /// The anchors coincide: rows 0 to 2.
  void coincide(std::span<ConstraintRow<S>> rows) const {
    rows[0] = along(Vector3<S>::UnitX(), JointEnd::world);
    rows[1] = along(Vector3<S>::UnitY(), JointEnd::world);
    rows[2] = along(Vector3<S>::UnitZ(), JointEnd::world);
  }
  /// The axes n of the two ends are parallel: rows 0 and 1.
  void parallel(std::span<ConstraintRow<S>> rows) const {
    rows[0] = across(axes1.col(0), axes2.col(1));
    rows[1] = across(axes1.col(0), axes2.col(2));
  }
};

template <class S>
class JointEnds {
 public:
  /// The keys of the anchors, which every joint has.
  static std::vector<Parameter> anchors() {
    const Vector3<double> zero = Vector3<double>::Zero();
    const auto optional = Parameter::Need::optional;
    const auto any = Parameter::Range::any;
    return {{"anchor_body", zero, "m", "anchor on the first body, its axes, from its reference point"},
            {"anchor_world", zero, "m", "anchor in the world", optional, any, {}, 1},
            {"anchor_body_2", zero, "m", "anchor on the second body, its axes", optional, any, {}, 2}};
  }
  /// The keys of the anchors and of the axis.
  static std::vector<Parameter> anchors_and_axis(std::string meaning) {
    std::vector<Parameter> keys = anchors();
    keys.push_back({"axis_body", Vector3<double>::Zero(), "", std::move(meaning), Parameter::Need::required});
    return keys;
  }

  JointEnds(const JointParameters& p, std::span<const BodyStart> starts) : first_(p.of.bodies[0]) {
    const Matrix3<double> turn1 = rotation_matrix<double>(starts[first_].orientation);
    Matrix3<double> turn2 = Matrix3<double>::Identity();
    Vector3<double> far = p.of.vector("anchor_world");
    if (p.of.bodies.size() == 2) {
      second_ = p.of.bodies[1];
      turn2 = rotation_matrix<double>(starts[*second_].orientation);
      far = p.of.vector("anchor_body_2");
    }
    Matrix3<double> frame = Matrix3<double>::Identity();
    if (const auto axis = p.of.values.find("axis_body"); axis != p.of.values.end()) {
      frame = frame_with(std::get<Vector3<double>>(axis->second));
    }
    axes1_ = frame.cast<S>();
    axes2_ = (turn2.transpose() * turn1 * frame).template cast<S>();
    anchor1_ = p.of.vector("anchor_body").template cast<S>();
    anchor2_ = far.cast<S>();
  }

  std::size_t first() const { return first_; }
  std::optional<std::size_t> second() const { return second_; }
  Vector3<S> anchor(std::span<const BodyMotion<S>> bodies) const { return bodies[first_].point(anchor1_); }

  /// `with_axes`: the frames too.
  template <bool with_axes>
  JointNow<S> now(std::span<const BodyMotion<S>> bodies) const {
    JointNow<S> j;
    const BodyMotion<S>& one = bodies[first_];
    j.r1 = one.rotation * anchor1_;
    j.w1 = one.angular_velocity;
    const Vector3<S> turned = j.w1.cross(j.r1);
    if constexpr (with_axes) j.axes1 = one.rotation * axes1_;
    j.d = one.position + j.r1;
    j.rate = one.velocity + turned;
    j.centripetal = j.w1.cross(turned);
    if (second_) {
      const BodyMotion<S>& two = bodies[*second_];
      j.r2 = two.rotation * anchor2_;
      j.w2 = two.angular_velocity;
      const Vector3<S> turned2 = j.w2.cross(j.r2);
      j.turn2 = two.rotation;
      if constexpr (with_axes) j.axes2 = j.turn2 * axes2_;
      j.d -= two.position + j.r2;
      j.rate -= two.velocity + turned2;
      j.centripetal -= j.w2.cross(turned2);
    } else {
      j.r2 = anchor2_;
      j.w2.setZero();
      j.turn2.setIdentity();
      j.axes2 = axes2_;
      j.d -= anchor2_;
    }
    return j;
  }

 private:
  std::size_t first_;
  std::optional<std::size_t> second_;
  Vector3<S> anchor1_, anchor2_;
  Matrix3<S> axes1_, axes2_;  ///< the frame (n, u, v) in the axes of each body; n = x for joints without an axis
};

/// A joint whose equations are functions of its two ends: `Derived` fills them in `fill(now, rows)`, and states their
/// number in its kind().
template <class S, class Derived>
class TwoEndedJoint : public JointModel<S> {
 public:
  static constexpr bool has_axes = true;  ///< false in a kind that does not read the frames

  TwoEndedJoint(const JointParameters& p, std::span<const BodyStart> starts) : ends_(p, starts) {}

  std::size_t first() const final { return ends_.first(); }
  std::optional<std::size_t> second() const final { return ends_.second(); }
  std::size_t rows() const final { return Derived::equations; }
  POLHODE_FLATTEN void evaluate(std::span<const BodyMotion<S>> bodies, std::span<ConstraintRow<S>> rows) const final {
    static_cast<const Derived*>(this)->fill(ends_.template now<Derived::has_axes>(bodies), rows);
  }
  Vector3<S> anchor(std::span<const BodyMotion<S>> bodies) const final { return ends_.anchor(bodies); }

 protected:
  const JointEnds<S>& ends() const { return ends_; }

 private:
  JointEnds<S> ends_;
};

}  // namespace polhode::core::joints
