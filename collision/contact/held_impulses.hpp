// SPDX-License-Identifier: BSD-3-Clause
// The impulses of a step as forces that are held through it: both bodies feel, equal and opposite and along one line, the force
// whose time integral is the impulse, so that momentum and angular momentum are left alone. The line goes with the mass centre
// of the two, and with a body that touches what cannot move: a ball that rolls keeps its arm. A body at rest stays at rest
// under any method, which a jump of its velocity before or after the step would not let it.
#pragma once

#include <algorithm>
#include <vector>

#include "collision/contact/contact_losses.hpp"
#include "collision/response.hpp"
#include "core/force.hpp"

namespace polhode {

class HeldImpulses final : public ForceModel<double> {
 public:
  /// `internal`: every body that can touch moves freely, so that total momenta are conserved.
  HeldImpulses(std::size_t bodies, bool internal)
      : internal_(internal), wrenches_(bodies), changes_(bodies, Vector3<double>::Zero()) {}

  void release() {
    if (held_) {
      std::fill(wrenches_.begin(), wrenches_.end(), Wrench<double>{});
      std::fill(changes_.begin(), changes_.end(), Vector3<double>::Zero());
    }
    held_ = false;
  }

  /// From t (s) through a step of h (s); the bodies are where the step starts.
  void hold(std::span<const ImpulseContact> contacts, std::span<const ImpulseBody> bodies, double t, double h) {
    release();
    held_ = !contacts.empty();
    since_ = t;
    for (const ImpulseContact& c : contacts) {
      const Vector3<double> f = c.impulse / h;
      const Vector3<double> torque = c.point.cross(f), change = line_velocity(bodies[c.a], bodies[c.b]).cross(f);
      wrenches_[c.a].force += f;
      wrenches_[c.a].torque += torque;
      changes_[c.a] += change;
      wrenches_[c.b].force -= f;
      wrenches_[c.b].torque -= torque;
      changes_[c.b] -= change;
    }
  }

  void add_wrench(double t, std::span<const BodyMotion<double>> bodies, std::span<Wrench<double>> wrenches) const override {
    if (!held_) return;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      wrenches[i].force += wrenches_[i].force;
      wrenches[i].torque += wrenches_[i].torque + (t - since_) * changes_[i] - bodies[i].position.cross(wrenches_[i].force);
    }
  }

  bool reads_velocity() const override { return false; }
  bool internal() const override { return internal_; }
  Effect effect_on(std::size_t) const override { return {true, std::nullopt}; }

 private:
  bool internal_;
  std::vector<Wrench<double>> wrenches_;   ///< torque about the world's origin, at `since`
  std::vector<Vector3<double>> changes_;   ///< N m/s, of these torques
  double since_ = 0;                       ///< s
  bool held_ = false;
};

}  // namespace polhode
