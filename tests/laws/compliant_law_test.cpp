// SPDX-License-Identifier: BSD-3-Clause
// The laws of the response that is a force, for any two bodies that overlap, at random.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "collision/contact/compliant.hpp"
#include "collision/contact/contact_scene.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/ellipsoid.hpp"
#include "collision/shapes/half_space.hpp"
#include "collision/shapes/sphere.hpp"
#include "core/math/portable_random.hpp"
#include "core/problem/inertia.hpp"
#include "tests/laws/allocations.hpp"

namespace polhode::laws::compliant_law_test {
namespace {

using Vector = Vector3<double>;

struct Pair {
  const char* name;
  ShapePointer a, b;
  bool potential;  ///< the spring has one
};

ShapePointer box() { return std::make_shared<Box>(Vector(0.5, 0.6, 0.7)); }
ShapePointer capsule() { return std::make_shared<Capsule>(0.2, 0.6); }
ShapePointer sphere() { return std::make_shared<Sphere>(0.3); }
ShapePointer ellipsoid() { return std::make_shared<Ellipsoid>(Vector(0.2, 0.3, 0.35)); }
ShapePointer floor() { return std::make_shared<HalfSpace>(Vector(0.1, -0.2, 1)); }

std::vector<Pair> pairs() {
  return {{"sphere_sphere", sphere(), sphere(), true},
          {"sphere_box", sphere(), box(), true},
          {"ellipsoid_capsule", ellipsoid(), capsule(), true},
          {"box_half_space", box(), floor(), true},
          {"capsule_half_space", capsule(), floor(), true},
          {"sphere_half_space", sphere(), floor(), true},
          {"box_box", box(), box(), false},
          {"capsule_box", capsule(), box(), false}};
}

class CompliantLaw : public testing::TestWithParam<Pair> {
 protected:
  /// Two bodies, the second one static where it has no end.
  struct Scene {
    Scene(const Pair& pair, double restitution, double friction, const char* narrow_phase = "gjk") {
      std::vector<Collider> colliders;
      for (const ShapePointer& shape : {pair.a, pair.b}) {
        Body body;
        body.mass = 1.5 + double(colliders.size());
        if (shape->finite())
          body.inertia = body.mass / shape->mass_properties().volume * shape->mass_properties().inertia;
        body.fixed = !shape->finite();
        problem.bodies.push_back(body);
        problem.starts.emplace_back();
        colliders.push_back({shape, restitution, friction});
      }
      system = make_system<double>(problem, {});
      contacts = std::make_unique<ContactScene>(problem, colliders, "all_pairs", narrow_phase);
      force = std::make_unique<Compliant>(*system, *contacts, Compliance{.stiffness = 1e4, .slip_speed = 1e-2});
    }
    std::vector<Wrench<double>> wrenches(const std::vector<BodyMotion<double>>& bodies) const {
      std::vector<Wrench<double>> all(bodies.size());
      force->add_wrench(0, bodies, all);
      return all;
    }

    Problem problem;
    std::unique_ptr<System<double>> system;
    std::unique_ptr<ContactScene> contacts;
    std::unique_ptr<Compliant> force;
  };

  static std::vector<BodyMotion<double>> random_motions(PortableRandom& random) {
    const bool plane = !GetParam().b->finite();
    const auto motion = [&](double near) {
      return BodyMotion<double>{random.uniform_vector(-near, near), random.rotation(), random.uniform_vector(-1, 1),
                                random.uniform_vector(-3, 3)};
    };
    std::vector<BodyMotion<double>> all = {motion(0.3), motion(0.3)};
    if (plane) {
      all[1] = {Vector::Zero(), Matrix3<double>::Identity(), Vector::Zero(), Vector::Zero()};
      all[0].position[2] = random.uniform(0.1, 0.4);
    }
    return all;
  }
  static std::vector<BodyMotion<double>> moved(std::vector<BodyMotion<double>> bodies, double t) {
    for (BodyMotion<double>& b : bodies) {
      b.position += t * b.velocity;
      const double rate = b.angular_velocity.norm();
      if (rate > 0) b.rotation = Eigen::AngleAxisd(t * rate, b.angular_velocity / rate) * b.rotation;
    }
    return bodies;
  }
  static double power_of(const std::vector<BodyMotion<double>>& bodies, const std::vector<Wrench<double>>& wrenches) {
    double sum = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      sum += wrenches[i].force.dot(bodies[i].velocity) + wrenches[i].torque.dot(bodies[i].angular_velocity);
    }
    return sum;
  }
};

TEST_P(CompliantLaw, ForcesAreEqualAndOppositeInOneLine) {
  const Scene s(GetParam(), 0.5, 0.7);
  int touching = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    PortableRandom random(seed);
    const auto bodies = random_motions(random);
    const auto w = s.wrenches(bodies);
    touching += !w[0].force.isZero(0);
    Vector force = Vector::Zero(), torque = Vector::Zero();
    for (std::size_t i = 0; i < 2; ++i) {
      force += w[i].force;
      torque += w[i].torque + bodies[i].position.cross(w[i].force);
    }
    const double scale = 1e-14 * w[0].force.norm();
    ASSERT_LE(force.norm(), scale) << seed;
    ASSERT_LE(torque.norm(), 10 * scale) << seed;
  }
  EXPECT_GT(touching, 50);
}

TEST_P(CompliantLaw, WhatHasNoPotentialIsPower) {
  for (const double restitution : {1.0, 0.3}) {
    const Scene s(GetParam(), restitution, 0.7);
    int smooth = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      PortableRandom random(seed);
      const auto bodies = random_motions(random);
      const auto w = s.wrenches(bodies);
      const double whole = power_of(bodies, w), power = s.force->power(0, bodies), scale = 1 + w[0].force.norm();
      if (!GetParam().potential) {
        ASSERT_EQ(s.force->potential_energy(bodies), 0);
        ASSERT_NEAR(whole, power, 1e-12 * scale) << seed;
        continue;
      }
      ASSERT_LE(power, 1e-12 * scale) << seed;  // damper and friction take
      // dU/dt by central differences; where two of them differ a face or a vertex is left at that instant.
      const auto rate = [&](double t) {
        return (s.force->potential_energy(moved(bodies, t)) - s.force->potential_energy(moved(bodies, -t))) / (2 * t);
      };
      if (std::abs(rate(1e-5) - rate(2e-5)) > 1e-5 * scale) continue;
      ++smooth;
      ASSERT_NEAR(whole, power - rate(1e-5), 2e-5 * scale) << seed;
    }
    if (GetParam().potential) {
      EXPECT_GT(smooth, 150);
    }
  }
}

TEST_P(CompliantLaw, NoPointPulls) {
  const Scene s(GetParam(), 0, 0);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    PortableRandom random(seed);
    auto bodies = random_motions(random);
    const Vector at_rest = [&] {
      auto still = bodies;
      for (BodyMotion<double>& b : still) b.velocity.setZero(), b.angular_velocity.setZero();
      return s.wrenches(still)[0].force;
    }();
    bodies[0].velocity += 20 * at_rest.stableNormalized();  // apart, so fast that the damper would
    ASSERT_GE(s.wrenches(bodies)[0].force.dot(at_rest), 0) << seed;
  }
}

TEST_P(CompliantLaw, ALostStateTouchesNothing) {
  const Scene s(GetParam(), 0.5, 0.5);
  PortableRandom random(1);
  auto bodies = random_motions(random);
  for (const double lost : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    bodies[0].position[1] = lost;
    EXPECT_EQ(s.wrenches(bodies)[0].force, Vector(Vector::Zero()));
  }
}

TEST_P(CompliantLaw, TheSameInputGivesTheSameBytesAndTakesNoMemory) {
  const Scene s(GetParam(), 0.5, 0.5), t(GetParam(), 0.5, 0.5);
  PortableRandom random(3);
  const auto bodies = random_motions(random), later = moved(bodies, 1e-4);
  std::vector<Wrench<double>> w(2), u(2);
  s.force->add_wrench(0, bodies, w);
  t.force->add_wrench(0, bodies, u);
  EXPECT_EQ(w[0].force, u[0].force);
  EXPECT_EQ(w[1].torque, u[1].torque);
  s.force->add_wrench(0, later, w);
  const std::size_t before = allocations();
  for (int k = 0; k < 5; ++k) {
    s.force->add_wrench(0, bodies, w);
    s.force->power(0, bodies);
    s.force->add_wrench(0, later, w);
    s.force->potential_energy(later);
  }
  EXPECT_EQ(allocations(), before);
}

INSTANTIATE_TEST_SUITE_P(Pairs, CompliantLaw, testing::ValuesIn(pairs()),
                         [](const auto& pair) { return std::string(pair.param.name); });

TEST(ResponseCatalogue, EachAnswersByImpulsesOrByAForce) {
  for (const ResponseEntry& e : response_catalogue()) EXPECT_NE(e.make == nullptr, e.make_force == nullptr) << e.name;
  EXPECT_EQ(impulse_responses().size() + 1, response_catalogue().size());
}

}  // namespace
}  // namespace polhode::laws::compliant_law_test
