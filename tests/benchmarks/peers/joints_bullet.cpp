// SPDX-License-Identifier: BSD-3-Clause
// Mechanisms in Bullet, in single precision as Debian builds it: six coordinates for each body, btHingeConstraint,
// sequential impulses with ten iterations.
#include <btBulletDynamicsCommon.h>

#include <memory>

#include "tests/benchmarks/peers/mechanism.hpp"

namespace polhode::peers {
namespace {

Arrival run(const Mechanism& m, double h) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broad_phase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broad_phase, &solver, &configuration);
  world.setGravity({0, btScalar(-gravity), 0});
  btEmptyShape shape;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  const auto s = [](double x) { return static_cast<btScalar>(x); };
  for (const PlaneBody& b : m.bodies) {
    const btScalar i = s(b.inertia);
    btRigidBody::btRigidBodyConstructionInfo info(s(b.mass), nullptr, &shape, {i, i, i});
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin({s(b.x), s(b.y), 0});
    auto body = std::make_unique<btRigidBody>(info);
    body->setLinearVelocity({s(b.vx), s(b.vy), 0});
    body->setAngularVelocity({0, 0, s(b.spin)});
    body->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(body.get(), 0, 0);
    bodies.push_back(std::move(body));
  }
  std::vector<std::unique_ptr<btHingeConstraint>> hinges;
  const btVector3 axis(0, 0, 1);
  for (const Hinge& hinge : m.hinges) {
    const PlaneBody& one = m.bodies[std::size_t(hinge.body)];
    btRigidBody& body = *bodies[std::size_t(hinge.body)];
    const btVector3 pivot(s(hinge.x - one.x), s(hinge.y - one.y), 0);
    if (hinge.other < 0) {
      hinges.push_back(std::make_unique<btHingeConstraint>(body, pivot, axis));
    } else {
      const PlaneBody& two = m.bodies[std::size_t(hinge.other)];
      hinges.push_back(std::make_unique<btHingeConstraint>(body, *bodies[std::size_t(hinge.other)], pivot,
                                                           btVector3(s(hinge.x - two.x), s(hinge.y - two.y), 0), axis,
                                                           axis));
    }
    world.addConstraint(hinges.back().get(), true);
  }
  Arrival a;
  a.steps = steps_of(m, h);
  a.wall = timed([&] {
    for (long k = 0; k < a.steps; ++k) world.stepSimulation(s(h), 0);
  });
  const btVector3 place = bodies[std::size_t(m.probe)]->getWorldTransform().getOrigin();
  a.x = place.x();
  a.y = place.y();
  for (const auto& hinge : hinges) world.removeConstraint(hinge.get());
  for (const auto& body : bodies) world.removeRigidBody(body.get());
  return a;
}

}  // namespace

std::vector<Program> bullet_programs() { return {{"Bullet", "sequential impulses, single precision", false, &run}}; }

}  // namespace polhode::peers
