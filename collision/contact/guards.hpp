// SPDX-License-Identifier: BSD-3-Clause
// The guards of a flight: of each near pair its signed distance, above an allowance, whose first zero is an impact; and
// what they may do between two instants at which they were looked at.
//
// Two bounds say that a guard stays positive between two looks, h apart. The distance changes no faster than the two
// bodies' points, at L in all: it stays so where the values at both ends are more than L h together. Along a fixed
// direction n, A is beyond B by s(t) = min over A of x·n − max over B of x·n, never more than the distance; along n the
// points' accelerations are at most a in all, so that s stays above the lower of its values at both ends less a h²/8.
// With n the normal at either end, which Mirtich (Impulse-based Dynamic Simulation of Rigid Body Systems, 1996)
// advances along, that is next to nothing for bodies that skim past each other, however fast. What turning does along n
// is |ω × n| |ω| times a radius; of a ball nothing.
#pragma once

#include <array>

#include "collision/contact/contact_scene.hpp"

namespace polhode::inline collision {

/// m: what counts as near, from coarse to fine.
struct ContactLengths {
  explicit ContactLengths(const ContactScene& scene);
  double contact_tolerance;      ///< surfaces closer than this touch
  double allowed_penetration;    ///< a resting pair may sink by this much before it is treated as an impact
  double minimum_bounce_height;  ///< a lower bounce is not simulated
  double met;                    ///< a penetration no deeper than this is ignored
};

class Guards {
 public:
  /// What is seen of the guards at an instant.
  struct Look {
    double least = 0;  ///< m, of all values
    std::vector<Pose> poses;
    std::vector<double> values;  ///< m: positive where the pair has not met
    std::vector<Vector3<double>> normals;
  };

  Guards(const System<double>& system, ContactScene& scene);

  /// Guards nothing.
  void clear() { guards_.clear(); }

  /// The pairs that may meet on the way from one state to the other. A pair that rests may sink by `deeper` (m) from
  /// where it is.
  void watch(const State<double>& from, const State<double>& to, std::span<const ImpulseContact> resting,
             double deeper);

  bool empty() const { return guards_.empty(); }
  /// Whether some pair touches and comes apart where the flight starts.
  bool some_leave() const;

  /// m: the least value; 1 without guards.
  double least(const State<double>& state);
  void look(const State<double>& state, Look& seen);

  /// Whether some guard may be negative between two looks, `length` (s) apart, at both of which all are positive.
  bool may_dip(const Look& from, const Look& to, double length) const;

 private:
  struct Guard {
    BodyPair pair;
    double allowance = 0;  ///< m: the pair may be as deep before it counts
    double speed = 0;      ///< m/s, at most, of what its distance changes by; 0: not looked at between
    bool leaving = false;  ///< it touches and comes apart where the flight starts
  };
  /// How fast a body's points are accelerated, at most.
  struct Pull {
    double steady = 0;                        ///< m/s²: of its centre, and by the change of its turning
    double radius = 0, rate = 0, turned = 0;  ///< m, rad/s at most, rad/s between the ends
    std::array<Vector3<double>, 2> turning;   ///< rad/s, at both ends
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

}  // namespace polhode
