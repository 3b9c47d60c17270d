// SPDX-License-Identifier: BSD-3-Clause
// Rolling without slip of a disk or a sphere on a plane. The contact point c = p + s − r e lies at the lowest point: e
// = n for a sphere, e = (n − (n·a)a)/|n − (n·a)a| for a disk with the axis a. Both bodies have the same velocity there.
// The part of that equation along the normal is the derivative of the height of c above the plane; the other two are
// not holonomic. Source: Bloch, Nonholonomic Mechanics and Control (2nd ed. 2015), section 1.4.
#pragma once

#include <cmath>

#include "core/joints/joint_ends.hpp"

namespace polhode::inline core::inline joints {

template <class S>
class Rolling final : public JointModel<S> {
 public:
  static JointKind kind() {
    std::vector<Parameter> keys = JointEnds<S>::anchors();
    keys[0].meaning = "center, axes of the first body, from its reference point";
    keys[1].meaning = "a point of the plane, in the world";
    keys[2].meaning = "a point of the plane, axes of the second body";
    keys.push_back({"radius", 0.0, "m", "r", Parameter::Need::required, Parameter::Range::positive});
    keys.push_back({"axis_body", Vector3<double>::Zero(), "", "a, axis of a disk, its axes; 0: a sphere"});
    keys.push_back(
        {"normal", Vector3<double>(0, 0, 1), "", "n, normal of the plane towards the body, world axes at the start"});
    return {"rolling", "a disk or sphere rolls on a plane without slip: equal velocities at the contact point", 3,
            std::move(keys)};
  }

  Rolling(const JointParameters& p, std::span<const BodyStart> starts)
      : first_(p.of.bodies[0]),
        center_(p.of.vector("anchor_body").cast<S>()),
        axis_(p.of.vector("axis_body").cast<S>()),
        disk_(!p.of.vector("axis_body").isZero(0)),
        radius_(S(p.of.number("radius"))),
        point_((p.of.bodies.size() == 2 ? p.of.vector("anchor_body_2") : p.of.vector("anchor_world")).cast<S>()) {
    if (disk_) axis_.normalize();
    Matrix3<double> frame = frame_with(p.of.vector("normal"));
    if (p.of.bodies.size() == 2) {
      second_ = p.of.bodies[1];
      frame = rotation_matrix<double>(starts[*second_].orientation).transpose() * frame;
    }
    frame_ = frame.cast<S>();
  }

  std::size_t first() const override { return first_; }
  std::optional<std::size_t> second() const override { return second_; }
  std::size_t rows() const override { return 3; }

  void evaluate(std::span<const BodyMotion<S>> bodies, std::span<ConstraintRow<S>> rows) const override {
    const Contact c = contact(bodies);
    for (int k = 0; k < 3; ++k) {
      const Vector3<S> t = c.frame.col(k);
      ConstraintRow<S>& row = rows[std::size_t(k)];
      row = {};
      row.holonomic = k == 0;
      if (k == 0) row.residual = t.dot(c.point - c.plane_point);
      row.first = {t, c.x1.cross(t)};
      row.second = {-t, -c.x2.cross(t)};
      row.gamma = -t.dot(c.w1.cross(c.x1_rate) - c.w2.cross(c.x2_rate)) - c.w2.cross(t).dot(c.slip);
    }
  }

  Vector3<S> anchor(std::span<const BodyMotion<S>> bodies) const override { return contact(bodies).point; }

 private:
  /// The contact point on both bodies, world axes.
  struct Contact {
    Matrix3<S> frame;               ///< columns: normal and two tangents, fixed to the plane
    Vector3<S> point, plane_point;  ///< m
    Vector3<S> x1, x2;              ///< lever arms from the reference points, m
    Vector3<S> x1_rate, x2_rate;    ///< m/s
    Vector3<S> w1, w2;              ///< rad/s
    Vector3<S> slip;                ///< velocity of the first body against the second at the contact point, m/s
  };

  Contact contact(std::span<const BodyMotion<S>> bodies) const {
    const BodyMotion<S>& one = bodies[first_];
    BodyMotion<S> two{Vector3<S>::Zero(), Matrix3<S>::Identity(), Vector3<S>::Zero(), Vector3<S>::Zero()};
    if (second_) two = bodies[*second_];
    Contact c;
    c.frame = two.rotation * frame_;
    c.w1 = one.angular_velocity;
    c.w2 = two.angular_velocity;
    const Vector3<S> n = c.frame.col(0);
    Vector3<S> e = n, e_rate = c.w2.cross(n);
    if (disk_) {
      const Vector3<S> a = one.rotation * axis_;
      const Vector3<S> n_rate = e_rate, a_rate = c.w1.cross(a);
      const S k = n.dot(a), k_rate = n_rate.dot(a) + n.dot(a_rate);
      const Vector3<S> m = n - k * a, m_rate = n_rate - k_rate * a - k * a_rate;
      const S length = m.norm();
      e = m / length;
      e_rate = (m_rate - e.dot(m_rate) * e) / length;
    }
    const Vector3<S> s = one.rotation * center_;
    c.x1 = s - radius_ * e;
    c.x1_rate = c.w1.cross(s) - radius_ * e_rate;
    c.point = one.position + c.x1;
    c.plane_point = two.point(point_);
    c.x2 = c.point - two.position;
    c.x2_rate = one.velocity + c.x1_rate - two.velocity;
    c.slip = one.velocity + c.w1.cross(c.x1) - two.velocity - c.w2.cross(c.x2);
    return c;
  }

  std::size_t first_;
  std::optional<std::size_t> second_;
  Vector3<S> center_, axis_;
  bool disk_;
  S radius_;
  Vector3<S> point_;
  Matrix3<S> frame_;  ///< columns: normal and two tangents, axes of the second body or of the world
};

}  // namespace polhode::core::joints
