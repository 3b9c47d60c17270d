// SPDX-License-Identifier: BSD-3-Clause
// Newton's gravity between the mass centres of two bodies: f = G m1 m2 d/|d|³, V = −G m1 m2/|d|.
#pragma once

#include <cmath>

#include "core/problem/force_kind.hpp"

namespace polhode::inline core::inline forces {

template <class S>
class PointGravity final : public ForceModel<S> {
 public:
  static ForceKind kind() {
    return {"point_gravity",
            "f = G m1 m2 d/|d|^3 between two mass centres, V = -G m1 m2/|d|",
            2,
            2,
            {{"gravitational_constant", 6.6743e-11, "m^3/(kg s^2)", "G"}}};
  }

  PointGravity(const ForceParameters& p, std::span<const Body> bodies)
      : a_(p.bodies[0]),
        b_(p.bodies[1]),
        strength_(S(p.number("gravitational_constant") * bodies[a_].mass * bodies[b_].mass)),
        center_a_(bodies[a_].center_of_mass.cast<S>()),
        center_b_(bodies[b_].center_of_mass.cast<S>()),
        offset_(bodies[a_].pinned || bodies[b_].pinned),
        both_free_(!offset_ && !bodies[a_].fixed && !bodies[b_].fixed) {}

  void add_wrench(S, std::span<const BodyMotion<S>> bodies, std::span<Wrench<S>> wrenches) const override {
    using std::sqrt;
    const Vector3<S> pa = center(bodies[a_], center_a_), pb = center(bodies[b_], center_b_);
    const Vector3<S> d = pb - pa;
    const S r2 = d.squaredNorm();
    const Vector3<S> f = d * (strength_ / (r2 * sqrt(r2)));
    if (!offset_) {
      wrenches[a_].force += f;
      wrenches[b_].force -= f;
    } else {
      wrenches[a_].add_at_point(bodies[a_], pa, f);
      wrenches[b_].add_at_point(bodies[b_], pb, -f);
    }
  }

  S potential_energy(std::span<const BodyMotion<S>> bodies) const override {
    using std::sqrt;
    return -strength_ / sqrt((center(bodies[b_], center_b_) - center(bodies[a_], center_a_)).squaredNorm());
  }

  bool internal() const override { return both_free_; }
  bool reads_rotation() const override { return offset_; }

  bool reads_velocity() const override { return false; }

  Effect effect_on(std::size_t body) const override {
    if (body == a_) return {!center_a_.isZero(0), std::nullopt};
    if (body == b_) return {!center_b_.isZero(0), std::nullopt};
    return {};
  }

 private:
  Vector3<S> center(const BodyMotion<S>& body, const Vector3<S>& offset) const {
    return offset_ ? body.point(offset) : body.position;
  }

  std::size_t a_, b_;
  S strength_;
  Vector3<S> center_a_, center_b_;
  bool offset_, both_free_;
};

}  // namespace polhode::core::forces
