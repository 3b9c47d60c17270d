// SPDX-License-Identifier: BSD-3-Clause
// Mechanisms in Simbody: hinge angles (MobilizedBody::Pin), and two points kept in planes where a hinge closes a loop.
// Runge–Kutta–Merson with projection, as its users choose it by an accuracy.
#include <Simbody.h>

#include "tests/benchmarks/peers/mechanism.hpp"

namespace polhode::peers {
namespace {

Arrival run(const Mechanism& m, double accuracy) {
  using namespace SimTK;
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  Force::UniformGravity(forces, matter, Vec3(0, -gravity, 0));
  std::vector<MobilizedBody::Pin> pins(m.bodies.size());
  std::vector<int> parents(m.bodies.size(), -1);
  for (const Hinge& h : m.hinges) {
    const PlaneBody& b = m.bodies[std::size_t(h.body)];
    const Vec3 in_body(h.x - b.x, h.y - b.y, 0);
    if (h.closes) {  // a loop with the ground
      Constraint::PointInPlane(matter.Ground(), UnitVec3(XAxis), h.x, pins[std::size_t(h.body)], in_body);
      Constraint::PointInPlane(matter.Ground(), UnitVec3(YAxis), h.y, pins[std::size_t(h.body)], in_body);
      continue;
    }
    const Body::Rigid body(MassProperties(b.mass, Vec3(0), Inertia(b.inertia)));
    parents[std::size_t(h.body)] = h.other;
    if (h.other < 0) {
      pins[std::size_t(h.body)] =
          MobilizedBody::Pin(matter.Ground(), Transform(Vec3(h.x, h.y, 0)), body, Transform(in_body));
    } else {
      const PlaneBody& on = m.bodies[std::size_t(h.other)];
      pins[std::size_t(h.body)] = MobilizedBody::Pin(
          pins[std::size_t(h.other)], Transform(Vec3(h.x - on.x, h.y - on.y, 0)), body, Transform(in_body));
    }
  }
  State state = system.realizeTopology();
  for (std::size_t i = 0; i < pins.size(); ++i)
    pins[i].setRate(state, m.bodies[i].spin - (parents[i] < 0 ? 0 : m.bodies[std::size_t(parents[i])].spin));
  system.realize(state, Stage::Velocity);
  RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  integrator.setConstraintTolerance(accuracy / 10);
  TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  Arrival a;
  a.wall = timed([&] { stepper.stepTo(m.t_end); });
  a.steps = integrator.getNumStepsTaken();
  const Vec3 place = pins[std::size_t(m.probe)].getBodyOriginLocation(stepper.getState());
  a.x = place[0];
  a.y = place[1];
  return a;
}

}  // namespace

std::vector<Program> simbody_programs() { return {{"Simbody", "Runge-Kutta-Merson", true, &run}}; }

}  // namespace polhode::peers
