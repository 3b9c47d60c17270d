// SPDX-License-Identifier: BSD-3-Clause
// Mechanisms in the Open Dynamics Engine: six coordinates for each body, dJointTypeHinge, error reduction 0.2.
#include <ode/ode.h>

#include "tests/benchmarks/peers/mechanism.hpp"

namespace polhode::peers {
namespace {

template <int (*step)(dWorldID, dReal)>
Arrival run(const Mechanism& m, double h) {
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, 0, -gravity, 0);
  dWorldSetERP(world, 0.2);
  dWorldSetCFM(world, 1e-10);
  std::vector<dBodyID> bodies;
  for (const PlaneBody& b : m.bodies) {
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    dMassSetParameters(&mass, b.mass, 0, 0, 0, b.inertia, b.inertia, b.inertia, 0, 0, 0);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, b.x, b.y, 0);
    dBodySetLinearVel(body, b.vx, b.vy, 0);
    dBodySetAngularVel(body, 0, 0, b.spin);
    bodies.push_back(body);
  }
  for (const Hinge& hinge : m.hinges) {
    const dJointID joint = dJointCreateHinge(world, nullptr);
    dJointAttach(joint, bodies[std::size_t(hinge.body)], hinge.other < 0 ? nullptr : bodies[std::size_t(hinge.other)]);
    dJointSetHingeAnchor(joint, hinge.x, hinge.y, 0);
    dJointSetHingeAxis(joint, 0, 0, 1);
  }
  Arrival a;
  a.steps = steps_of(m, h);
  a.wall = timed([&] {
    for (long k = 0; k < a.steps; ++k) step(world, h);
  });
  const dReal* place = dBodyGetPosition(bodies[std::size_t(m.probe)]);
  a.x = place[0];
  a.y = place[1];
  dWorldDestroy(world);
  dCloseODE();
  return a;
}

}  // namespace

std::vector<Program> ode_programs() {
  return {{"ODE", "dWorldStep", false, &run<&dWorldStep>}, {"ODE", "dWorldQuickStep", false, &run<&dWorldQuickStep>}};
}

}  // namespace polhode::peers
