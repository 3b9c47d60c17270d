// SPDX-License-Identifier: BSD-3-Clause
// Piles and stacks at rest, time-stepping at 1/60 s.
#include "tests/collision/response/pile.hpp"

#include <algorithm>

#include "tests/collision/contact/contact_run.hpp"

namespace polhode::pile_test {
namespace {

using Vector = Vector3<double>;

/// Energies of a run, and where the bodies are at the end of each step.
struct Watch final : Observer {
  double first = 0, least = 0, rise = 0;  ///< energy at the start, least energy so far, and largest rise above it, J
  bool started = false;
  std::size_t on_samples(std::span<const Sample> seen) override {
    for (const Sample& s : seen) {
      const double energy = s.seen.energy();
      if (!started) first = least = energy;
      started = true;
      rise = std::max(rise, energy - least);
      least = std::min(least, energy);
    }
    return seen.size();
  }
};

class Piles : public testing::TestWithParam<int> {};

/// Lines of issue and paper alike: the energy does not rise, no body leaves or passes through another, and none is deep
/// in another.
void drop(int cubes, double t_end) {
  const Pile pile(cubes);
  const auto system = make_system<double>(pile.problem, {});
  ContactScene scene(pile.problem, pile.colliders, "sweep_and_prune", "sat");
  TimeStepping contact(*system, scene, find_response("sequential_impulses")->make());
  constexpr double dt = 1 / 60.0;
  const auto method = find_integrator("semi_implicit_euler")->make(*system, {.dt = dt, .t_end = t_end});
  State<double> state = system->start();
  Watch watch;
  const RunOutcome outcome =
      simulate<double>(*system, *system, *method, state, {.t_end = t_end, .dt = dt, .samples = {}, .normalize = true},
                       watch, nullptr, &contact);
  ASSERT_EQ(outcome.status, RunStatus::ok) << outcome.message;
  EXPECT_LE(watch.rise, 1e-3 * watch.first);
  std::vector<Pose> poses;
  shape_poses(*system, state.y, poses);
  double fastest = 0;
  for (std::size_t i = 0; i < system->moving(); ++i) {
    for (const auto& [normal, offset] : pile.walls()) EXPECT_GE(normal.dot(poses[i].position) - offset, 0.49);
    fastest = std::max(fastest, system->motion_of(state.y, i).velocity.norm());
    for (std::size_t j = 0; j < i; ++j) ASSERT_GE((poses[i].position - poses[j].position).norm(), 0.98);
  }
  EXPECT_LE(fastest, 0.5);
  ContactScene look(pile.problem, pile.colliders, "sweep_and_prune", "gjk");
  look.near_pairs(poses, poses, {}, 0);
  double deepest = 0;
  for (const ImpulseContact& c : look.contacts(poses, 0)) deepest = std::max(deepest, c.depth);
  EXPECT_GT(deepest, 0);
  EXPECT_LE(deepest, 0.01);
}

TEST(Pile, TenCubes) { drop(10, 10); }
TEST(Pile, AHundredCubes) { drop(100, 10); }
TEST(Pile, SlowAThousandCubes) { drop(1000, 10); }

/// Ten boxes of 1 m on a floor, each shifted by `offset` (m) to one side or the other.
void stand(double offset) {
  ContactRun run;
  run.method = "semi_implicit_euler";
  run.timing = Timing::at_step;
  run.dt = 1 / 60.0;
  const auto cube = std::make_shared<Box>(Vector(0.5, 0.5, 0.5));
  constexpr int boxes = 10;
  for (int k = 0; k < boxes; ++k) {
    BodyStart start;
    start.position = {offset * (k % 2 ? 1 : -1), 0.7 * offset * (k % 3 - 1), 0.5 + k};
    run.add(1, cube, start, 0, 0.5);
  }
  run.add_floor(0, 0.5);
  run.add_gravity();
  const auto after = [&](double t) {
    run.t_end = t;
    run.run();
    std::vector<Vector> centres;
    const auto system = make_system<double>(run.problem, run.formulation);
    for (std::size_t i = 0; i < boxes; ++i) centres.push_back(system->snapshot(run.end.y, i).position);
    return centres;
  };
  const std::vector<Vector> early = after(2), late = after(60);
  for (std::size_t k = 0; k < boxes; ++k) {
    EXPECT_LE((late[k] - early[k]).norm(), 1e-3) << "box " << k;
    EXPECT_NEAR(late[k][2], 0.5 + double(k), 5e-3 * double(k + 1)) << "box " << k;
  }
  ContactScene look(run.problem, run.colliders, "sweep_and_prune", "sat");
  std::vector<Pose> poses;
  shape_poses(*make_system<double>(run.problem, run.formulation), run.end.y, poses);
  look.near_pairs(poses, poses, {}, 0.01);
  for (const ImpulseContact& c : look.contacts(poses, 0.01)) EXPECT_LE(c.depth, 5e-3);
}

TEST(Stack, OfTenBoxesStands) { stand(0); }
TEST(Stack, OfTenStaggeredBoxesStands) { stand(0.1); }

}  // namespace
}  // namespace polhode::pile_test
