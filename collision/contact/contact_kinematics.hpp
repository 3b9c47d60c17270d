// SPDX-License-Identifier: BSD-3-Clause
// Contact kinematics at an instant: contact points, approach speeds, and normal accelerations without contact forces.
#pragma once

#include <span>
#include <vector>

#include "collision/contact/guards.hpp"

namespace polhode::inline collision::inline contact {

constexpr double speed_round_off = 1e-11;  ///< round-off of the velocity of a resting contact, m/s

/// Velocity of A relative to B at the contact point, world axes, m/s.
Vector3<double> relative_velocity(std::span<const ImpulseBody> bodies, const ImpulseContact& c);

/// Contact kinematics of a scene. System and scene must outlive this object.
class ContactKinematics {
 public:
  ContactKinematics(const System<double>& system, ContactScene& scene, const ContactLengths& lengths)
      : system_(system), scene_(scene), lengths_(lengths) {}

  /// The contact points at this state, with the approach speed (m/s) filled in. Replaces the near pairs of the scene.
  /// The result is valid until the next call.
  std::span<ImpulseContact> touching(const State<double>& state);

  /// Computes the accelerations of the bodies by a difference quotient of the velocities along the ODE. Call it after
  /// touching() with the same state, while no constant contact forces act.
  void measure_accelerations(const State<double>& state);

  /// Normal component of the acceleration of A relative to B at the contact point, m/s².
  double normal_acceleration(const ImpulseContact& c) const;

  /// Upper speed limit of a resting contact, m/s. A contact that approaches faster is an impact. A contact that
  /// separates faster rises above the minimum bounce height against the normal acceleration.
  double resting_speed(const ImpulseContact& c) const;

  /// The bodies at the state of the last touching().
  const std::vector<ImpulseBody>& bodies() const { return bodies_; }

 private:
  const System<double>& system_;
  ContactScene& scene_;
  const ContactLengths& lengths_;
  std::vector<Pose> poses_;
  std::vector<ImpulseBody> bodies_, rates_;  ///< rates_ stores accelerations instead of velocities
  VectorX<double> rate_, later_;
};

}  // namespace polhode::collision::contact
