// SPDX-License-Identifier: BSD-3-Clause
// Contacts and joints together: the laws of both after an impulse, against a closed form, and in runs.
#include "collision/contact/jointed_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "collision/shapes/box.hpp"
#include "collision/shapes/sphere.hpp"
#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "tests/collision/contact/contact_run.hpp"

namespace polhode::jointed_contacts_test {
namespace {

using Vector = Vector3<double>;

/// A ball joint of the near end of a link and a point of another body or, if there is one body, of the world.
void add_ball(Problem& problem, const std::vector<std::size_t>& bodies, const Vector& near, const Vector& other) {
  problem.joints.push_back(
      {"joint" + std::to_string(problem.joints.size()),
       {"ball", bodies, {{"anchor_body", near}, {"anchor_world", other}, {"anchor_body_2", other}}}});
}

constexpr double length = 0.5, width = 0.1;

/// Links along x from the origin at a height, each on a ball joint to the one before; the first on the world if `held`.
ContactRun chain(std::size_t links, double height, bool held, double restitution = 0, double friction = 0) {
  ContactRun run;
  run.timing = Timing::at_step;
  for (std::size_t i = 0; i < links; ++i)
    run.add(1 + 0.5 * double(i % 3), std::make_shared<Box>(0.5 * Vector(length, width, width)),
            {.position = {length * (double(i) + 0.5), 0, height}}, restitution, friction);
  run.add_floor(restitution, friction);
  run.add_gravity();
  const Vector end(length / 2, 0, 0);
  if (held) add_ball(run.problem, {0}, -end, {0, 0, height});
  for (std::size_t i = 1; i < links; ++i) add_ball(run.problem, {i, i - 1}, -end, end);
  return run;
}

/// Contacts at the lower corners of the far ends of all links, at velocities that the joints allow.
struct Strike {
  std::unique_ptr<System<double>> system;
  VectorX<double> y;
  std::vector<ImpulseBody> bodies;
  std::vector<ImpulseContact> contacts;

  Strike(const ContactRun& run, double restitution, double friction, unsigned seed)
      : system(make_system<double>(run.problem, {})), y(system->start().y) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto some = [&] { return Vector(uniform(random), uniform(random), uniform(random)); };
    for (std::size_t i = 0; i < system->moving(); ++i) system->apply_impulse(y, i, some() + Vector(0, 0, -3), some());
    project_joint_velocities(*system, y);
    impulse_bodies(*system, y, bodies);
    for (std::size_t i = 0; i < system->moving(); ++i) {
      for (const double side : {-0.5, 0.5}) {
        ImpulseContact c;
        c.a = std::uint32_t(i);
        c.b = std::uint32_t(system->moving());
        c.normal = {0, 0, 1};
        c.point = bodies[i].position + Vector(length / 2, side * width, -width / 2);
        c.friction = friction;
        c.approach = bodies[i].velocity_at(c.point)[2];
        c.restitution = c.approach < 0 ? restitution : 0;
        c.wanted = -c.restitution * c.approach;
        c.feature = {Feature::Kind::vertex_face, std::uint32_t(contacts.size()), 0};
        contacts.push_back(c);
      }
    }
  }

  double energy(const std::vector<ImpulseBody>& all) const {
    double sum = 0;
    for (std::size_t i = 0; i < system->moving(); ++i) {
      const auto& b = all[i];
      sum += 0.5 * b.velocity.squaredNorm() / b.inverse_mass +
             0.5 * b.angular_velocity.dot(b.inverse_inertia.inverse() * b.angular_velocity);
    }
    return sum;
  }

  /// The largest |G v|, m/s.
  double open(const std::vector<ImpulseBody>& all) const {
    const auto motions = motions_of(*system, y);
    system->constraints()->evaluate(motions);
    std::vector<Wrench<double>> twists(system->moving());
    for (std::size_t i = 0; i < twists.size(); ++i) twists[i] = {all[i].velocity, all[i].angular_velocity};
    VectorX<double> product;
    system->constraints()->multiply(twists, product);
    return product.cwiseAbs().maxCoeff();
  }
};

class JointedResponse : public testing::TestWithParam<std::string> {};

TEST_P(JointedResponse, ObeysTheLawsOfContactsAndOfJoints) {
  if (GetParam() == "single_impulse") GTEST_SKIP() << "answers one contact of a pair";
  for (const std::size_t links : {1UL, 2UL, 5UL}) {
    for (const double friction : {0.0, 0.6}) {
      for (const double restitution : {0.0, 0.5}) {
        const ContactRun run = chain(links, 1, true);
        for (unsigned seed = 1; seed <= 5; ++seed) {
          Strike strike(run, restitution, friction, seed);
          const double before = strike.energy(strike.bodies);
          JointedContacts joined(*strike.system);
          const auto response = find_response(GetParam())->make();
          joined.resolve(*response, strike.y, strike.bodies, strike.contacts, 1e-3);
          EXPECT_LT(strike.open(strike.bodies), 1e-12);
          EXPECT_LT(strike.energy(strike.bodies), before * (1 + 1e-9));
          for (const ImpulseContact& c : strike.contacts) {
            const double normal = c.impulse[2], along = strike.bodies[c.a].velocity_at(c.point)[2];
            EXPECT_GE(normal, 0);
            EXPECT_LE(std::hypot(c.impulse[0], c.impulse[1]), friction * normal + 1e-9);
            if (restitution > 0) continue;  // impulses that would add energy are smaller
            EXPECT_GT(along, c.wanted - 1e-6);
            EXPECT_LT(normal * std::abs(along - c.wanted), 1e-6) << links << " links, " << friction;
          }
        }
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Catalogue, JointedResponse, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const ResponseEntry& r : impulse_responses()) names.push_back(r.name);
                           return names;
                         }()),
                         [](const auto& of) { return of.param; });

// A rod of length l and moment of inertia I about its end, held there, meets the floor with the other at v: the impulse
// is (1 + e) I v/l².
TEST(JointedContacts, AHeldRodTakesTheImpulseOfItsMomentOfInertia) {
  const ContactRun run = chain(1, 1, true);
  Strike strike(run, 0, 0, 1);
  const Body& rod = run.problem.bodies[0];
  strike.contacts.resize(1);
  ImpulseContact& c = strike.contacts[0];
  c.point = {length, 0, 1};
  strike.bodies[0].angular_velocity = {0, 2, 0};
  strike.bodies[0].velocity = {0, 0, -2 * length / 2};
  c.approach = -2 * length;
  c.wanted = 0.25 * 2 * length;
  JointedContacts joined(*strike.system);
  const auto response = find_response("sequential_impulses")->make();
  joined.resolve(*response, strike.y, strike.bodies, strike.contacts, 1e-3);
  const double about_end = rod.inertia(1, 1) + rod.mass * length * length / 4;
  EXPECT_NEAR(c.impulse[2], 1.25 * about_end * 2 / length, 1e-9);
  EXPECT_NEAR(strike.bodies[0].angular_velocity[1], -0.5, 1e-9);
}

// A see-saw whose ends both touch cannot bounce: one end would have to rise while the other rests. It stops.
TEST(JointedContacts, ASeeSawThatCannotBounceGainsNoEnergy) {
  for (const char* name : {"sequential_impulses", "simultaneous"}) {
    ContactRun run = chain(1, 1, false);
    add_ball(run.problem, {0}, Vector::Zero(), {length / 2, 0, 1});
    Strike strike(run, 0, 0, 1);
    strike.bodies[0].velocity.setZero();
    strike.bodies[0].angular_velocity = {0, 2, 0};
    const double before = strike.energy(strike.bodies);
    for (std::size_t k = 0; k < 2; ++k) {
      ImpulseContact& c = strike.contacts[k];
      c.point = {k == 0 ? length : 0, 0, 1};
      c.approach = k == 0 ? -length : length;
      c.wanted = k == 0 ? 0.8 * length : 0;
    }
    JointedContacts joined(*strike.system);
    const auto response = find_response(name)->make();
    joined.resolve(*response, strike.y, strike.bodies, strike.contacts, 1e-3);
    EXPECT_LT(strike.open(strike.bodies), 1e-9) << name;
    EXPECT_LE(strike.energy(strike.bodies), before * (1 + 1e-9)) << name;
    EXPECT_LT(strike.bodies[0].angular_velocity.norm(), 1e-6) << name;
    for (const ImpulseContact& c : strike.contacts) EXPECT_LT(c.impulse[2], 1) << name;
    EXPECT_EQ(strike.contacts[0].wanted, 0.8 * length);
  }
}

TEST(JointedContacts, AChainFallsOnAFloorAndRests) {
  for (const char* method : {"semi_implicit_euler", "rk4"}) {
    ContactRun run = chain(6, 0.4, false, 0, 0.5);
    run.method = method;
    run.formulation.joints.stabilization = Stabilization::both;
    run.dt = 2e-3;
    run.t_end = 1.5;
    run.run();
    const auto system = make_system<double>(run.problem, run.formulation);
    const auto motions = motions_of(*system, run.end.y);
    double weight = 0;  // N
    for (std::size_t i = 0; i < system->moving(); ++i) {
      weight += 9.81 * run.problem.bodies[i].mass;
      EXPECT_NEAR(motions[i].position[2], width / 2, 1.1e-3) << method;
      EXPECT_LT(motions[i].velocity.norm(), 1e-6) << method;
    }
    for (std::size_t k = 0; k < system->constraints()->count(); ++k)
      EXPECT_LT(system->constraints()->violation(k, motions).position, 1e-13);
    // The energy of the fall is lost in contact, and the ledger shows it.
    EXPECT_NEAR(run.losses.total(), weight * (0.4 - width / 2), 0.02 * weight * 0.4) << method;
    const double first = run.samples.front().ledger(0), last = run.samples.back().ledger(run.losses.total());
    EXPECT_NEAR(first, last, 0.02 * weight * 0.4) << method;
  }
}

TEST(JointedContacts, BodiesOfAJointDoNotTouch) {
  ContactRun run = chain(2, 1, false);
  ContactScene scene(run.problem, run.colliders, "all_pairs", "sat");
  const auto system = make_system<double>(run.problem, {});
  std::vector<Pose> poses;
  shape_poses(*system, system->start().y, poses);
  EXPECT_TRUE(scene.near_pairs(poses, poses, {}, 0).empty());  // neither with each other nor with the floor
  run.problem.joints.clear();
  ContactScene loose(run.problem, run.colliders, "all_pairs", "sat");
  EXPECT_EQ(loose.near_pairs(poses, poses, {}, 1e-3).size(), 1u);
}

}  // namespace
}  // namespace polhode::jointed_contacts_test
