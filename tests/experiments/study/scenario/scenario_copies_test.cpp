// SPDX-License-Identifier: BSD-3-Clause
// Bodies that stand for many: where the copies are, how they are named, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/quaternion.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::scenario_copies_test {
namespace {

using testing::HasSubstr;
using Vector = Vector3<double>;

/// One body by itself, and one with these keys.
Scenario resolved(const std::string& keys) {
  return ScenarioSource::parse(
             "t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 1, 1]\n"
             "[[body]]\nname = \"ball\"\nmass = 1\ninertia = [1, 1, 1]\n" +
                 keys,
             "test.toml")
      .resolve();
}

TEST(ScenarioCopies, StandOnAGrid) {
  const Scenario s = resolved(
      "position = [5, 0, 1]\nrepeat = [2, 3, 1]\nspacing = [1, 2, 0]\n"
      "[[force]]\nkind = \"constant_torque\"\nbodies = [\"ball_5\"]\ntorque = [0, 0, 1]\n");
  ASSERT_EQ(s.problem.bodies.size(), 7u);
  EXPECT_EQ(s.problem.bodies[1].name, "ball_0");
  EXPECT_EQ(s.problem.bodies[6].name, "ball_5");
  EXPECT_EQ(s.problem.starts[1].position, Vector(5, 0, 1));
  EXPECT_EQ(s.problem.starts[2].position, Vector(6, 0, 1)) << "x fastest";
  EXPECT_EQ(s.problem.starts[6].position, Vector(6, 4, 1));
  EXPECT_EQ(s.problem.forces[0].bodies, (std::vector<std::size_t>{6}));
}

TEST(ScenarioCopies, AreOffTheGridAsFarAsTheyMay) {
  const std::string keys =
      "orientation = [0, 1, 0, 0]\nrepeat = [10, 10, 1]\nspacing = [1, 1, 0]\njitter = 0.25\njitter_angle = 0.5\n";
  const Scenario s = resolved(keys), again = resolved(keys);
  EXPECT_EQ(s.canonical(), again.canonical());
  double most = 0, most_angle = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    const BodyStart& start = s.problem.starts[1 + i];
    const Vector off = start.position - Vector(double(i % 10), double(i / 10), 0);
    const Quaternion<double>& q = start.orientation;
    const Quaternion<double> turn = product(q, Quaternion<double>(0, -1, 0, 0));
    const double angle = 2 * std::atan2(turn.tail<3>().norm(), std::abs(turn[0]));
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    most = std::max(most, off.cwiseAbs().maxCoeff());
    most_angle = std::max(most_angle, angle);
  }
  EXPECT_LE(most, 0.25);
  EXPECT_GT(most, 0.24);
  EXPECT_LE(most_angle, 0.5 + 1e-12);
  EXPECT_GT(most_angle, 0.45);
}

TEST(ScenarioCopies, ErrorsSayWhatWouldDo) {
  const auto error = [](const std::string& keys) {
    try {
      resolved(keys);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error("repeat = [1, 2.5, 1]"), HasSubstr("3 whole numbers from 1, the copies along x, y and z"));
  EXPECT_THAT(error("repeat = [1, 0, 1]"), HasSubstr("body.1.repeat: "));
  EXPECT_THAT(error("repeat = [2, 2]"), HasSubstr("a list of 2"));
  EXPECT_THAT(error("repeat = [100, 100, 100]"), HasSubstr("asks for 1e+06 copies; it must be at most 10000"));
  EXPECT_THAT(error("repeat = [1, 4, 1]\nspacing = [1, 0, 1]"),
              HasSubstr("body.1.spacing: is 0 along y, where there are 4 copies; give"));
  EXPECT_THAT(error("jitter = 0.1"),
              HasSubstr("body.1.jitter: is of the copies of a body; give repeat = [nx, ny, nz] too"));
  EXPECT_THAT(error("repeat = [1, 1, 1]\njitter = -1"), HasSubstr("body.1.jitter: -1 is not"));
}

}  // namespace
}  // namespace polhode::study::scenario_copies_test
