// SPDX-License-Identifier: BSD-3-Clause
// Mechanisms in DART: hinge angles (RevoluteJoint), semi-implicit Euler, and BallJointConstraint where a hinge closes a
// loop.
#include <dart/constraint/BallJointConstraint.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>

#include "tests/benchmarks/peers/mechanism.hpp"

namespace polhode::peers {
namespace {

Arrival run(const Mechanism& m, double h) {
  using namespace dart::dynamics;
  const auto at = [](double x, double y) {
    Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
    t.translation() = Eigen::Vector3d(x, y, 0);
    return t;
  };
  const SkeletonPtr skeleton = Skeleton::create("mechanism");
  std::vector<BodyNode*> nodes(m.bodies.size(), nullptr);
  std::vector<std::shared_ptr<dart::constraint::BallJointConstraint>> loops;
  for (const Hinge& hinge : m.hinges) {
    const PlaneBody& b = m.bodies[std::size_t(hinge.body)];
    if (hinge.closes) {  // a loop with the ground
      loops.push_back(std::make_shared<dart::constraint::BallJointConstraint>(nodes[std::size_t(hinge.body)],
                                                                              Eigen::Vector3d(hinge.x, hinge.y, 0)));
      continue;
    }
    BodyNode* parent = hinge.other < 0 ? nullptr : nodes[std::size_t(hinge.other)];
    const double px = hinge.other < 0 ? 0 : m.bodies[std::size_t(hinge.other)].x;
    const double py = hinge.other < 0 ? 0 : m.bodies[std::size_t(hinge.other)].y;
    RevoluteJoint::Properties joint;
    joint.mName = "joint" + std::to_string(hinge.body);
    joint.mAxis = Eigen::Vector3d::UnitZ();
    joint.mT_ParentBodyToJoint = at(hinge.x - px, hinge.y - py);
    joint.mT_ChildBodyToJoint = at(hinge.x - b.x, hinge.y - b.y);
    BodyNode::Properties body;
    body.mName = "body" + std::to_string(hinge.body);
    body.mInertia = Inertia(b.mass, Eigen::Vector3d::Zero(), b.inertia * Eigen::Matrix3d::Identity());
    auto made = skeleton->createJointAndBodyNodePair<RevoluteJoint>(parent, joint, body);
    const double spin = b.spin - (hinge.other < 0 ? 0 : m.bodies[std::size_t(hinge.other)].spin);
    made.first->setVelocity(0, spin);
    nodes[std::size_t(hinge.body)] = made.second;
  }
  const auto world = dart::simulation::World::create();
  world->setGravity(Eigen::Vector3d(0, -gravity, 0));
  world->setTimeStep(h);
  world->addSkeleton(skeleton);
  for (const auto& loop : loops) world->getConstraintSolver()->addConstraint(loop);
  Arrival a;
  a.steps = steps_of(m, h);
  a.wall = timed([&] {
    for (long k = 0; k < a.steps; ++k) world->step();
  });
  const Eigen::Vector3d place = nodes[std::size_t(m.probe)]->getCOM();
  a.x = place.x();
  a.y = place.y();
  return a;
}

}  // namespace

std::vector<Program> dart_programs() { return {{"DART", "semi-implicit Euler", false, &run}}; }

}  // namespace polhode::peers
