// SPDX-License-Identifier: BSD-3-Clause
// The laws of every timing of impacts, whatever the scene.
#include <gtest/gtest.h>

#include <ostream>

#include "collision/contact/impact_timing.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/half_space.hpp"
#include "collision/shapes/sphere.hpp"
#include "core/problem/inertia.hpp"
#include "integrators/catalogue.hpp"
#include "tests/laws/allocations.hpp"

namespace polhode {

inline void PrintTo(const ImpactTimingEntry& e, std::ostream* out) { *out << e.name; }

namespace laws::impact_timing_law_test {
namespace {

using Vector = Vector3<double>;

class ImpactTimingLaw : public testing::TestWithParam<ImpactTimingEntry> {};

TEST_P(ImpactTimingLaw, HasANameAndASummary) {
  EXPECT_FALSE(GetParam().summary.empty());
  EXPECT_NE(find_impact_timing(GetParam().name), nullptr);
}

// A block that slides, a ball that rolls and one that bounces.
TEST_P(ImpactTimingLaw, ASteadySceneTakesNoMemory) {
  Problem problem;
  std::vector<Collider> colliders;
  const auto add = [&](ShapePointer shape, const BodyStart& start, double restitution) {
    Body body;
    const bool moves = shape->finite();
    if (moves) body.inertia = shape->mass_properties().inertia / shape->mass_properties().volume;
    body.fixed = !moves;
    problem.bodies.push_back(body);
    problem.starts.push_back(start);
    colliders.push_back({std::move(shape), restitution, 0.3});
  };
  add(std::make_shared<Box>(Vector(0.5, 0.5, 0.5)), {.position = {0, 0, 0.5}, .velocity = {3, 0, 0}}, 0);
  add(std::make_shared<Sphere>(0.5), {.position = {0, 5, 0.5}, .velocity = {3, 0, 0}, .angular_velocity = {0, 6, 0}},
      0);
  add(std::make_shared<Sphere>(0.5), {.position = {0, 9, 0.51}, .angular_velocity = {1, 2, 3}}, 0.9);
  add(std::make_shared<HalfSpace>(Vector(0, 0, 1)), {}, 0);
  problem.forces.push_back({"uniform_gravity", {0, 1, 2}, {{"acceleration", Vector(0, 0, -9.81)}}});
  const auto system = make_system<double>(problem, {});
  ContactScene scene(problem, colliders, "sweep_and_prune", "gjk");
  const auto contact = GetParam().make(*system, scene, find_response("sequential_impulses")->make());
  const auto method = find_integrator("rk4")->make(*system, {.dt = 1e-3});
  State<double> state = system->start();
  contact->begin(*method, state);
  method->begin(state);
  const auto go = [&](int steps) {
    for (int k = 0; k < steps; ++k) ASSERT_TRUE(contact->step(*method, state, 1e-3).ok());
  };
  go(200);
  const std::size_t before = allocations();
  go(100);
  EXPECT_EQ(allocations(), before);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ImpactTimingLaw, testing::ValuesIn(impact_timing_catalogue()),
                         [](const auto& timing) { return timing.param.name; });

}  // namespace
}  // namespace laws::impact_timing_law_test
}  // namespace polhode
