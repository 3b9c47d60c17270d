// SPDX-License-Identifier: BSD-3-Clause
// A response on trial: scenes for it, and the results.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <ostream>

#include "tests/laws/impulse_scenes.hpp"

namespace polhode {

inline void PrintTo(const ResponseEntry& e, std::ostream* out) { *out << e.name; }

namespace laws {

/// The effect of a contact, in its own axes.
struct Seen {
  double normal_impulse, normal_velocity;
  Vector3<double> friction, slip;

  Seen(const ImpulseScene& s, const ImpulseContact& c)
      : normal_impulse(c.impulse.dot(c.normal)),
        normal_velocity(c.normal.dot(s.relative(c))),
        friction(c.impulse - normal_impulse * c.normal),
        slip(s.relative(c) - normal_velocity * c.normal) {}
};

/// The largest difference of two scenes' velocities.
inline double difference(const ImpulseScene& s, const ImpulseScene& t) {
  double most = 0;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    most = std::max({most, (s.bodies[i].velocity - t.bodies[i].velocity).norm(),
                     (s.bodies[i].angular_velocity - t.bodies[i].angular_velocity).norm()});
  }
  return most;
}

inline bool finite(const ImpulseScene& s) {
  return std::all_of(s.bodies.begin(), s.bodies.end(),
                     [](const ImpulseBody& b) {
                       return b.velocity.allFinite() && b.angular_velocity.allFinite() && b.shift.allFinite() &&
                              b.turn.allFinite();
                     }) &&
         std::all_of(s.contacts.begin(), s.contacts.end(),
                     [](const ImpulseContact& c) { return c.impulse.allFinite(); });
}

/// A response of the catalogue, and scenes at random for it.
class ResponseTrial : public testing::TestWithParam<ResponseEntry> {
 protected:
  std::unique_ptr<Response> response = GetParam().make();

  bool has_friction() const { return GetParam().name != "single_impulse"; }
  /// True if it treats each point of a patch.
  bool sees_points() const { return GetParam().name != "single_impulse"; }

  ImpulseScene after(ImpulseScene s, double step = 0) {
    response->resolve(s.bodies, s.contacts, step);
    return s;
  }
  static void for_scenes(int count, const SceneKind& kind, const std::function<void(const ImpulseScene&)>& law) {
    for (int k = 0; k < count; ++k) {
      PortableRandom random{std::uint64_t(1000 + k)};
      SceneKind some = kind;
      some.bodies = std::min(kind.bodies, 2 + k % 5);
      law(random_scene(random, some));
      ASSERT_FALSE(HasFatalFailure()) << "scene " << k << " of " << some.bodies << " bodies";
    }
  }
};

}  // namespace laws
}  // namespace polhode
