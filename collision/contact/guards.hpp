// SPDX-License-Identifier: BSD-3-Clause
// The guards of a step: for each near pair its signed distance plus an allowance, whose first zero is an impact; and
// bounds of the guards between two instants at which they were evaluated.
//
// Two bounds prove that a guard stays positive between two evaluations, h apart. First: the distance changes at most at
// the rate L of the points of the two bodies, so that it stays positive if the sum of the values at both ends is more
// than L h. Second: along a fixed direction n, the separation is s(t) = min over A of x·n − max over B of x·n, a lower
// bound of the distance. The accelerations of the points along n are at most a in all, so that s stays above the lower
// of its two end values minus a h²/8. With n the normal at either end, along which Mirtich (Impulse-based Dynamic
// Simulation of Rigid Body Systems, 1996) advances, this term is small even for bodies that pass each other fast.
// Rotation contributes |ω × n| |ω| times a radius to a; for a ball, nothing.
#pragma once

#include <array>

#include "collision/contact/contact_scene.hpp"

namespace polhode::inline collision::inline contact {

/// Tolerances (m), from coarse to fine.
struct ContactLengths {
  explicit ContactLengths(const ContactScene& scene);
  double contact_tolerance;      ///< surfaces closer than this touch
  double allowed_penetration;    ///< a resting pair may sink by this much before it is treated as an impact
  double minimum_bounce_height;  ///< a lower bounce is not simulated
  double met;                    ///< a penetration no deeper than this is ignored
};

class Guards {
 public:
  /// Values of the guards at an instant.
  struct Values {
    double least = 0;  ///< smallest value, m
    std::vector<Pose> poses;
    std::vector<double> values;  ///< distance plus allowance of each pair, positive if it has not met, m
    std::vector<Vector3<double>> normals;
  };

  Guards(const System<double>& system, ContactScene& scene);

  /// Removes all guards.
  void clear() { guards_.clear(); }

  /// Sets guards for the pairs that may meet between the two states. A pair at rest may sink by `deeper` (m) below its
  /// present depth.
  void watch(const State<double>& from, const State<double>& to, std::span<const ImpulseContact> resting,
             double deeper);

  bool empty() const { return guards_.empty(); }
  /// True if some pair touches and separates at the start.
  bool some_leave() const;

  /// The smallest value (m); 1 without guards.
  double least(const State<double>& state);
  void evaluate(const State<double>& state, Values& seen);

  /// True if some guard may become negative between two evaluations, `length` (s) apart, at both of which all guards
  /// are positive.
  bool may_dip(const Values& from, const Values& to, double length) const;

 private:
  struct Guard {
    BodyPair pair;
    double allowance = 0;  ///< depth up to which the pair does not count as met, m
    double speed = 0;      ///< upper bound of the rate of the distance, m/s; 0: not checked between evaluations
    bool leaving = false;  ///< the pair touches and separates at the start
  };
  /// Upper bounds of the acceleration of a body's points.
  struct Pull {
    double steady = 0;  ///< bound for the mass centre, plus the part due to angular acceleration, m/s²
    double radius = 0, rate = 0, turned = 0;  ///< radius, m; largest |ω| at an end, change of ω between them, rad/s
    std::array<Vector3<double>, 2> turning;   ///< angular velocity at both ends, rad/s
    double along(const Vector3<double>& n) const;
  };
  double separation(const Guard& g, const Vector3<double>& normal, std::span<const Pose> poses) const;

  const System<double>& system_;
  ContactScene& scene_;
  ContactLengths lengths_;
  std::vector<Guard> guards_;
  std::vector<Pose> poses_, end_poses_;
  std::vector<ImpulseBody> bodies_, end_;
  std::vector<double> bulge_, speed_;
  std::vector<Pull> pulls_;
};

}  // namespace polhode::collision::contact
