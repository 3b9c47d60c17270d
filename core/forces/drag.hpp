// SPDX-License-Identifier: BSD-3-Clause
// Drag of a resting medium: f = −(c1 + c2 |v|) v at the reference point, τ = −c3 ω.
#pragma once

#include <cmath>

#include "core/problem/force_kind.hpp"

namespace polhode::inline core::inline forces {

template <class S>
class Drag final : public ForceModel<S> {
 public:
  static ForceKind kind() {
    using enum Parameter::Need;
    using enum Parameter::Range;
    return {"drag",
            "f = -(c1 + c2 |v|) v, torque = -c3 w",
            1,
            0,
            {{"linear", 0.0, "N s/m", "c1", optional, non_negative},
             {"quadratic", 0.0, "N s^2/m^2", "c2", optional, non_negative},
             {"angular", 0.0, "N m s", "c3", optional, non_negative}}};
  }

  Drag(const ForceParameters& p, std::span<const Body>)
      : bodies_(p.bodies),
        linear_(S(p.number("linear"))),
        quadratic_(S(p.number("quadratic"))),
        angular_(S(p.number("angular"))),
        has_quadratic_(p.number("quadratic") != 0),
        has_angular_(p.number("angular") != 0) {}

  void add_wrench(S, std::span<const BodyMotion<S>> bodies, std::span<Wrench<S>> wrenches) const override {
    for (const std::size_t i : bodies_) {
      wrenches[i].force -= coefficient(bodies[i]) * bodies[i].velocity;
      wrenches[i].torque -= angular_ * bodies[i].angular_velocity;
    }
  }

  bool does_work() const override { return true; }

  S power(S, std::span<const BodyMotion<S>> bodies) const override {
    S p(0);
    for (const std::size_t i : bodies_) {
      p -= coefficient(bodies[i]) * bodies[i].velocity.squaredNorm() +
           angular_ * bodies[i].angular_velocity.squaredNorm();
    }
    return p;
  }

  Effect effect_on(std::size_t body) const override {
    for (const std::size_t i : bodies_) {
      if (i == body) return {has_angular_, std::nullopt};
    }
    return {};
  }

 private:
  S coefficient(const BodyMotion<S>& body) const {
    using std::sqrt;
    return has_quadratic_ ? linear_ + quadratic_ * sqrt(body.velocity.squaredNorm()) : linear_;
  }

  std::vector<std::size_t> bodies_;
  S linear_, quadratic_, angular_;
  bool has_quadratic_, has_angular_;
};

}  // namespace polhode::core::forces
