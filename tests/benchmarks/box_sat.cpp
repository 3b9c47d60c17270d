// SPDX-License-Identifier: BSD-3-Clause
// The cost of `sat` on two boxes, per pair, beside ODE's dBoxTouchesBox (overlap) and Bullet's btBoxBoxDetector
// (contacts), on the same mixed set of pairs. The lines: overlap at most 0.7 times ODE, in lanes 0.3 times with
// AVX-512, contacts at most 0.7 times Bullet.
#include "collision/narrow/box_sat.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "core/math/portable_random.hpp"

#ifdef POLHODE_HAS_ODE
#include <ode/collision.h>
#endif
#ifdef POLHODE_HAS_BULLET
#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#endif

namespace {

using namespace polhode;

struct Pairs {
  std::vector<PosedBox> boxes;
  std::vector<BodyPair> pairs;
  std::vector<std::unique_ptr<Box>> shapes;

  /// Boxes of similar size at random, four in five of the pairs together.
  Pairs() {
    PortableRandom random(7);
    for (std::uint32_t k = 0; k < 1024; ++k) {
      for (int side = 0; side < 2; ++side) {
        PosedBox box{random.uniform_vector(0.5, 1.5), {Vector3<double>::Zero(), random.rotation()}};
        if (side == 1) box.pose.position = random.direction() * random.uniform(1, 3);
        shapes.push_back(std::make_unique<Box>(box.half));
        boxes.push_back(box);
      }
      pairs.push_back({2 * k, 2 * k + 1});
    }
  }
};

const Pairs& set() {
  static const Pairs pairs;
  return pairs;
}

void finish(benchmark::State& state, std::size_t found) {
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(set().pairs.size()));
  state.counters["share"] = double(found) / double(set().pairs.size());
}

void sat_overlap(benchmark::State& state) {
  const auto narrow = find_narrow_phase("sat")->make();
  const Pairs& all = set();
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (const BodyPair p : all.pairs) {
      found += narrow->overlap(*all.shapes[p.a], all.boxes[p.a].pose, *all.shapes[p.b], all.boxes[p.b].pose);
    }
    benchmark::DoNotOptimize(found);
  }
  finish(state, found);
}
BENCHMARK(sat_overlap);

void sat_overlap_in_lanes(benchmark::State& state) {
  const Pairs& all = set();
  std::vector<std::uint8_t> overlap(all.pairs.size());
  for (auto _ : state) {
    boxes_overlap(all.boxes, all.pairs, overlap);
    benchmark::ClobberMemory();
  }
  std::size_t found = 0;
  for (const auto o : overlap) found += o;
  finish(state, found);
}
BENCHMARK(sat_overlap_in_lanes);

void sat_distance(benchmark::State& state) {
  const auto narrow = find_narrow_phase("sat")->make();
  const Pairs& all = set();
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (const BodyPair p : all.pairs) {
      found +=
          narrow->distance(*all.shapes[p.a], all.boxes[p.a].pose, *all.shapes[p.b], all.boxes[p.b].pose).distance <= 0;
    }
    benchmark::DoNotOptimize(found);
  }
  finish(state, found);
}
BENCHMARK(sat_distance);

void sat_manifold(benchmark::State& state) {
  const auto narrow = find_narrow_phase("sat")->make();
  const Pairs& all = set();
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (const BodyPair p : all.pairs) {
      found += narrow->manifold(*all.shapes[p.a], all.boxes[p.a].pose, *all.shapes[p.b], all.boxes[p.b].pose).count > 0;
    }
    benchmark::DoNotOptimize(found);
  }
  finish(state, found);
}
BENCHMARK(sat_manifold);

#ifdef POLHODE_HAS_ODE
void ode_touches(benchmark::State& state) {
  struct OdeBox {
    dVector3 position, sides;
    dMatrix3 rotation;
  };
  std::vector<OdeBox> boxes;
  for (const PosedBox& box : set().boxes) {
    OdeBox& b = boxes.emplace_back();
    for (int i = 0; i < 3; ++i) {
      b.position[i] = box.pose.position[i];
      b.sides[i] = 2 * box.half[i];
      for (int j = 0; j < 3; ++j) b.rotation[4 * i + j] = box.pose.rotation(i, j);
    }
  }
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (const BodyPair p : set().pairs) {
      const OdeBox &a = boxes[p.a], &b = boxes[p.b];
      found += dBoxTouchesBox(a.position, a.rotation, a.sides, b.position, b.rotation, b.sides) != 0;
    }
    benchmark::DoNotOptimize(found);
  }
  finish(state, found);
}
BENCHMARK(ode_touches);
#else
void ode_touches(benchmark::State& state) { state.SkipWithError("skipped, because libode-dev is not installed"); }
BENCHMARK(ode_touches);
#endif

#ifdef POLHODE_HAS_BULLET
void bullet_contacts(benchmark::State& state) {
  struct Points final : btDiscreteCollisionDetectorInterface::Result {
    std::size_t count = 0;
    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3&, const btVector3&, btScalar) override { ++count; }
  };
  std::vector<btBoxShape> shapes;
  std::vector<btTransform> poses;
  for (const PosedBox& box : set().boxes) {
    shapes.emplace_back(btVector3(btScalar(box.half[0]), btScalar(box.half[1]), btScalar(box.half[2])));
    const auto& r = box.pose.rotation;
    const auto& p = box.pose.position;
    const auto n = [](double x) { return btScalar(x); };
    poses.emplace_back(btMatrix3x3(n(r(0, 0)), n(r(0, 1)), n(r(0, 2)), n(r(1, 0)), n(r(1, 1)), n(r(1, 2)), n(r(2, 0)),
                                   n(r(2, 1)), n(r(2, 2))),
                       btVector3(n(p[0]), n(p[1]), n(p[2])));
  }
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (const BodyPair p : set().pairs) {
      btBoxBoxDetector detector(&shapes[p.a], &shapes[p.b]);
      btDiscreteCollisionDetectorInterface::ClosestPointInput input;
      input.m_transformA = poses[p.a];
      input.m_transformB = poses[p.b];
      Points points;
      detector.getClosestPoints(input, points, nullptr);
      found += points.count > 0;
    }
    benchmark::DoNotOptimize(found);
  }
  finish(state, found);
}
BENCHMARK(bullet_contacts);
#else
void bullet_contacts(benchmark::State& state) {
  state.SkipWithError("skipped, because libbullet-dev is not installed");
}
BENCHMARK(bullet_contacts);
#endif

}  // namespace

BENCHMARK_MAIN();
