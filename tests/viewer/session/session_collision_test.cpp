// SPDX-License-Identifier: BSD-3-Clause
// A session pauses where bodies newly meet, shows where they touch, and goes on to the next meeting.
#include <cmath>

#include "tests/viewer/session/session_run.hpp"

namespace polhode::viewer::session_collision_test {
namespace {

constexpr double g = 9.81, height = 4.9, restitution = 0.5;  // the height is that of the ball's lower end

Configuration ball(const std::string& integrator, double dt, const std::string& timing) {
  Configuration c = with("bouncing_ball", integrator, dt, 4);
  c.run.contact->impact_timing = timing;
  return c;
}

/// The n-th impact, from 1.
double impact_time(int n) {
  const double first = std::sqrt(2 * height / g);
  double t = first;
  for (int k = 1; k < n; ++k) t += 2 * std::pow(restitution, k) * first;
  return t;
}

class PausesAtImpacts : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Sessions, PausesAtImpacts, testing::Values("rk4", "cvode_adams"),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(PausesAtImpacts, WhereTheyAre) {
  const auto session = open("bouncing_ball", ball(GetParam(), 0.013, "event_located"));
  session->pause_on_collision(true);
  for (int n = 1; n <= 4; ++n) {
    const auto view = play_to_end(*session);
    ASSERT_TRUE(view->status.paused_at_collision) << n;
    EXPECT_FALSE(view->status.playing);
    EXPECT_NEAR(view->frame.t, impact_time(n), 1e-6);
    EXPECT_NEAR(view->frame.bodies[0].position[2], 0.1, 1e-6) << "it touches";
    EXPECT_LT(view->frame.bodies[0].velocity[2], 0) << "and has not turned round yet";
    ASSERT_EQ(view->frame.contacts.size(), 1u);
    const FrameContact& c = view->frame.contacts[0];
    EXPECT_EQ(c.a, 0u);
    EXPECT_EQ(c.b, 1u);
    EXPECT_LT((c.normal - Vector3<double>(0, 0, 1)).norm(), 1e-12);
    EXPECT_LT(c.point.norm(), 1e-6);
    EXPECT_LT(std::abs(c.depth), 1e-6);
  }
  session->pause_on_collision(false);
  EXPECT_TRUE(play_to_end(*session)->status.at_end);
}

TEST(SessionCollision, PausesAtTheStep) {
  const auto session = open("bouncing_ball", ball("semi_implicit_euler", 1e-3, "time_stepping"));
  session->pause_on_collision(true);
  for (int n = 1; n <= 3; ++n) {
    const auto view = play_to_end(*session);
    ASSERT_TRUE(view->status.paused_at_collision) << n;
    EXPECT_NEAR(view->frame.t, impact_time(n), 0.02);
    ASSERT_EQ(view->frame.contacts.size(), 1u);
    EXPECT_GE(view->frame.contacts[0].depth, -1e-6);
    EXPECT_LT(view->frame.contacts[0].depth, 0.02);
    EXPECT_EQ(view->frame.t, static_cast<double>(view->frame.step) * 1e-3);
  }
}

// A scene of its own searches for the pause: the motion is the same without it.
TEST(SessionCollision, PausingChangesNoMotion) {
  for (const char* scenario : {"pile_10", "two_cubes"}) {
    const Configuration c = with(scenario, "semi_implicit_euler", 1e-2, 1.5);
    const auto watched = open(scenario, c), left_alone = open(scenario, c);
    watched->pause_on_collision(true);
    watched->want({true, true, {0}});
    int pauses = 0;
    while (!play_to_end(*watched)->status.at_end) ++pauses;
    EXPECT_GT(pauses, 0);
    EXPECT_LT(pauses, 60);
    EXPECT_TRUE(same(play_to_end(*watched)->frame, play_to_end(*left_alone)->frame)) << scenario;
  }
}

TEST(SessionCollision, ShowsContactsAndCellsWhereTheyAreAskedFor) {
  Configuration c = with("pile_10", "semi_implicit_euler", 1e-2, 5);
  c.run.contact->broad_phase = "uniform_grid";
  const auto session = open("pile_10", c);
  session->step(150);
  auto view = settled(*session);
  EXPECT_TRUE(view->frame.contacts.empty());
  EXPECT_TRUE(view->frame.cells.empty());
  session->want({true, true, {}});
  view = settled(*session);
  EXPECT_FALSE(view->frame.contacts.empty());
  EXPECT_FALSE(view->frame.cells.empty());
  session->scrub(0);
  EXPECT_TRUE(settled(*session)->frame.contacts.empty()) << "they stand above each other at the start";
}

// A contact that is there from the start, or that goes on, is none to pause at.
TEST(SessionCollision, RestingIsNoMeeting) {
  const Configuration c = with("stack", "semi_implicit_euler", 1e-2, 2);
  const auto session = open("stack", c);
  session->step(100);  // it has settled
  session->pause_on_collision(true);
  EXPECT_TRUE(play_to_end(*session)->status.at_end);
}

}  // namespace
}  // namespace polhode::viewer::session_collision_test
