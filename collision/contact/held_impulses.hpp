// SPDX-License-Identifier: BSD-3-Clause
// The impulses of a step as forces that are held through it: each body feels, along lines that stand still in the world, the
// force whose time integral is its impulse. Equal and opposite ones leave momentum and angular momentum alone, and a body
// at rest stays at rest under any method, which a jump of its velocity before or after the step would not let it.
#pragma once

#include <algorithm>
#include <vector>

#include "collision/response.hpp"
#include "core/force.hpp"

namespace polhode {

class HeldImpulses final : public ForceModel<double> {
 public:
  explicit HeldImpulses(std::size_t bodies) : wrenches_(bodies) {}

  void release() {
    if (held_) std::fill(wrenches_.begin(), wrenches_.end(), Wrench<double>{});
    held_ = false;
  }

  /// Through a step of `h` seconds.
  void hold(std::span<const ImpulseContact> contacts, double h) {
    release();
    held_ = !contacts.empty();
    for (const ImpulseContact& c : contacts) {
      const Vector3<double> f = c.impulse / h, torque = c.point.cross(f);
      wrenches_[c.a].force += f;
      wrenches_[c.a].torque += torque;
      wrenches_[c.b].force -= f;
      wrenches_[c.b].torque -= torque;
    }
  }

  void add_wrench(double, std::span<const BodyMotion<double>> bodies, std::span<Wrench<double>> wrenches) const override {
    if (!held_) return;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      wrenches[i].force += wrenches_[i].force;
      wrenches[i].torque += wrenches_[i].torque - bodies[i].position.cross(wrenches_[i].force);
    }
  }

  bool reads_velocity() const override { return false; }
  Effect effect_on(std::size_t) const override { return {true, std::nullopt}; }

 private:
  std::vector<Wrench<double>> wrenches_;  ///< torque about the world's origin
  bool held_ = false;
};

}  // namespace polhode
