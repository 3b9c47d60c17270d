// SPDX-License-Identifier: BSD-3-Clause
// The laws of every response to bodies that meet, at random.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/laws/allocations.hpp"
#include "tests/laws/response_trials.hpp"

namespace polhode::laws::response_law_test {
namespace {

using Vector = Vector3<double>;
using Matrix = Matrix3<double>;

/// Leaves one point of each patch.
void keep_first_points(ImpulseScene& s) {
  std::erase_if(s.contacts, [](const ImpulseContact& c) { return c.feature.of_a > 0; });
}

class ResponseLaw : public ResponseTrial {};

TEST_P(ResponseLaw, HasANameAndASummary) {
  EXPECT_FALSE(GetParam().summary.empty());
  const ResponseEntry* found = find_response(GetParam().name);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->name, GetParam().name);
}

TEST_P(ResponseLaw, MomentumIsKeptToRoundOff) {
  for (const double step : {0.0, 0.01}) {
    for_scenes(60, {.bodies = 6, .friction = 1, .restitution = 1}, [&](const ImpulseScene& s) {
      const ImpulseScene t = after(s, step);
      double scale = 0;
      for (const ImpulseContact& c : t.contacts) scale += c.impulse.norm() * (1 + c.point.norm());
      const double round_off = 2e-13 * (1 + scale);
      ASSERT_LE((linear_momentum(t.bodies) - linear_momentum(s.bodies)).norm(), round_off);
      ASSERT_LE((angular_momentum(t.bodies) - angular_momentum(s.bodies)).norm(), round_off);
    });
  }
}

TEST_P(ResponseLaw, KineticEnergyNeverRises) {
  for (const double friction : {0.0, 1.0}) {
    for (const double restitution : {0.0, 1.0}) {
      for (const double statics : {0.0, 0.3}) {
        const SceneKind kind{
            .bodies = 6, .statics = statics, .friction = friction, .restitution = restitution, .spread = 1};
        for_scenes(60, kind, [&](const ImpulseScene& s) {
          const double before = kinetic_energy(s.bodies);
          ASSERT_LE(kinetic_energy(after(s).bodies), before * (1 + 1e-10));
        });
      }
    }
  }
}

TEST_P(ResponseLaw, KineticEnergyNeverRisesWhereRestitutionDiffers) {
  for (std::uint64_t seed = 1400; seed < 1500; ++seed) {
    PortableRandom random(seed);
    ImpulseScene s = random_scene(random, {.bodies = 3, .friction = 1.5, .spread = 3});
    for (ImpulseContact& c : s.contacts) c.restitution = random.chance(0.5);
    s.meet();
    const double before = kinetic_energy(s.bodies);
    ASSERT_LE(kinetic_energy(after(s).bodies), before * (1 + 1e-10)) << seed;
  }
}

TEST_P(ResponseLaw, KineticEnergyNeverRisesFromForcesOfTheStepBefore) {
  for_scenes(60, {.bodies = 5, .statics = 0.3, .friction = 1, .restitution = 0.5}, [&](const ImpulseScene& start) {
    ImpulseScene s = start;
    PortableRandom random(5);
    for (int k = 0; k < 5; ++k) {
      for (ImpulseBody& b : s.bodies) {
        if (b.moves()) b.velocity += random.uniform_vector(-1, 1);
      }
      s.meet();
      const double before = kinetic_energy(s.bodies);
      s = after(s, 0.01);
      ASSERT_LE(kinetic_energy(s.bodies), before * (1 + 1e-10)) << "step " << k;
    }
  });
}

TEST_P(ResponseLaw, OneElasticContactKeepsEnergy) {
  for_scenes(60, {.bodies = 2}, [&](ImpulseScene s) {
    if (s.contacts.empty()) return;
    s.contacts.resize(1);
    s.contacts[0].restitution = 1;
    s.meet();
    const double before = kinetic_energy(s.bodies);
    ASSERT_NEAR(kinetic_energy(after(s).bodies), before, 1e-12 * before);
  });
}

TEST_P(ResponseLaw, NoContactPullsAndFrictionStaysInTheCone) {
  for (const double restitution : {0.0, 1.0}) {
    for_scenes(100, {.bodies = 6, .statics = 0.2, .friction = 1, .restitution = restitution},
               [&](const ImpulseScene& s) {
                 const ImpulseScene t = after(s);
                 for (const ImpulseContact& c : t.contacts) {
                   const Seen seen(t, c);
                   ASSERT_GE(seen.normal_impulse, -1e-15 * c.impulse.norm());
                   ASSERT_LE(seen.friction.norm(), c.friction * seen.normal_impulse + 1e-13 * c.impulse.norm());
                   if (!has_friction()) {
                     ASSERT_LE(seen.friction.norm(), 1e-15 * c.impulse.norm());
                   }
                 }
               });
  }
}

TEST_P(ResponseLaw, FrictionOpposesTheSlip) {
  if (!has_friction()) GTEST_SKIP() << "it has none";
  int slipping = 0, sticking = 0;
  for (const bool whole_patches : {false, true}) {
    // Two points that stick push each other along their line as they like: what is found of that is found slowly.
    const double tolerance = whole_patches ? 1e-3 : 1e-8;
    for_scenes(200, {.bodies = 3, .friction = 1}, [&](ImpulseScene s) {
      if (!whole_patches) keep_first_points(s);
      const ImpulseScene t = after(s);
      for (const ImpulseContact& c : t.contacts) {
        const Seen seen(t, c);
        // The friction has the length μ j_n and acts against the slip, or there is no slip.
        ASSERT_LE((c.friction * seen.normal_impulse * seen.slip + seen.slip.norm() * seen.friction).norm(), tolerance);
        if (seen.normal_impulse > 1e-3) ++(seen.slip.norm() > 1e-3 ? slipping : sticking);
      }
    });
  }
  EXPECT_GT(slipping, 50);
  EXPECT_GT(sticking, 50);
}

TEST_P(ResponseLaw, NothingApproachesFasterThanWanted) {
  for (const double statics : {0.0, 0.2}) {
    for (const double friction : {0.0, 0.5}) {
      for_scenes(100, {.bodies = 3, .statics = statics, .friction = friction}, [&](ImpulseScene s) {
        if (!sees_points()) keep_first_points(s);
        PortableRandom random(3);
        for (ImpulseContact& c : s.contacts) c.wanted = random.chance(0.3) ? -random.uniform(0, 1) : 0;
        const ImpulseScene t = after(s);
        for (const ImpulseContact& c : t.contacts) {
          if (!s.bodies[c.a].moves() && !s.bodies[c.b].moves()) continue;
          const Seen seen(t, c);
          ASSERT_GE(seen.normal_velocity, c.wanted - 1e-7);
          if (!sees_points()) continue;
          ASSERT_LE(std::min(seen.normal_impulse, seen.normal_velocity - c.wanted), 1e-7);
        }
      });
    }
  }
}

TEST_P(ResponseLaw, NewtonsRestitutionIsComplementary) {
  if (GetParam().name != "sequential_impulses") GTEST_SKIP() << "it has another law of restitution";
  for_scenes(100, {.bodies = 3}, [&](ImpulseScene s) {
    for (ImpulseContact& c : s.contacts) c.restitution = 0.5;
    s.meet();
    // An approach that other contacts cause is not reflected; where all approach, energy cannot rise.
    if (std::any_of(s.contacts.begin(), s.contacts.end(), [](const auto& c) { return c.approach >= 0; })) return;
    const ImpulseScene t = after(s);
    for (const ImpulseContact& c : t.contacts) {
      const Seen seen(t, c);
      ASSERT_GE(seen.normal_velocity, c.wanted - 1e-7);
      ASSERT_LE(std::min(seen.normal_impulse, seen.normal_velocity - c.wanted), 1e-7);
    }
  });
}

TEST_P(ResponseLaw, ExchangedBodiesGetTheSame) {
  for_scenes(60, {.bodies = 2, .friction = 1, .restitution = 1}, [&](ImpulseScene s) {
    s.contacts.resize(std::min<std::size_t>(s.contacts.size(), 3));
    ImpulseScene mirrored = s;
    std::swap(mirrored.bodies[0], mirrored.bodies[1]);
    for (ImpulseContact& c : mirrored.contacts) c.normal = -c.normal;
    ImpulseScene t = after(s), u = after(mirrored);
    std::swap(u.bodies[0], u.bodies[1]);
    ASSERT_LE(difference(t, u), 1e-8);
  });
}

TEST_P(ResponseLaw, AMovedSceneGetsTheSame) {
  for_scenes(60, {.bodies = 3, .friction = 1, .restitution = 0.5}, [&](ImpulseScene s) {
    // A patch with more points than three has more than one answer.
    std::erase_if(s.contacts, [](const ImpulseContact& c) { return c.feature.of_a > 2; });
    PortableRandom random(8);
    const Matrix r = random.rotation();
    const Vector away = random.uniform_vector(-1, 1);
    ImpulseScene moved = s;
    for (ImpulseBody& b : moved.bodies) {
      b.position = r * b.position + away;
      b.velocity = r * b.velocity;
      b.angular_velocity = r * b.angular_velocity;
      b.inverse_inertia = r * b.inverse_inertia * r.transpose();
    }
    for (ImpulseContact& c : moved.contacts) {
      c.normal = r * c.normal;
      c.point = r * c.point + away;
    }
    ImpulseScene t = after(s), u = after(moved);
    for (ImpulseBody& b : t.bodies) {
      b.velocity = r * b.velocity;
      b.angular_velocity = r * b.angular_velocity;
    }
    ASSERT_LE(difference(t, u), 1e-7);
  });
}

TEST_P(ResponseLaw, ScenesApartDoNotMatterToEachOther) {
  for_scenes(40, {.bodies = 3, .friction = 0.5, .restitution = 0.5}, [&](const ImpulseScene& s) {
    PortableRandom random(9);
    const ImpulseScene other = random_scene(random, {.bodies = 3, .friction = 0.5, .restitution = 1});
    ImpulseScene both = s;
    for (const ImpulseBody& b : other.bodies) both.bodies.push_back(b);
    for (ImpulseContact c : other.contacts) {
      c.a += std::uint32_t(s.bodies.size());
      c.b += std::uint32_t(s.bodies.size());
      both.contacts.push_back(c);
    }
    both = after(both);
    ASSERT_LE(difference(after(s), both), 1e-8);
  });
}

TEST_P(ResponseLaw, WhatCannotMoveDoesNot) {
  for_scenes(60, {.bodies = 5, .statics = 0.5, .friction = 1, .restitution = 1}, [&](ImpulseScene s) {
    for (ImpulseContact& c : s.contacts) c.depth = 0.05;
    for (ImpulseBody& b : s.bodies) {
      if (!b.moves()) b.velocity = {0.1, 0.2, 0.3};  // a wall that is driven keeps its way
    }
    const ImpulseScene t = after(s, 0.01);
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
      if (s.bodies[i].moves()) continue;
      ASSERT_EQ(t.bodies[i].velocity, s.bodies[i].velocity);
      ASSERT_EQ(t.bodies[i].angular_velocity, s.bodies[i].angular_velocity);
      ASSERT_EQ(t.bodies[i].shift, Vector(Vector::Zero()));
      ASSERT_EQ(t.bodies[i].turn, Vector(Vector::Zero()));
    }
    for (const ImpulseContact& c : t.contacts) {
      if (s.bodies[c.a].moves() || s.bodies[c.b].moves()) continue;
      ASSERT_EQ(c.impulse, Vector(Vector::Zero()));
    }
  });
}

TEST_P(ResponseLaw, HugeRatiosOfMassGiveNumbers) {
  for (const double step : {0.0, 0.01}) {
    for_scenes(60, {.bodies = 6, .statics = 0.2, .friction = 1, .restitution = 1, .spread = 9}, [&](ImpulseScene s) {
      for (ImpulseContact& c : s.contacts) c.depth = 0.3;
      const double before = kinetic_energy(s.bodies);
      const ImpulseScene t = after(s, step);
      ASSERT_TRUE(finite(t));
      ASSERT_LE(kinetic_energy(t.bodies), before * (1 + 1e-8));
    });
  }
}

TEST_P(ResponseLaw, TheSameInputGivesTheSameBytes) {
  const auto other = GetParam().make();
  for_scenes(20, {.bodies = 6, .statics = 0.2, .friction = 1, .restitution = 1}, [&](const ImpulseScene& s) {
    for (const double step : {0.01, 0.01, 0.0}) {
      const ImpulseScene t = after(s, step);
      ImpulseScene u = s;
      other->resolve(u.bodies, u.contacts, step);
      ASSERT_EQ(difference(t, u), 0);
    }
  });
  // forget() clears what resolve() keeps from step to step.
  const auto fresh = GetParam().make();
  response->forget();
  PortableRandom random(77);
  ImpulseScene s = random_scene(random, {.bodies = 6, .friction = 1}), t = s;
  response->resolve(s.bodies, s.contacts, 0.01);
  fresh->resolve(t.bodies, t.contacts, 0.01);
  EXPECT_EQ(difference(s, t), 0);
}

TEST_P(ResponseLaw, ASteadySceneAllocatesNothing) {
  PortableRandom random(11);
  ImpulseScene s = random_scene(random, {.bodies = 8, .statics = 0.2, .friction = 1, .restitution = 0.5});
  for (ImpulseContact& c : s.contacts) c.depth = 0.02;
  ImpulseScene t = s;
  const auto resolve = [&](double step) {
    std::copy(s.bodies.begin(), s.bodies.end(), t.bodies.begin());
    std::copy(s.contacts.begin(), s.contacts.end(), t.contacts.begin());
    response->resolve(t.bodies, t.contacts, step);
  };
  resolve(0.01);
  resolve(0);
  resolve(0.01);
  const std::size_t before = allocations();
  for (int k = 0; k < 5; ++k) {
    resolve(0.01);
    resolve(0);
  }
  EXPECT_EQ(allocations(), before);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ResponseLaw, testing::ValuesIn(impulse_responses()),
                         [](const auto& response) { return response.param.name; });

}  // namespace
}  // namespace polhode::laws::response_law_test
