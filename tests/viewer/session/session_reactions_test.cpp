// SPDX-License-Identifier: BSD-3-Clause
// Sessions show the reactions of joints: those of the method where it has its own, else those of the state.
#include "experiments/study/run/run.hpp"
#include "experiments/study/trajectory/reaction_reader.hpp"
#include "experiments/study/trajectory/trajectory_files.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/viewer/session/session_run.hpp"

namespace polhode::viewer::session_reactions_test {
namespace {

Wanted with_reactions() {
  Wanted wanted;
  wanted.reactions = true;
  return wanted;
}

std::vector<FrameReaction> seen(Session& session, const Wanted& wanted = with_reactions()) {
  session.want(wanted);
  return settled(session)->frame.reactions;
}

TEST(SessionReactions, OfAHangingBodyPointUp) {
  SessionSetup setup;
  setup.scenario = "rod_pendulum";
  setup.overrides = {{"body.0.position", "[0,-1,0]"}};
  const auto session = live_session(setup);
  EXPECT_TRUE(seen(*session, {}).empty()) << "they were not asked for";
  for (int k = 0; k < 2; ++k) {
    const auto reactions = seen(*session);
    ASSERT_EQ(reactions.size(), 1u);
    EXPECT_LT((reactions[0].force - Vector3<double>(0, 9.81, 0)).norm(), 1e-9);
    EXPECT_LT((reactions[0].point - Vector3<double>(0, -1, 0)).norm(), 1e-9) << "on the bob";
    session->step(3);
  }
}

TEST(SessionReactions, StandWhereADiskTouchesTheFloor) {
  const auto session = open("rolling_disk", with("rolling_disk", "rk4", 0.01, 1));
  session->step(20);
  const auto reactions = seen(*session);
  ASSERT_EQ(reactions.size(), 1u);
  EXPECT_NEAR(reactions[0].point[2], 0, 1e-4);
  const Vector3<double> center = session->view()->frame.bodies[0].position;
  EXPECT_NEAR((reactions[0].point - center).norm(), 1, 1e-12) << "its radius";
  EXPECT_GT(reactions[0].force[2], 0);
}

/// A run of the double pendulum by a method, recorded as studies record it, and its forces.
struct PendulumRun {
  static constexpr int steps = 20;
  static constexpr double dt = 0.05;
  TemporaryFolder folder;
  Configuration configuration;
  std::vector<Vector3<double>> forces;

  explicit PendulumRun(const std::string& method, Stabilization stabilization = Stabilization::none)
      : configuration(with("double_pendulum", method, dt, steps * dt)) {
    configuration.run.joints->stabilization = stabilization;
    const study::Scenario scenario = scenario_of("double_pendulum");
    study::carry_out(configuration.run, scenario, {study::TrajectoryFormat::csv, folder.path()}, nullptr);
    study::finish_trajectories(study::TrajectoryFormat::csv, {folder.path()});
    std::vector<double> times;
    for (int k = 0; k <= steps; ++k) times.push_back(k < steps ? k * dt : steps * dt);
    forces = study::read_reactions(folder.path(), times, 2);
  }
  std::unique_ptr<Session> session() const {
    return recorded_session((folder.path() / "trajectory.csv").string(), "double_pendulum");
  }
};

void expect_forces(const std::vector<FrameReaction>& seen, const Vector3<double>* forces) {
  ASSERT_EQ(seen.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((seen[i].force - forces[i]).norm(), 1e-12) << i;
}

using Case = std::pair<std::string, Stabilization>;
class ReactionsOf : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Sessions, ReactionsOf,
                         testing::Values(Case{"rk4", Stabilization::none}, Case{"rk4", Stabilization::baumgarte},
                                         Case{"rk4", Stabilization::penalty}, Case{"rattle", Stabilization::none}),
                         [](const auto& param_info) {
                           return param_info.param.first + "_" + std::string(name(param_info.param.second));
                         });

TEST_P(ReactionsOf, AreThoseThatStudiesRecord) {
  const PendulumRun run(GetParam().first, GetParam().second);
  ASSERT_EQ(run.forces.size(), 2u * (PendulumRun::steps + 1));
  const auto live = open("double_pendulum", run.configuration), recorded = run.session();
  for (const int step : {0, 7, 20}) {
    live->step(step - live->view()->frame.step);
    recorded->scrub(PendulumRun::dt * step);
    expect_forces(seen(*live), &run.forces[2 * std::size_t(step)]);
    expect_forces(seen(*recorded), &run.forces[2 * std::size_t(step)]);
  }
  live->scrub(7 * PendulumRun::dt);
  expect_forces(seen(*live), &run.forces[14]);
}

// The reactions of this method are not those of the state: the test can tell which are shown.
TEST(SessionReactions, OfATrajectoryAloneFollowFromItsStates) {
  const PendulumRun run("rattle");
  std::filesystem::remove(run.folder.path() / "reactions.csv");
  const auto session = run.session();
  session->scrub(7 * PendulumRun::dt);
  const auto of_the_state = seen(*session);
  ASSERT_EQ(of_the_state.size(), 2u);
  const double off = (of_the_state[0].force - run.forces[14]).norm();
  EXPECT_GT(off, 1e-6);
  EXPECT_LT(off, 0.2 * run.forces[14].norm());
}

TEST(SessionReactions, OfAnotherMethodTakeTheirPlace) {
  const PendulumRun run("rattle");
  const auto session = open("double_pendulum", run.configuration);
  session->step(7);
  expect_forces(seen(*session), &run.forces[14]);
  Configuration other = run.configuration;
  choose_integrator(other, "rk4", PendulumRun::dt);
  ASSERT_EQ(session->change(other), "");
  session->step(0);
  EXPECT_GT((seen(*session)[0].force - run.forces[14]).norm(), 1e-6);
}

}  // namespace
}  // namespace polhode::viewer::session_reactions_test
