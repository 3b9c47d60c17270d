// SPDX-License-Identifier: BSD-3-Clause
// A constant force at a point of a body. Fixed in the world it has the potential V = −f · p_point; fixed in the body
// (a thruster) it has none and its work is accounted for.
#pragma once

#include "core/problem/force_kind.hpp"

namespace polhode::inline core::inline forces {

template <class S>
class ConstantForce final : public ForceModel<S> {
 public:
  static ForceKind kind() {
    const Vector3<double> zero = Vector3<double>::Zero();
    return {"constant_force",
            "f fixed in the world (V = -f . p) or in the body, at a point of the body",
            1,
            0,
            {{"force", zero, "N", "f, in the axes that frame names", Parameter::Need::required},
             {"frame",
              std::string("world"),
              "",
              "axes of f",
              Parameter::Need::optional,
              Parameter::Range::any,
              {"world", "body"}},
             {"anchor_body", zero, "m", "where it acts, body axes, from the reference point"}}};
  }

  ConstantForce(const ForceParameters& p, std::span<const Body>)
      : bodies_(p.bodies),
        force_(p.vector("force").cast<S>()),
        anchor_(p.vector("anchor_body").cast<S>()),
        world_(p.text("frame") == "world"),
        off_center_(!p.vector("anchor_body").isZero(0)),
        force_double_(p.vector("force")) {}

  void add_wrench(S, std::span<const BodyMotion<S>> bodies, std::span<Wrench<S>> wrenches) const override {
    for (const std::size_t i : bodies_) {
      wrenches[i].add_at_point(bodies[i], bodies[i].point(anchor_), force_world(bodies[i]));
    }
  }

  S potential_energy(std::span<const BodyMotion<S>> bodies) const override {
    S v(0);
    if (world_) {
      for (const std::size_t i : bodies_) v -= force_.dot(bodies[i].point(anchor_));
    }
    return v;
  }

  bool does_work() const override { return !world_; }

  S power(S, std::span<const BodyMotion<S>> bodies) const override {
    S p(0);
    if (!world_) {
      for (const std::size_t i : bodies_) {
        p += force_world(bodies[i]).dot(bodies[i].point_velocity(bodies[i].point(anchor_)));
      }
    }
    return p;
  }

  bool reads_velocity() const override { return false; }

  Effect effect_on(std::size_t body) const override {
    for (const std::size_t i : bodies_) {
      if (i != body) continue;
      if (world_) return {off_center_, force_double_};
      return {off_center_, std::nullopt};
    }
    return {};
  }

 private:
  Vector3<S> force_world(const BodyMotion<S>& body) const {
    return world_ ? force_ : Vector3<S>(body.rotation * force_);
  }

  std::vector<std::size_t> bodies_;
  Vector3<S> force_, anchor_;
  bool world_, off_center_;
  Vector3<double> force_double_;
};

}  // namespace polhode::core::forces
