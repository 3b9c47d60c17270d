// SPDX-License-Identifier: BSD-3-Clause
// The two ends of a spring or a damper: a point of a body, and a point of the world or of a second body.
#pragma once

#include <vector>

#include "core/problem/force_kind.hpp"

namespace polhode::inline core::inline forces {

template <class S>
class Attachment {
 public:
  /// The keys that every force with two ends has.
  static std::vector<Parameter> parameters() {
    const Vector3<double> zero = Vector3<double>::Zero();
    return {{"anchor_body", zero, "m", "end on the first body, its axes, from its reference point"},
            {"anchor_world", zero, "m", "end in the world", Parameter::Need::optional, Parameter::Range::any, {}, 1},
            {"anchor_body_2",
             zero,
             "m",
             "end on the second body, its axes",
             Parameter::Need::optional,
             Parameter::Range::any,
             {},
             2}};
  }

  Attachment(const ForceParameters& p, std::span<const Body> bodies)
      : body_(p.bodies[0]),
        anchor_(p.vector("anchor_body").cast<S>()),
        off_center_(!p.vector("anchor_body").isZero(0)) {
    if (p.bodies.size() == 2) {
      other_ = p.bodies[1];
      far_ = p.vector("anchor_body_2").cast<S>();
      two_ = true;
      off_center_2_ = !p.vector("anchor_body_2").isZero(0);
      internal_ = !bodies[body_].pinned && !bodies[body_].fixed && !bodies[other_].pinned && !bodies[other_].fixed;
    } else {
      far_ = p.vector("anchor_world").cast<S>();
    }
  }

  /// Vector (m, world) from the end on the first body to the other end, and its rate of change (m/s).
  struct Span {
    Vector3<S> from, to, d;
  };
  Span span(std::span<const BodyMotion<S>> bodies) const {
    Span s;
    s.from = off_center_ ? bodies[body_].point(anchor_) : bodies[body_].position;
    s.to = two_ ? bodies[other_].point(far_) : far_;
    s.d = s.to - s.from;
    return s;
  }
  Vector3<S> rate(const Span& s, std::span<const BodyMotion<S>> bodies) const {
    const Vector3<S> v = bodies[body_].point_velocity(s.from);
    return two_ ? Vector3<S>(bodies[other_].point_velocity(s.to) - v) : Vector3<S>(-v);
  }

  /// Applies f to the first body and −f to the second.
  void apply(const Span& s, const Vector3<S>& f, std::span<const BodyMotion<S>> bodies,
             std::span<Wrench<S>> wrenches) const {
    if (off_center_) {
      wrenches[body_].add_at_point(bodies[body_], s.from, f);
    } else {
      wrenches[body_].force += f;
    }
    if (two_) wrenches[other_].add_at_point(bodies[other_], s.to, -f);
  }

  /// Fast path for the commonest case, from the reference point of one body to a point of the world: in a step of one
  /// body each load and store counts.
  bool one_center() const { return !two_ && !off_center_; }
  Vector3<S> from_center(std::span<const BodyMotion<S>> bodies) const { return far_ - bodies[body_].position; }
  void apply_at_center(const Vector3<S>& f, std::span<Wrench<S>> wrenches) const { wrenches[body_].force += f; }

  bool internal() const { return internal_; }
  bool reads_rotation() const { return off_center_ || two_; }

  Effect effect_on(std::size_t body) const {
    if (body == body_) return {off_center_, std::nullopt};
    if (two_ && body == other_) return {off_center_2_, std::nullopt};
    return {};
  }

 private:
  std::size_t body_, other_ = 0;
  Vector3<S> anchor_, far_;
  bool two_ = false, off_center_ = false, off_center_2_ = false, internal_ = false;
};

}  // namespace polhode::core::forces
