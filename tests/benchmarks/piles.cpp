// SPDX-License-Identifier: BSD-3-Clause
// Steps per second of piles of cubes that drop into a box, 10 s at 1/60 s, beside Bullet (btDiscreteDynamicsWorld as it
// is by default, sleeping off) and ODE (its own box collider, quick step), one core. Ours with the energy of every
// step. Each says how deep the cubes are in each other and in the walls at the end, and how far the energy rose.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "collision/contact/time_stepping.hpp"
#include "core/run/simulate.hpp"
#include "integrators/catalogue.hpp"
#include "tests/collision/response/pile.hpp"

#ifdef POLHODE_HAS_BULLET
#include <btBulletDynamicsCommon.h>
#endif
#ifdef POLHODE_HAS_ODE
#include <ode/ode.h>
#endif

namespace {

using namespace polhode;

constexpr int steps = 600;
constexpr double dt = 1 / 60.0;

void piles(benchmark::internal::Benchmark* b) {
  b->ArgName("cubes")->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
}

/// Depth of the deepest of all points where two shapes touch, m.
double deepest(const Pile& pile, const std::vector<Pose>& poses) {
  ContactScene scene(pile.problem, pile.colliders, "sweep_and_prune", "sat");
  scene.near_pairs(poses, poses, {}, 0);
  double deep = 0;
  for (const ImpulseContact& c : scene.contacts(poses, 0)) deep = std::max(deep, c.depth);
  return deep;
}

void report(benchmark::State& state, double deep) {
  state.counters["steps/s"] =
      benchmark::Counter(double(steps) * double(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["depth_m"] = deep;
}

struct LargestEnergy final : Observer {
  double first = 0, most = 0;
  bool started = false;
  std::size_t on_samples(std::span<const Sample> seen) override {
    for (const Sample& s : seen) {
      if (!started) first = s.seen.energy();
      started = true;
      most = std::max(most, s.seen.energy());
    }
    return seen.size();
  }
};

void polhode_pile(benchmark::State& state) {
  const Pile pile(int(state.range(0)));
  std::vector<Pose> poses;
  LargestEnergy energy;
  for (auto _ : state) {
    const auto system = make_system<double>(pile.problem, {});
    ContactScene scene(pile.problem, pile.colliders, "sweep_and_prune", "sat");
    TimeStepping contact(*system, scene, find_response("sequential_impulses")->make());
    const auto method = find_integrator("semi_implicit_euler")->make(*system, {.dt = dt, .t_end = steps * dt});
    State<double> end = system->start();
    energy = {};
    const auto outcome =
        simulate<double>(*system, *system, *method, end,
                         {.t_end = steps * dt, .dt = dt, .samples = {}, .normalize = true}, energy, nullptr, &contact);
    if (outcome.status != RunStatus::ok) state.SkipWithError(outcome.message.c_str());
    shape_poses(*system, end.y, poses);
  }
  report(state, deepest(pile, poses));
  state.counters["E/E0"] = energy.most / energy.first;
}
BENCHMARK(polhode_pile)->Apply(piles);

#ifdef POLHODE_HAS_BULLET
btVector3 bullet(const Vector3<double>& v) { return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}; }

void bullet_pile(benchmark::State& state) {
  const Pile pile(int(state.range(0)));
  std::vector<Pose> poses(pile.problem.bodies.size());
  for (auto _ : state) {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broad;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broad, &solver, &configuration);
    world.setGravity(bullet({0, 0, -Pile::gravity}));
    btBoxShape cube({0.5, 0.5, 0.5});
    std::vector<std::unique_ptr<btCollisionShape>> planes;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    const auto add = [&](double mass, btCollisionShape& shape, const BodyStart& start) {
      btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, &shape,
                                                    btVector3(1, 1, 1) * btScalar(mass / 6));
      info.m_startWorldTransform.setOrigin(bullet(start.position));
      const auto& q = start.orientation;
      info.m_startWorldTransform.setRotation({btScalar(q[1]), btScalar(q[2]), btScalar(q[3]), btScalar(q[0])});
      info.m_friction = btScalar(std::sqrt(Pile::friction));  // the product is the friction of a pair
      bodies.push_back(std::make_unique<btRigidBody>(info));
      bodies.back()->setFriction(btScalar(std::sqrt(Pile::friction)));
      bodies.back()->setActivationState(DISABLE_DEACTIVATION);
      world.addRigidBody(bodies.back().get());
    };
    for (std::size_t i = 0; i < pile.problem.moving(); ++i) add(1, cube, pile.problem.starts[i]);
    for (const auto& [normal, offset] : pile.walls()) {
      planes.push_back(std::make_unique<btStaticPlaneShape>(bullet(normal), btScalar(offset)));
      add(0, *planes.back(), {});
    }
    for (int n = 0; n < steps; ++n) world.stepSimulation(btScalar(dt), 0, btScalar(dt));
    for (std::size_t i = 0; i < pile.problem.moving(); ++i) {
      const btTransform& at = bodies[i]->getWorldTransform();
      for (int r = 0; r < 3; ++r) {
        poses[i].position[r] = at.getOrigin()[r];
        for (int c = 0; c < 3; ++c) poses[i].rotation(r, c) = at.getBasis()[r][c];
      }
    }
    while (world.getNumCollisionObjects() > 0)
      world.removeCollisionObject(world.getCollisionObjectArray()[world.getNumCollisionObjects() - 1]);
  }
  report(state, deepest(pile, poses));
}
BENCHMARK(bullet_pile)->Apply(piles);
#else
void bullet_pile(benchmark::State& state) { state.SkipWithError("skipped, because libbullet-dev is not installed"); }
BENCHMARK(bullet_pile);
#endif

#ifdef POLHODE_HAS_ODE
struct OdeWorld {
  dWorldID world;
  dSpaceID space;
  dJointGroupID joints;
};

void touch(void* data, dGeomID a, dGeomID b) {
  const OdeWorld& in = *static_cast<OdeWorld*>(data);
  if (!dGeomGetBody(a) && !dGeomGetBody(b)) return;
  dContact points[8];
  const int count = dCollide(a, b, 8, &points[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    points[i].surface = {};
    points[i].surface.mode = dContactApprox1;
    points[i].surface.mu = Pile::friction;
    dJointAttach(dJointCreateContact(in.world, in.joints, &points[i]), dGeomGetBody(a), dGeomGetBody(b));
  }
}

void ode_pile(benchmark::State& state) {
  const Pile pile(int(state.range(0)));
  std::vector<Pose> poses(pile.problem.bodies.size());
  dInitODE2(0);
  for (auto _ : state) {
    OdeWorld in{dWorldCreate(), dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ), dJointGroupCreate(0)};
    dWorldSetGravity(in.world, 0, 0, -Pile::gravity);
    dWorldSetAutoDisableFlag(in.world, 0);
    std::vector<dBodyID> bodies;
    for (std::size_t i = 0; i < pile.problem.moving(); ++i) {
      const BodyStart& start = pile.problem.starts[i];
      const dBodyID body = dBodyCreate(in.world);
      dMass mass;
      dMassSetBoxTotal(&mass, 1, 1, 1, 1);
      dBodySetMass(body, &mass);
      dBodySetPosition(body, start.position[0], start.position[1], start.position[2]);
      const dQuaternion q = {start.orientation[0], start.orientation[1], start.orientation[2], start.orientation[3]};
      dBodySetQuaternion(body, q);
      dGeomSetBody(dCreateBox(in.space, 1, 1, 1), body);
      bodies.push_back(body);
    }
    for (const auto& [normal, offset] : pile.walls()) dCreatePlane(in.space, normal[0], normal[1], normal[2], offset);
    for (int n = 0; n < steps; ++n) {
      dSpaceCollide(in.space, &in, touch);
      dWorldQuickStep(in.world, dt);
      dJointGroupEmpty(in.joints);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const dReal *at = dBodyGetPosition(bodies[i]), *r = dBodyGetRotation(bodies[i]);
      for (int k = 0; k < 3; ++k) {
        poses[i].position[k] = at[k];
        for (int c = 0; c < 3; ++c) poses[i].rotation(k, c) = r[4 * k + c];
      }
    }
    dJointGroupDestroy(in.joints);
    dSpaceDestroy(in.space);
    dWorldDestroy(in.world);
  }
  dCloseODE();
  report(state, deepest(pile, poses));
}
BENCHMARK(ode_pile)->Apply(piles);
#else
void ode_pile(benchmark::State& state) { state.SkipWithError("skipped, because libode-dev is not installed"); }
BENCHMARK(ode_pile);
#endif

}  // namespace

BENCHMARK_MAIN();
