// SPDX-License-Identifier: BSD-3-Clause
// Trajectories of other programs: what is read, what is refused and how it is said, and that nothing makes the reader
// fall over.
#include "experiments/study/trajectory/trajectory_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "experiments/judge/trajectory_score.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::trajectory_reader_test {
namespace {

using judge::score;

using testing::HasSubstr;

Problem bodies(std::size_t n) {
  Problem problem;
  problem.bodies.resize(n);
  problem.starts.resize(n);
  for (std::size_t i = 0; i < n; ++i) problem.bodies[i].name = fmt::format("b{}", i);
  return problem;
}

std::string complaint(const std::string& text, std::size_t n = 1) {
  try {
    parse_trajectory(text, "x.csv", bodies(n));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

const std::string head = "t_s,qw,qx,qy,qz,wx_rad_per_s,wy_rad_per_s,wz_rad_per_s\n";

TEST(TrajectoryReader, TakesColumnsByNameInAnyOrder) {
  const Trajectory t = parse_trajectory(
      "\xEF\xBB\xBF# an engine\r\nqz, \"t_s\",mood,qw,qx,qy\r\n0,0,fine,1,0,0\r\n\r\n.6, +0.5,bad,-8e-1,0,0\r\n",
      "x.csv", bodies(1));
  ASSERT_EQ(t.times.size(), 2u);
  EXPECT_EQ(t.times[1], 0.5);
  EXPECT_EQ(t.bodies[1].orientation, (Quaternion<double>(-0.8, 0, 0, 0.6)));
  EXPECT_FALSE(t.has_position || t.has_velocity || t.has_angular_velocity || t.has_energy || t.has_matrix);
}

TEST(TrajectoryReader, TakesTheMatrixAndBodiesInAnyOrder) {
  const std::string names = "body,t_s,energy_J,r11,r12,r13,r21,r22,r23,r31,r32,r33\n", turn = ",0,-1,0,1,0,0,0,0,1\n";
  const Trajectory t = parse_trajectory(
      names + "1,0,7" + turn + "0,0,7,1,0,0,0,1,0,0,0,1\n0,1,8" + turn + "1,1,8" + turn, "x.csv", bodies(2));
  ASSERT_TRUE(t.has_matrix && t.has_energy);
  EXPECT_EQ(t.bodies[0].rotation, (Matrix3<double>::Identity()));
  EXPECT_EQ(t.bodies[1].rotation(0, 1), -1);
  EXPECT_THAT(t.energy, testing::ElementsAre(7, 8));
}

TEST(TrajectoryReader, SaysWhatIsWrongAndWhere) {
  const std::string good = "0,1,0,0,0,0,0,1\n";
  EXPECT_THAT(complaint(""), HasSubstr("x.csv: there is nothing in it"));
  EXPECT_THAT(complaint(head + good), HasSubstr("1 instant(s)"));
  EXPECT_THAT(complaint("time,qw,qx,qy,qz\n"), HasSubstr("x.csv:1:1: there is no column t_s"));
  EXPECT_THAT(complaint("t_S,qw,qx,qy,qz\n"), HasSubstr("is it 't_S'?"));
  EXPECT_THAT(complaint("t_s,x\n"), HasSubstr("no column qw (of qw, qx, qy, qz), nor r11"));
  EXPECT_THAT(complaint("t_s,qw,qx,qy\n"), HasSubstr("lacks the column qz"));
  EXPECT_THAT(complaint("t_s,qw,qw,qx,qy,qz\n"), HasSubstr("x.csv:1:8: the column qw stands twice"));
  EXPECT_THAT(complaint(head, 2), HasSubstr("no column body"));
  EXPECT_THAT(complaint(head + good + "1,1,0,0,abc,0,0,1\n"),
              HasSubstr("x.csv:3:9: qz is 'abc', which is not a number"));
  EXPECT_THAT(complaint(head + good + "1,1,0,0,,0,0,1\n"), HasSubstr("x.csv:3:9: qz is empty"));
  EXPECT_THAT(complaint(head + good + "1,1,0,0,0,nan,0,1\n"), HasSubstr("x.csv:3:11: wx_rad_per_s is 'nan'"));
  EXPECT_THAT(complaint(head + good + "1,1,0,0,0,-inf,0,1\n"), HasSubstr("cut the file"));
  EXPECT_THAT(complaint(head + good + "1,1,0,0,0,1e999,0,1\n"), HasSubstr("not a number"));
  EXPECT_THAT(complaint(head + good + "1,1,0\n"), HasSubstr("x.csv:3:5: 3 cells under 8 column names"));
  EXPECT_THAT(complaint(head + "-1,1,0,0,0,0,0,1\n"), HasSubstr("t_s is negative"));
  EXPECT_THAT(complaint(head + "2,1,0,0,0,0,0,1\n" + good), HasSubstr("goes back from 2 to 0; sort"));
  EXPECT_THAT(complaint(head + good + good), HasSubstr("body 0 stands twice at t_s = 0"));
  EXPECT_THAT(complaint(head + "0,2,0,0,0,0,0,1\n"), HasSubstr("a quaternion of length 2 at the start"));
  EXPECT_THAT(complaint(head + good + "1,0,0,0,0,0,0,1\n"), HasSubstr("no orientation"));
  EXPECT_THAT(complaint("body," + head + "3," + good),
              HasSubstr("body is 3; the scenario's moving bodies are numbered 0 to 0"));
  EXPECT_THAT(complaint("body," + head + "0.5," + good), HasSubstr("body is 0.5"));
  EXPECT_THAT(complaint("body," + head + "0," + good + "0,1,1,0,0,0,0,0,1\n", 2),
              HasSubstr("body 1 ('b1') has no row at t_s = 0"));
  EXPECT_THAT(complaint("t_s,r11,r12,r13,r21,r22,r23,r31,r32,r33\n0,-1,0,0,0,1,0,0,0,1\n"), HasSubstr("det R = -1"));
  EXPECT_EQ(complaint(head + "0,0.999,0,0,0,0,0,1\n3,0.5,0,0,0,0,0,1\n"), "none");  // few digits, and a drifting length
}

TEST(TrajectoryReader, NeverFallsOver) {
  std::string valid = "body," + head;
  for (int k = 0; k < 6; ++k) {
    for (int i = 0; i < 2; ++i) valid += fmt::format("{},{},1,0,0,0,0.1,{},3\n", i, 0.5 * k, k);
  }
  std::mt19937 random(7);
  const std::string alphabet = "0123456789.,-+e\n\r\"#naif \t\0\xC3\xBFqtwxyz_";
  int read = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = valid;
    const auto at = [&] { return random() % (text.size() + 1); };
    for (unsigned edits = 1 + random() % 2; edits > 0; --edits) {
      switch (random() % 4) {
        case 0: text.insert(at(), 1, alphabet[random() % alphabet.size()]); break;
        case 1: text.erase(at(), random() % 8); break;
        case 2: text.insert(at(), text.substr(at(), random() % 40)); break;
        default:
          if (const auto k = at(); k < text.size()) text[k] = static_cast<char>(random() % 256);
      }
    }
    try {
      const Trajectory t = parse_trajectory(text, "x.csv", bodies(2));
      ++read;
      ASSERT_GE(t.times.size(), 2u);
      ASSERT_EQ(t.bodies.size(), 2 * t.times.size());
      for (std::size_t k = 1; k < t.times.size(); ++k) ASSERT_LT(t.times[k - 1], t.times[k]);
      for (const BodySnapshot<double>& b : t.bodies)
        ASSERT_TRUE(b.orientation.allFinite() && b.angular_velocity.allFinite());
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), testing::StartsWith("x.csv"));
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(read, 1000);  // the valid part of the space is seen too
  EXPECT_LT(read, 19000);
}

/// The exact motion of a scenario, as a file would have it.
Trajectory exact_trajectory(const Scenario& scenario, double duration, std::size_t n) {
  const auto system = make_system<double>(scenario.problem, {});
  const ExactMotion exact(*system);
  Trajectory t;
  t.has_position = t.has_velocity = t.has_angular_velocity = true;
  for (std::size_t k = 0; k <= n; ++k) {
    t.times.push_back(duration * static_cast<double>(k) / static_cast<double>(n));
    const auto at = exact.at(t.times.back(), 0);
    BodySnapshot<double> body;
    body.position = at.path->position;
    body.velocity = at.path->velocity;
    body.orientation = *at.rotation->orientation;
    body.rotation = rotation_matrix(body.orientation);
    body.angular_velocity = at.rotation->angular_velocity;
    t.bodies.push_back(body);
  }
  return t;
}

TEST(TrajectoryScore, OfTheExactMotionIsRoundOff) {
  const Scenario scenario = ScenarioSource::open("peters_hsu").resolve();
  const auto s = score(exact_trajectory(scenario, 10, 500), scenario, {});
  const RunResult& r = s.record.result;
  EXPECT_EQ(r.drift_class, "round-off");
  EXPECT_LE(*r.attitude_error_max, 1e-14);
  EXPECT_LE(*r.position_error_max, 1e-12);
  EXPECT_LE(*r.polhode_off_error_max_rel, 1e-13);
  EXPECT_TRUE(s.notes.empty());
}

TEST(TrajectoryScore, DerivesWhatIsMissingOrLeavesItEmpty) {
  const Scenario scenario = ScenarioSource::open("peters_hsu").resolve();
  Trajectory t = exact_trajectory(scenario, 10, 500);
  t.has_position = t.has_velocity = false;
  for (BodySnapshot<double>& b : t.bodies) b.position.setZero(), b.velocity.setZero();
  const auto rotation_only = score(t, scenario, {});
  EXPECT_EQ(rotation_only.record.result.drift_class, "round-off");
  EXPECT_FALSE(rotation_only.record.result.position_error_max);
  EXPECT_FALSE(rotation_only.notes.empty());
  t.has_angular_velocity = false;
  const auto attitude_only = score(t, scenario, {});
  EXPECT_FALSE(attitude_only.record.result.energy_drift_max || attitude_only.record.result.energy_round_off);
  EXPECT_FALSE(attitude_only.record.result.energy_drift_max_rel ||
               attitude_only.record.result.polhode_off_error_max_rel);
  EXPECT_LE(*attitude_only.record.result.attitude_error_max, 1e-14);
  t.has_angular_momentum = true;
  for (BodySnapshot<double>& b : t.bodies) {
    const Matrix3<double> r = rotation_matrix(b.orientation);
    b.angular_momentum = r * scenario.problem.bodies[0].inertia * (r.transpose() * b.angular_velocity);
  }
  const auto by_momentum = score(t, scenario, {});
  EXPECT_LE(*by_momentum.record.result.energy_drift_max_rel, 1e-13);
  EXPECT_LE(*by_momentum.record.result.angular_velocity_error_max_rel, 1e-13);
}

TEST(TrajectoryScore, SaysWhereTheStartIsAnother) {
  const Scenario scenario = ScenarioSource::open("peters_hsu").resolve();
  Trajectory t = exact_trajectory(scenario, 10, 500);
  for (BodySnapshot<double>& b : t.bodies) b.position.x() += 0.25;
  t.has_energy = true;
  t.energy.assign(t.times.size(), 1e3);
  const auto s = score(t, scenario, {});
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_THAT(s.notes[0], HasSubstr("a position 0.25 m away"));
  EXPECT_NEAR(*s.record.result.position_error_max, 0.25, 1e-12);
  EXPECT_NEAR(*s.energy_column_difference_max_rel,
              (1e3 - *s.record.result.energy_initial) / *s.record.result.energy_initial, 1e-9);
}

}  // namespace
}  // namespace polhode::study::trajectory_reader_test
