// SPDX-License-Identifier: BSD-3-Clause
// A recorded trajectory plays as a session does; and the time between two frames is what a clock says.
#include <gmock/gmock.h>

#include <cmath>
#include <deque>
#include <numbers>

#include "core/math/quaternion.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/trajectory/trajectory_files.hpp"
#include "experiments/viewer/window/frame_clock.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/viewer/session/session_run.hpp"

namespace polhode::viewer::recorded_session_test {
namespace {

/// A run of this configuration, beside the session that would make it.
struct Made {
  TemporaryFolder folder;
  Configuration configuration;
  std::string scenario;
  Made(const std::string& name, const Configuration& c) : configuration(c), scenario(name) {
    study::carry_out(c.run, scenario_of(name), {study::TrajectoryFormat::csv, folder.path()}, nullptr);
    study::finish_trajectories(study::TrajectoryFormat::csv, {folder.path()});
  }
  std::unique_ptr<Session> session(Between between = Between::interpolated) const {
    return recorded_session((folder.path() / "trajectory.csv").string(), scenario, {}, between);
  }
};

TEST(RecordedSession, ShowsWhatTheRunWas) {
  Configuration c = with("two_bodies", "rk4", 0.01, 1);
  for (const Orientation o : {Orientation::quaternion, Orientation::matrix}) {
    c.run.formulation.orientation = o;
    const Made made("two_bodies", c);
    const auto live = open("two_bodies", c), recorded = made.session();
    for (const std::int64_t step : {0, 37, 60}) {
      live->step(step - live->view()->frame.step);
      recorded->scrub(0.01 * double(step));
      const auto a = settled(*live), b = recorded->view();
      EXPECT_NEAR(a->frame.t, b->frame.t, 1e-15);
      EXPECT_NEAR(a->frame.kinetic, b->frame.kinetic, 1e-12 * std::abs(a->frame.kinetic));
      EXPECT_NEAR(a->frame.potential, b->frame.potential, 1e-12 * (1 + std::abs(a->frame.potential)));
      EXPECT_NEAR(a->frame.energy_drift, b->frame.energy_drift, 1e-12 * (1 + a->frame.kinetic));
      ASSERT_EQ(a->frame.bodies.size(), b->frame.bodies.size());
      for (std::size_t i = 0; i < a->frame.bodies.size(); ++i) {
        const BodySnapshot<double>&x = a->frame.bodies[i], &y = b->frame.bodies[i];
        EXPECT_LT((x.position - y.position).norm(), 1e-12);
        EXPECT_LT(angle_between<double>(x.orientation, y.orientation), 1e-12);
        EXPECT_LT((x.angular_velocity - y.angular_velocity).norm(), 1e-12);
      }
    }
  }
}

TEST(RecordedSession, PlaysAtItsSpeedToItsEnd) {
  const Made made("peters_hsu", with("peters_hsu", "rk4", 0.1, 2));
  const auto session = made.session();
  session->want({false, false, {0}});
  session->tick(1);
  EXPECT_EQ(session->view()->frame.t, 0) << "it does not play yet";
  session->play();
  session->set_speed(0.5);
  session->tick(0.5);
  EXPECT_DOUBLE_EQ(session->view()->frame.t, 0.25);
  EXPECT_EQ(session->view()->traces[0].points.size(), 3u);
  session->tick(100);
  EXPECT_EQ(session->view()->frame.t, 2);
  EXPECT_TRUE(session->view()->status.at_end);
  EXPECT_FALSE(session->view()->status.playing);
  session->reset();
  session->step(3);
  EXPECT_EQ(session->view()->frame.step, 3);
  EXPECT_THAT(session->change(session->view()->configuration), testing::HasSubstr("as it is"));
  EXPECT_EQ(session->view()->plot.size(), 21u);
}

// A body that turns evenly does so between its samples too.
TEST(RecordedSession, InterpolatesTurns) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "t.csv") << "t_s,px_m,py_m,pz_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n"
                                            "1,2,0,0,-0.7071067811865476,0,0,-0.7071067811865476\n";
  const auto session = recorded_session((folder.path() / "t.csv").string(), "peters_hsu");
  session->scrub(0.25);
  auto body = session->view()->frame.bodies[0];
  const double half = std::numbers::pi / 16;  // half of a quarter of the right angle
  EXPECT_LT(angle_between<double>(body.orientation, Quaternion<double>(std::cos(half), 0, 0, std::sin(half))), 1e-12);
  EXPECT_DOUBLE_EQ(body.position[0], 0.5);
  const auto nearest = recorded_session((folder.path() / "t.csv").string(), "peters_hsu", {}, Between::nearest);
  nearest->scrub(0.25);
  body = nearest->view()->frame.bodies[0];
  EXPECT_EQ(body.position[0], 0);
  EXPECT_EQ(nearest->view()->frame.t, 0);
  EXPECT_THROW(recorded_session("nowhere.csv", "peters_hsu"), study::InputError);
}

TEST(RecordedSession, PausesAtCollisions) {
  const Made made("bouncing_ball", with("bouncing_ball", "semi_implicit_euler", 0.01, 3));
  const auto session = made.session();
  session->pause_on_collision(true);
  const auto view = play_to_end(*session);
  EXPECT_TRUE(view->status.paused_at_collision);
  EXPECT_NEAR(view->frame.t, 1, 0.02);
  EXPECT_EQ(view->frame.contacts.size(), 1u);
}

TEST(FrameClock, SaysTheTimeBetweenTwoFrames) {
  std::deque<double> times = {7, 7.016, 7.016, 7.05, 7.01};
  FrameClock clock([&] {
    const double t = times.front();
    times.pop_front();
    return t;
  });
  EXPECT_EQ(clock.tick(), 0) << "there is no frame before the first";
  EXPECT_EQ(clock.tick(), 7.016 - 7);
  EXPECT_EQ(clock.tick(), 0);
  EXPECT_EQ(clock.tick(), 7.05 - 7.016);
  EXPECT_EQ(clock.tick(), 0) << "time does not go back";
}

}  // namespace
}  // namespace polhode::viewer::recorded_session_test
