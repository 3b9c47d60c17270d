// SPDX-License-Identifier: BSD-3-Clause
// The cost of ten iterations of `sequential_impulses` on a thousand cubes, 7600 points, beside Bullet's solver on the
// same points (btSequentialImpulseConstraintSolver as it is by default, with one direction of friction, and with two).
// A step's whole resolve(): sorting the contacts into batches, warm start, iterations, reading out.
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "collision/response/sequential_impulses.hpp"

#ifdef POLHODE_HAS_BULLET
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#endif

namespace {

using namespace polhode;

constexpr int side = 10, iterations = 10;
constexpr double step = 1 / 60.0, fall = -9.81 * step;

/// Cubes on a floor, each beside its neighbours in x and on top of another.
struct Pile {
  std::vector<ImpulseBody> bodies{1};
  std::vector<ImpulseContact> contacts;

  Pile() {
    for (int z = 0; z < side; ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          ImpulseBody& b = bodies.emplace_back();
          b.position = {double(x), 1.5 * y, z + 0.5};
          b.inverse_mass = 1;
          b.inverse_inertia = 6 * Matrix3<double>::Identity();
          b.velocity = {0.01 * std::sin(x + 2.0 * z), 0.01 * std::cos(3.0 * x + y), fall};
        }
      }
    }
    for (std::uint32_t a = 0; a < bodies.size(); ++a) {
      const auto cell = [](std::uint32_t i) {
        return std::array<int, 3>{int(i - 1) % 10, int(i - 1) / 10 % 10, int(i - 1) / 100};
      };
      if (a == 0) {
        for (std::uint32_t b = 1; b <= side * side; ++b)
          touch(0, b, {0, 0, -1}, bodies[b].position - Vector3<double>(0, 0, 0.5));
        continue;
      }
      const Vector3<double>& p = bodies[a].position;
      if (cell(a)[0] + 1 < side) touch(a, a + 1, {-1, 0, 0}, p + Vector3<double>(0.5, 0, 0));
      if (cell(a)[2] + 1 < side) touch(a, a + side * side, {0, 0, -1}, p + Vector3<double>(0, 0, 0.5));
    }
  }

  void touch(std::uint32_t a, std::uint32_t b, const Vector3<double>& normal, const Vector3<double>& middle) {
    const Vector3<double> t = normal.unitOrthogonal(), u = normal.cross(t);
    for (std::uint32_t k = 0; k < 4; ++k) {
      ImpulseContact c;
      c.a = a;
      c.b = b;
      c.normal = normal;
      c.point = middle + (k % 2 ? 0.5 : -0.5) * t + (k / 2 ? 0.5 : -0.5) * u;
      c.friction = 0.5;
      c.feature = {Feature::Kind::vertex_face, k, 0};
      contacts.push_back(c);
    }
  }
};

void count(benchmark::State& state, std::size_t points) {
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(points) * iterations);
}

void sequential(benchmark::State& state) {
  const Pile pile;
  std::vector<ImpulseBody> bodies;
  std::vector<ImpulseContact> contacts = pile.contacts;
  SequentialSettings settings;
  settings.in_step = iterations;
  settings.step_tolerance = 0;
  const auto response = make_sequential_impulses(settings);
  for (auto _ : state) {
    bodies = pile.bodies;
    response->resolve(bodies, contacts, step);
    benchmark::DoNotOptimize(bodies.data());
  }
  count(state, contacts.size());
}
BENCHMARK(sequential)->Unit(benchmark::kMicrosecond);

#ifdef POLHODE_HAS_BULLET
btVector3 bullet(const Vector3<double>& v) { return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])}; }

void bullet_solver(benchmark::State& state) {
  const Pile pile;
  btBoxShape shape({0.5, 0.5, 0.5});
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<btCollisionObject*> objects;
  for (const ImpulseBody& b : pile.bodies) {
    btRigidBody::btRigidBodyConstructionInfo info(btScalar(b.inverse_mass), nullptr, &shape, btVector3(1, 1, 1) / 6);
    info.m_startWorldTransform.setOrigin(bullet(b.position));
    info.m_friction = btScalar(0.70710678);
    bodies.push_back(std::make_unique<btRigidBody>(info));
    objects.push_back(bodies.back().get());
  }
  std::vector<std::unique_ptr<btPersistentManifold>> owned;
  std::vector<btPersistentManifold*> manifolds;
  for (std::size_t i = 0; i < pile.contacts.size(); i += 4) {
    const ImpulseContact& first = pile.contacts[i];
    owned.push_back(std::make_unique<btPersistentManifold>(bodies[first.a].get(), bodies[first.b].get(), 0,
                                                           btScalar(0.02), btScalar(0.02)));
    for (std::size_t k = i; k < i + 4; ++k) {
      const ImpulseContact& c = pile.contacts[k];
      const Vector3<double> on_a = c.point - pile.bodies[c.a].position, on_b = c.point - pile.bodies[c.b].position;
      btManifoldPoint point(bullet(on_a), bullet(on_b), bullet(c.normal), 0);
      point.m_positionWorldOnA = point.m_positionWorldOnB = bullet(c.point);
      point.m_combinedFriction = btScalar(0.5);
      owned.back()->addManifoldPoint(point);
    }
    manifolds.push_back(owned.back().get());
  }
  btContactSolverInfo info;
  info.m_numIterations = iterations;
  info.m_timeStep = btScalar(step);
  if (state.range(0) == 2) info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  btSequentialImpulseConstraintSolver solver;
  for (auto _ : state) {
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      bodies[i]->setLinearVelocity(bullet(pile.bodies[i].velocity));
      bodies[i]->setAngularVelocity(btVector3(0, 0, 0));
    }
    solver.solveGroup(objects.data(), int(objects.size()), manifolds.data(), int(manifolds.size()), nullptr, 0, info,
                      nullptr, nullptr);
  }
  count(state, pile.contacts.size());
}
BENCHMARK(bullet_solver)->ArgName("directions")->Arg(1)->Arg(2)->Unit(benchmark::kMicrosecond);
#else
void bullet_solver(benchmark::State& state) { state.SkipWithError("skipped, because libbullet-dev is not installed"); }
BENCHMARK(bullet_solver);
#endif

}  // namespace

BENCHMARK_MAIN();
