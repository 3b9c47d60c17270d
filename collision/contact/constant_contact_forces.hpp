// SPDX-License-Identifier: BSD-3-Clause
// The impulses of a step as forces that are constant during the step. Both bodies get the force whose time integral is
// the impulse, equal and opposite and along one line, so that momentum and angular momentum are conserved. The line of
// action moves with the mass centre of the two bodies, or with the one body that moves if the other is static: a
// rolling ball keeps its lever arm about the contact. A body at rest stays at rest under any method; with a jump of its
// velocity before or after the step it would not.
#pragma once

#include <vector>

#include "collision/contact/contact_losses.hpp"
#include "collision/response.hpp"
#include "core/problem/force.hpp"

namespace polhode::inline collision::inline contact {

class ConstantContactForces final : public ForceModel<double> {
 public:
  /// `internal`: every body with a shape moves freely, so that total momenta are conserved.
  explicit ConstantContactForces(bool internal) : internal_(internal) {}

  void release() { pairs_.clear(); }

  /// Applies the impulses during a step of h (s); the bodies are at the start of the step.
  void hold(std::span<const ImpulseContact> contacts, std::span<const ImpulseBody> bodies, double h) {
    release();
    for (const ImpulseContact& c : contacts) {
      const ImpulseBody &a = bodies[c.a], &b = bodies[c.b];
      if (pairs_.empty() || pairs_.back().a != c.a || pairs_.back().b != c.b)
        pairs_.push_back({c.a, c.b, line_share(a, b)});
      Pair& p = pairs_.back();
      const Vector3<double> f = c.impulse / h;
      p.force += f;
      p.torque += (c.point - (p.share * a.position + (1 - p.share) * b.position)).cross(f);
    }
  }

  void add_wrench(double, std::span<const BodyMotion<double>> bodies,
                  std::span<Wrench<double>> wrenches) const override {
    for (const Pair& p : pairs_) {
      const Vector3<double> from_b_to_a = bodies[p.a].position - bodies[p.b].position;
      wrenches[p.a].force += p.force;
      wrenches[p.a].torque += p.torque - (1 - p.share) * from_b_to_a.cross(p.force);
      wrenches[p.b].force -= p.force;
      wrenches[p.b].torque -= p.torque + p.share * from_b_to_a.cross(p.force);
    }
  }

  bool reads_velocity() const override { return false; }
  bool internal() const override { return internal_; }
  Effect effect_on(std::size_t) const override { return {true, std::nullopt}; }

 private:
  struct Pair {
    std::uint32_t a, b;
    double share;                                      ///< weight of A in the point that moves with the line of action
    Vector3<double> force = Vector3<double>::Zero();   ///< force on A, N
    Vector3<double> torque = Vector3<double>::Zero();  ///< torque on A about that point, N m
  };
  bool internal_;
  std::vector<Pair> pairs_;
};

}  // namespace polhode::collision::contact
