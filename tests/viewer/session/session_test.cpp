// SPDX-License-Identifier: BSD-3-Clause
// A live session: its digits are those of the same run without a window, whatever the pace, the pauses and the times of
// the frames; and each command does what it says.
#include <gmock/gmock.h>

#include <cmath>
#include <thread>

#include "core/math/portable_random.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/trajectory/trajectory_files.hpp"
#include "experiments/viewer/session/pace.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/viewer/session/session_run.hpp"

namespace polhode::viewer::session_test {
namespace {

struct Case {
  std::string scenario, integrator;
  double dt, t_end;
  std::string timing = {};
};

class SameBytes : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Sessions, SameBytes,
                         testing::Values(Case{"peters_hsu", "rk4", 1e-2, 3}, Case{"dzhanibekov", "dmv", 7e-3, 1},
                                         Case{"two_bodies", "semi_implicit_euler", 1e-2, 1},
                                         Case{"pile_10", "semi_implicit_euler", 1e-2, 1.5, "time_stepping"},
                                         Case{"bouncing_ball", "rk4", 1e-2, 3, "event_located"},
                                         Case{"bouncing_ball", "cvode_adams", 0, 2, "event_located"},
                                         Case{"peters_hsu", "cvode_adams", 0, 3},
                                         Case{"double_pendulum", "rk4", 1e-2, 1},
                                         Case{"double_pendulum", "rattle", 1e-2, 1},
                                         Case{"two_bodies", "odeint_dopri5", 0, 1}),
                         [](const auto& param_info) {
                           const Case& c = param_info.param;
                           return c.scenario + "_" + c.integrator + "_" + c.timing;
                         });

/// Plays it to its end with whatever a hand may do that changes no motion.
void play_wildly(Session& session, PortableRandom& random) {
  for (int k = 0; k < 100000; ++k) {
    const auto view = session.view();
    if (view->status.at_end) return;
    switch (random.below(12)) {
      case 0: session.pause(); break;
      case 1: session.step(random.below(5)); break;
      case 2: session.set_speed(random.uniform(0.1, 30)); break;
      case 3: session.want({random.below(2) == 0, random.below(2) == 0, {0}, random.below(2) == 0}); break;
      case 4:
        session.scrub(random.uniform(0, 1));  // a look back
        session.scrub(1e9);
        break;
      case 5: session.settle(); break;
      default: session.play();
    }
    session.tick(random.uniform(0, 0.1));
  }
  FAIL() << "it does not come to its end";
}

TEST_P(SameBytes, AsWithoutAWindow) {
  const Case& c = GetParam();
  const study::Scenario scenario = scenario_of(c.scenario);
  Configuration configuration = with(c.scenario, c.integrator, c.dt, c.t_end);
  if (!c.timing.empty()) configuration.run.contact->impact_timing = c.timing;
  const TemporaryFolder folder;
  const study::RunResult run =
      study::carry_out(configuration.run, scenario, {study::TrajectoryFormat::csv, folder.path() / "run"}, nullptr);
  ASSERT_EQ(run.status, "ok") << run.message;
  study::finish_trajectories(study::TrajectoryFormat::csv, {folder.path() / "run"});
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    PortableRandom random(seed);
    SessionSetup setup;
    setup.scenario = c.scenario;
    setup.configuration = configuration;
    setup.trajectory = folder.path() / "session";
    setup.history_bytes = seed == 1 ? 1 : 64 << 20;
    {
      const auto session = live_session(setup);
      play_wildly(*session, random);
      const auto view = session->view();
      EXPECT_EQ(view->status.segment, 1);
      EXPECT_EQ(view->frame.step, run.steps);
      EXPECT_EQ(view->frame.t, c.t_end);
    }
    for (const char* name : {"trajectory.csv", "energy.csv", "events.csv"}) {
      ASSERT_EQ(text_of(folder.path() / "session/segment_1" / name), text_of(folder.path() / "run" / name)) << name;
    }
  }
}

TEST(Session, StandsAtItsStartUntilItPlays) {
  const auto session = open("peters_hsu", with("peters_hsu", "rk4", 0.25, 10));
  session->tick(0.5);
  EXPECT_EQ(settled(*session)->frame.step, 0);
  session->play();
  session->settle();
  EXPECT_EQ(session->view()->frame.step, 0) << "no time has passed";
  session->tick(0.75);
  auto view = settled(*session);
  EXPECT_EQ(view->frame.t, 0.75);
  EXPECT_EQ(view->frame.step, 3);
  EXPECT_TRUE(view->status.playing);
  session->set_speed(2);
  session->tick(0.25);
  EXPECT_EQ(settled(*session)->frame.t, 1.25);
  session->set_speed(0.5);
  session->tick(0.25);  // half a step is saved up
  EXPECT_EQ(settled(*session)->frame.t, 1.25);
  session->tick(0.25);
  EXPECT_EQ(settled(*session)->frame.t, 1.5);
  session->pause();
  session->settle();
  session->tick(1);
  EXPECT_EQ(settled(*session)->frame.t, 1.5);
  session->step(3);
  view = settled(*session);
  EXPECT_EQ(view->frame.t, 2.25);
  EXPECT_FALSE(view->status.playing);
  session->reset();
  view = settled(*session);
  EXPECT_EQ(view->frame.t, 0);
  EXPECT_EQ(view->frame.step, 0);
  EXPECT_EQ(view->frame.energy_drift, 0);
  EXPECT_EQ(view->plot.size(), 1u);
  for (const double bad : {0.0, -1.0, std::nan("")}) EXPECT_THROW(session->set_speed(bad), std::invalid_argument);
}

TEST(Session, EndsAtItsEnd) {
  const auto session = open("peters_hsu", with("peters_hsu", "rk4", 0.1, 1));
  session->step(1000);
  auto view = settled(*session);
  EXPECT_EQ(view->frame.step, 10);
  EXPECT_TRUE(view->status.at_end);
  EXPECT_FALSE(view->status.failed);
  session->play();
  view = settled(*session);
  EXPECT_FALSE(view->status.playing);
  session->scrub(0.5);
  session->play();
  session->tick(0.2);
  view = settled(*session);
  EXPECT_NEAR(view->frame.t, 0.7, 1e-12);
  EXPECT_EQ(view->status.segment, 2);
  Configuration longer = view->configuration;
  longer.run.t_end = 2;
  EXPECT_EQ(session->change(longer), "");
  session->step(1000);
  EXPECT_EQ(settled(*session)->frame.t, 2);
}

TEST(Session, GoesBackToWhatItKeptAndForgetsTheFutureOnlyWhenItGoesOn) {
  SessionSetup setup;
  setup.scenario = "peters_hsu";
  setup.configuration = with("peters_hsu", "rk4", 0.01, 10);
  setup.history_bytes = 1;  // as few states as there may be
  const auto session = live_session(setup);
  session->want({false, false, {0, 7}});
  session->step(100);
  const auto at_100 = settled(*session);
  session->step(100);
  const auto at_200 = settled(*session);
  EXPECT_EQ(at_200->traces.size(), 1u) << "there is no body 7";
  EXPECT_EQ(at_200->traces[0].points.size(), 201u);
  session->scrub(1.003);
  const auto back = settled(*session);
  EXPECT_TRUE(back->status.in_the_past);
  EXPECT_LE(std::abs(back->frame.t - 1.003), 0.17) << "16 states over 2 s";
  EXPECT_EQ(back->status.t_last, at_200->frame.t);
  session->scrub(5);
  const auto again = settled(*session);
  EXPECT_FALSE(again->status.in_the_past);
  EXPECT_TRUE(same(again->frame, at_200->frame));
  EXPECT_EQ(again->status.segment, 1);
  session->scrub(back->frame.t);
  session->step(1);
  const auto one_on = settled(*session);
  EXPECT_EQ(one_on->frame.step, back->frame.step + 1);
  EXPECT_EQ(one_on->plot.back().t, one_on->frame.t);
  EXPECT_EQ(one_on->traces[0].points.back().t, one_on->frame.t);
  EXPECT_EQ(one_on->status.t_last, one_on->frame.t);
  session->step(199 - back->frame.step);
  const auto other_way = settled(*session);
  EXPECT_EQ(other_way->status.segment, 2);
  EXPECT_EQ(other_way->frame.step, 200);
  EXPECT_NEAR(other_way->frame.t, 2, 1e-12);
  EXPECT_LT((other_way->frame.bodies[0].position - at_200->frame.bodies[0].position).norm(), 1e-12);
  EXPECT_EQ(other_way->plot.size(), 201u);
  for (std::size_t k = 1; k < other_way->plot.size(); ++k) EXPECT_GT(other_way->plot[k].t, other_way->plot[k - 1].t);
  session->scrub(-1);
  EXPECT_EQ(settled(*session)->frame.t, 0);
}

TEST(Session, KeepsABoundedNumberOfPoints) {
  const auto session = open("peters_hsu", with("peters_hsu", "semi_implicit_euler", 1e-4, 2));
  session->want({false, false, {0}});
  session->step(20000);
  const auto view = settled(*session);
  ASSERT_EQ(view->frame.step, 20000);
  EXPECT_LE(view->plot.size(), 2048u);
  EXPECT_GT(view->plot.size(), 1000u);
  EXPECT_EQ(view->traces[0].points.size(), view->plot.size());
  const double spacing = view->plot[1].t - view->plot[0].t;
  for (std::size_t k = 1; k < view->plot.size(); ++k) EXPECT_NEAR(view->plot[k].t - view->plot[k - 1].t, spacing, 1e-9);
}

// The motion does not depend on the formulation in which it is kept.
TEST(Session, ChangesItsFormulationWhileItRuns) {
  for (const char* scenario : {"peters_hsu", "five_cubes", "lagrange_top"}) {
    const auto session = open(scenario, with(scenario, "rk4", 1e-3, 10));
    session->step(500);
    const auto start = settled(*session);
    for (const Orientation o : {Orientation::matrix, Orientation::quaternion}) {
      for (const AngularState a :
           {AngularState::velocity_body, AngularState::momentum_world, AngularState::velocity_world}) {
        const auto before = settled(*session);
        Configuration c = before->configuration;
        c.run.formulation.orientation = o;
        c.run.formulation.angular_state = a;
        ASSERT_EQ(session->change(c), "");
        const auto after = settled(*session);
        EXPECT_EQ(after->frame.t, before->frame.t);
        EXPECT_EQ(after->frame.step, before->frame.step);
        ASSERT_EQ(after->frame.bodies.size(), before->frame.bodies.size());
        for (std::size_t i = 0; i < after->frame.bodies.size(); ++i) {
          const BodySnapshot<double>&x = before->frame.bodies[i], &y = after->frame.bodies[i];
          EXPECT_LT((x.position - y.position).norm(), 1e-15 * (1 + x.position.norm()));
          EXPECT_LT((x.velocity - y.velocity).norm(), 1e-14 * (1 + x.velocity.norm()));
          EXPECT_LT(angle_between<double>(x.orientation, y.orientation), 1e-14);
          EXPECT_LE((x.angular_velocity - y.angular_velocity).norm(), 1e-14 * x.angular_velocity.norm());
          EXPECT_LE((x.angular_momentum - y.angular_momentum).norm(), 1e-14 * x.angular_momentum.norm());
        }
      }
    }
    const auto end = settled(*session);
    EXPECT_EQ(end->status.segment, 7);
    const double change = end->frame.energy_drift - start->frame.energy_drift;
    EXPECT_LT(std::abs(change), 1e-13 * (1 + end->frame.kinetic)) << "one ledger for all";
  }
}

// Work, what projections inject and what contacts lose before a change are in the ledger after it.
TEST(Session, OneLedgerGoesThroughAllChanges) {
  const TemporaryFolder folder;
  const auto in_air = (folder.path() / "in_air.toml").string();
  std::ofstream(in_air)
      << "t_end = 10\n[[body]]\nname = \"box\"\nmass = 2\nshape = { kind = \"box\", size = [1, 2, 3] }\n"
         "velocity = [3, 1, -2]\nangular_velocity = [2, 1, -3]\n"
         "[[force]]\nkind = \"drag\"\nbodies = [\"box\"]\nlinear = 0.5\n";
  for (const std::string& scenario : {in_air, std::string("bouncing_ball")}) {
    Configuration c = with(scenario, "semi_implicit_euler", 1e-2, 10);
    c.run.formulation.orientation = Orientation::matrix;
    c.run.normalize = true;
    const auto session = open(scenario, c);
    session->step(150);
    for (const AngularState a :
         {AngularState::velocity_body, AngularState::momentum_world, AngularState::velocity_world}) {
      const auto before = settled(*session);
      c.run.formulation.angular_state = a;
      ASSERT_EQ(session->change(c), "");
      const auto after = settled(*session);
      EXPECT_NEAR(after->frame.energy_drift, before->frame.energy_drift, 1e-12 * (1 + after->frame.kinetic))
          << scenario;
      EXPECT_NEAR(after->frame.momentum_drift, before->frame.momentum_drift, 1e-12) << scenario;
      session->step(10);
    }
  }
}

TEST(Session, ChangesItsMethodWhileItRuns) {
  const auto session = open("peters_hsu", with("peters_hsu", "rk4", 1e-3, 10));
  session->step(500);
  Configuration c = settled(*session)->configuration;
  choose_integrator(c, "cvode_adams", 0, 1e-9);
  ASSERT_EQ(session->change(c), "");
  session->step(20);
  const auto by_cvode = settled(*session);
  EXPECT_EQ(by_cvode->configuration.run.integrator, "cvode_adams");
  EXPECT_EQ(by_cvode->frame.step, 520);
  EXPECT_GT(by_cvode->frame.t, 0.5);
  EXPECT_LT(std::abs(by_cvode->frame.energy_drift), 1e-6 * by_cvode->frame.kinetic);
}

TEST(Session, ARefusedChangeLeavesItAsItWas) {
  const auto session = open("pile_10", with("pile_10", "rk4", 1e-2, 1));
  session->step(5);
  const auto before = settled(*session);
  const auto refused = [&](const char* why, auto&& edit) {
    Configuration c = before->configuration;
    edit(c);
    EXPECT_THAT(session->change(c), testing::HasSubstr(why));
    EXPECT_TRUE(same(settled(*session)->frame, before->frame));
    EXPECT_EQ(session->view()->status.segment, 1);
  };
  refused("frame clock", [](Configuration& c) {
    c.drive = Drive::frame_clock;
    choose_integrator(c, "cvode_adams");
    c.run.contact->impact_timing = "event_located";
  });
  refused("event_located", [](Configuration& c) { choose_integrator(c, "cvode_adams"); });
  refused("did you mean", [](Configuration& c) { c.run.integrator = "rk44"; });
  refused("takes dt", [](Configuration& c) { c.run.dt.reset(); });
  refused("positive", [](Configuration& c) { c.run.dt = -1; });
  refused("too small", [](Configuration& c) { c.run.dt = 1e-300; });
  refused("double", [](Configuration& c) { c.run.precision = study::Precision::single_precision; });
  refused("no narrow phase", [](Configuration& c) { c.run.contact->narrow_phase = "sut"; });
  refused("has contact", [](Configuration& c) { c.run.contact.reset(); });
  refused("gyroscopic", [](Configuration& c) {
    c.run.formulation.gyroscopic = false;
    c.run.formulation.angular_state = AngularState::momentum_world;
  });
  EXPECT_THROW(open("peters_hsu", with("peters_hsu", "nonsense", 1, 1)), study::InputError);
  EXPECT_THROW(open("no_such", before->configuration), study::InputError);
}

TEST(Session, TheFrameClockTakesAStepForEachFrame) {
  Configuration c = with("peters_hsu", "rk4", 0.01, 10);
  c.drive = Drive::frame_clock;
  const auto session = open("peters_hsu", c);
  session->play();
  session->settle();
  double t = 0;
  std::int64_t steps = 0;
  for (const double dt : {0.016, 0.017, 0.0155, 0.1}) {
    session->tick(dt);
    t += dt;
    const auto view = settled(*session);
    EXPECT_EQ(view->frame.t, t);
    EXPECT_EQ(view->frame.step, ++steps);
  }
  session->pause();
  session->step(2);
  EXPECT_EQ(settled(*session)->frame.t, t + 0.01 + 0.01);
}

// Time is let go, and said, where the simulation does not keep up.
TEST(Session, SaysThatItIsSlowerThanWanted) {
  const auto session = open("peters_hsu", with("peters_hsu", "rk4", 1e-6, 1000));
  session->set_speed(1000);
  session->play();
  auto view = session->view();
  for (int k = 0; k < 1000000 && !view->status.slower_than_wanted; ++k) {
    session->tick(0.1);
    std::this_thread::yield();
    view = session->view();
  }
  EXPECT_TRUE(view->status.slower_than_wanted);
  EXPECT_LT(view->status.pace, 1000);
}

// However slow a step is, what is owed stays bounded: no tick makes the next one longer.
TEST(Pace, FallsBehindByNoMoreThanItsBound) {
  Pace pace;
  pace.set_speed(2);
  double taken = 0;
  for (int k = 0; k < 600; ++k) {
    pace.tick(0.1, 0.01);
    for (int n = 0; n < 3 && pace.take(0.01); ++n) {
      taken += 0.01;
      pace.went(0.01);
    }
  }
  EXPECT_NEAR(taken, 18, 1e-9);
  EXPECT_TRUE(pace.slower());
  EXPECT_NEAR(pace.pace(), 0.3, 0.01);
  int left = 0;
  while (pace.take(0.01)) ++left;
  EXPECT_LE(left, 70) << "a quarter of a second and a tick, twice as fast";
  for (int k = 0; k < 30; ++k) {
    pace.tick(0.1, 0.01);
    while (pace.take(0.01)) pace.went(0.01);
  }
  EXPECT_FALSE(pace.slower());
  EXPECT_NEAR(pace.pace(), 2, 0.05);
  pace.tick(0.1, 5);
  while (!pace.take(5)) pace.tick(0.1, 5);  // a step longer than the bound is saved up for
}

// Side by side none runs ahead: all wait for the slowest.
TEST(Session, GoTogetherThoughOneIsSlow) {
  constexpr double speed = 500, tick = 0.05;
  std::vector<std::unique_ptr<Session>> sessions;
  for (const double dt : {0.05, 1e-5}) sessions.push_back(open("peters_hsu", with("peters_hsu", "rk4", dt, 1e6)));
  for (const auto& session : sessions) {
    session->set_speed(speed);
    session->play();
    session->settle();
  }
  for (int k = 0; k < 200; ++k) {
    tick_together(sessions, tick);
    sessions[0]->settle();  // it takes what it is given
  }
  std::vector<double> t;
  for (const auto& session : sessions) {
    session->pause();
    session->settle();
    t.push_back(session->view()->frame.t);
  }
  EXPECT_GT(t[0], 0);
  EXPECT_LT(t[0] - t[1], speed * (Pace::longest_behind + tick) + 2);
  tick_together(sessions, -1);
  tick_together({}, 1);
}

TEST(Session, AFailedMotionStopsAndCanBeTakenBack) {
  Configuration c = with("peters_hsu", "explicit_euler", 0.5, 1000);
  const auto session = open("peters_hsu", c);
  session->step(100000);
  auto view = settled(*session);
  ASSERT_TRUE(view->status.failed);
  EXPECT_THAT(view->status.message, testing::HasSubstr("at t ="));
  EXPECT_TRUE(std::isfinite(view->frame.kinetic));
  session->play();
  EXPECT_FALSE(settled(*session)->status.playing);
  session->scrub(0.5);
  choose_integrator(c, "rk4", 0.01);
  ASSERT_EQ(session->change(c), "");
  session->step(10);
  view = settled(*session);
  EXPECT_FALSE(view->status.failed);
  EXPECT_EQ(view->status.message, "");
  EXPECT_NEAR(view->frame.t, 0.6, 1e-12);
}

TEST(Session, EndsWhileItPlays) {
  for (int k = 0; k < 20; ++k) {
    const auto session = open("pile_10", with("pile_10", "rk4", 1e-4, 1000));
    session->play();
    for (int n = 0; n < k; ++n) session->tick(0.5);
  }
}

}  // namespace
}  // namespace polhode::viewer::session_test
