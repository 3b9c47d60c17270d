// SPDX-License-Identifier: BSD-3-Clause
// Uniform gravity: f = m g at the mass centre, V = −m g · p.
#pragma once

#include <algorithm>

#include "core/problem/force_kind.hpp"

namespace polhode::inline core::inline forces {

template <class S>
class UniformGravity final : public ForceModel<S> {
 public:
  static ForceKind kind() {
    return {"uniform_gravity",
            "f = m g at the mass centre, V = -m g . p",
            1,
            0,
            {{"acceleration", Vector3<double>(0, 0, -9.81), "m/s^2", "g, world axes", Parameter::Need::required}}};
  }

  UniformGravity(const ForceParameters& p, std::span<const Body> bodies)
      : acceleration_(p.vector("acceleration").cast<S>()), acceleration_double_(p.vector("acceleration")) {
    for (const std::size_t i : p.bodies) {
      const Body& b = bodies[i];
      if (!b.fixed) loads_.push_back({i, S(b.mass), b.center_of_mass.cast<S>(), b.pinned, effect(b)});
    }
  }

  void add_wrench(S, std::span<const BodyMotion<S>> bodies, std::span<Wrench<S>> wrenches) const override {
    for (const Load& load : loads_) {
      const Vector3<S> f = load.mass * acceleration_;
      wrenches[load.body].force += f;
      if (load.pinned) wrenches[load.body].torque += (bodies[load.body].rotation * load.center).cross(f);
    }
  }

  S potential_energy(std::span<const BodyMotion<S>> bodies) const override {
    S v(0);
    for (const Load& load : loads_) {
      v -= load.mass *
           acceleration_.dot(load.pinned ? bodies[load.body].point(load.center) : bodies[load.body].position);
    }
    return v;
  }

  bool reads_rotation() const override {
    return std::any_of(loads_.begin(), loads_.end(), [](const Load& load) { return load.pinned; });
  }

  bool reads_velocity() const override { return false; }

  Effect effect_on(std::size_t body) const override {
    for (const Load& load : loads_) {
      if (load.body != body) continue;
      return load.effect;
    }
    return {};
  }

 private:
  struct Load {
    std::size_t body;
    S mass;
    Vector3<S> center;
    bool pinned;
    Effect effect;
  };
  Effect effect(const Body& b) const {
    return {b.pinned && !b.center_of_mass.isZero(0), b.mass * acceleration_double_};
  }
  Vector3<S> acceleration_;
  Vector3<double> acceleration_double_;
  std::vector<Load> loads_;
};

}  // namespace polhode::core::forces
