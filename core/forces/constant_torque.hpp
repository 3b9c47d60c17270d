// SPDX-License-Identifier: BSD-3-Clause
// A constant torque, fixed in the world or in the body. It has no potential: its power is τ · ω.
#pragma once

#include "core/problem/force_kind.hpp"

namespace polhode::inline core::inline forces {

template <class S>
class ConstantTorque final : public ForceModel<S> {
 public:
  static ForceKind kind() {
    return {"constant_torque",
            "torque fixed in the world or in the body, power = torque . w",
            1,
            0,
            {{"torque", Vector3<double>(Vector3<double>::Zero()), "N m", "in the axes that frame names",
              Parameter::Need::required},
             {"frame",
              std::string("world"),
              "",
              "axes of the torque",
              Parameter::Need::optional,
              Parameter::Range::any,
              {"world", "body"}}}};
  }

  ConstantTorque(const ForceParameters& p, std::span<const Body>)
      : bodies_(p.bodies), torque_(p.vector("torque").cast<S>()), world_(p.text("frame") == "world") {}

  void add_wrench(S, std::span<const BodyMotion<S>> bodies, std::span<Wrench<S>> wrenches) const override {
    for (const std::size_t i : bodies_) wrenches[i].torque += torque_world(bodies[i]);
  }

  bool does_work() const override { return true; }

  S power(S, std::span<const BodyMotion<S>> bodies) const override {
    S p(0);
    for (const std::size_t i : bodies_) p += torque_world(bodies[i]).dot(bodies[i].angular_velocity);
    return p;
  }

  bool reads_velocity() const override { return false; }

  Effect effect_on(std::size_t body) const override {
    for (const std::size_t i : bodies_) {
      if (i == body) return {true, Vector3<double>::Zero()};
    }
    return {};
  }

 private:
  Vector3<S> torque_world(const BodyMotion<S>& body) const {
    return world_ ? torque_ : Vector3<S>(body.rotation * torque_);
  }

  std::vector<std::size_t> bodies_;
  Vector3<S> torque_;
  bool world_;
};

}  // namespace polhode::core::forces
