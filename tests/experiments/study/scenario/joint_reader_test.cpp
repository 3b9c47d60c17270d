// SPDX-License-Identifier: BSD-3-Clause
// The reader of joints in a scenario: what it reads, what it refuses, and what `assemble` moves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "tests/experiments/study/scenario/scenario_texts.hpp"

namespace polhode::study::scenario_tests::joint_reader_test {
namespace {

const std::string jointed = R"(t_end = 1.0
gravity = [0.0, 0.0, -9.81]

[[body]]
name = "upper"
mass = 1.0
inertia = [1.0, 2.0, 2.5]
position = [0.0, 0.0, -0.5]

[[body]]
name = "lower"
mass = 2.0
inertia = [1.0, 2.0, 2.5]
position = [0.0, 0.0, -1.5]

[[body]]
name = "ground"
static = true

[[body]]
name = "wall"
static = true

[[joint]]
name = "shoulder"
kind = "ball"
bodies = ["upper"]
anchor_body = [0.0, 0.0, 0.5]

[[joint]]
name = "elbow"
kind = "hinge"
bodies = ["upper", "lower"]
anchor_body = [0.0, 0.0, -0.5]
anchor_body_2 = [0.0, 0.0, 0.5]
axis_body = [0.0, 1.0, 0.0]
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = jointed;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(JointReader, ReadsJoints) {
  const Scenario s = resolved(jointed);
  ASSERT_EQ(s.problem.joints.size(), 2u);
  EXPECT_EQ(s.problem.joints[0].name, "shoulder");
  EXPECT_EQ(s.problem.joints[0].of.kind, "ball");
  EXPECT_EQ(s.problem.joints[1].of.bodies, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(s.problem.joints[1].of.vector("axis_body"), Vector(0, 1, 0));
  EXPECT_TRUE(s.notes.empty());
  EXPECT_EQ(make_system<double>(s.problem, {})->constraints()->rows(), 8u);
}

TEST(JointReader, JointsDecideTheIdentityButNotByTheirNames) {
  const std::string canonical = resolved(jointed).canonical();
  EXPECT_EQ(resolved(with("\"elbow\"", "\"knee\"")).canonical(), canonical);
  EXPECT_NE(resolved(with("axis_body = [0.0, 1.0, 0.0]", "axis_body = [1.0, 0.0, 0.0]")).canonical(), canonical);
}

TEST(JointReader, KeysOfJointsCanBeSetFromOutside) {
  const Scenario s = resolved(jointed, {{"joint.elbow.axis_body", "[1, 0, 0]"}});
  EXPECT_EQ(s.problem.joints[1].of.vector("axis_body"), Vector(1, 0, 0));
  EXPECT_EQ(resolved(jointed, {{"joint.1.axis_body.0", "2"}}).problem.joints[1].of.vector("axis_body"),
            Vector(2, 1, 0));
  EXPECT_THAT(error_of(jointed, {{"joint.knee.axis_body", "[1, 0, 0]"}}), HasSubstr("no joint 'knee'"));
}

TEST(JointReader, RefusesBadJointsWithPlaceAndRemedy) {
  struct Case {
    const char *from, *to, *where, *says;
  };
  const Case cases[] = {
      {"[\"upper\"]", "[\"uper\"]", "27:11: joint.0.bodies.0: ", "did you mean 'upper'"},
      {"kind = \"ball\"", "kind = \"bal\"", "26:8: joint.0.kind: ", "did you mean 'ball'"},
      {"axis_body = [0.0, 1.0, 0.0]", "axis_body = [0, 0, 0]", "36:13: joint.1.axis_body: ", "length 0"},
      {"axis_body = [0.0, 1.0, 0.0]", "", "30:1: joint.1.axis_body: ", "is missing"},
      {"axis_body = [0.0, 1.0, 0.0]", "axis_body = [nan, 0, 0]", "36:", "nan"},
      {"[\"upper\", \"lower\"]", "[\"upper\", \"upper\"]",
       "33:20: joint.1.bodies.1: ", "both ends are on the body 'upper'"},
      {"[\"upper\", \"lower\"]", "[\"ground\", \"wall\"]", "33:10: joint.1.bodies: ", "both bodies are static"},
      {"[\"upper\"]", "[\"ground\"]", "27:10: joint.0.bodies: ", "static body cannot be joined to the world"},
      {"[\"upper\", \"lower\"]", "[\"upper\", \"lower\", \"wall\"]", "33:10: joint.1.bodies: ", "names 3"},
      {"\"elbow\"", "\"shoulder\"", "31:8: joint.1.name: ", "called 'shoulder' already"},
      {"anchor_body = [0.0, 0.0, 0.5]", "anchor_body = [0.0, 0.0, 0.4]",
       "24:1: joint.0: ", "'shoulder' is open by 0.1 m"},
      {"position = [0.0, 0.0, -1.5]", "position = [0.0, 0.0, -1.5]\nvelocity = [0.25, 0, 0]",
       "31:1: joint.1: ", "'elbow' is opening at 0.25 m/s"},
      {"t_end = 1.0", "t_end = 1.0\ncontact = true", "", "contact"},
      {"anchor_body_2 = [0.0, 0.0, 0.5]", "anchor_world = [0, 0, 0]", "35:16: joint.1.anchor_world: ", "1 body only"},
      {"anchor_body_2", "anchor_body_3", "35:1: joint.1.anchor_body_3: ", "did you mean"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(std::string(c.from) + " -> " + c.to);
    const std::string error = error_of(with(c.from, c.to));
    EXPECT_THAT(error, StartsWith(std::string("test.toml:") + c.where));
    EXPECT_THAT(error, HasSubstr(c.says));
  }
}

TEST(JointReader, AssembleClosesTheJointsAndSaysWhatItMoved) {
  const std::string text =
      "assemble = true\n" + with("position = [0.0, 0.0, -1.5]", "position = [0.1, 0.0, -1.4]\nvelocity = [1, 0, 0]");
  const Scenario s = resolved(text);
  const auto system = make_system<double>(s.problem, {});
  const auto motions = motions_of(*system, system->start().y);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto v = system->constraints()->violation(i, motions);
    EXPECT_LT(std::max({v.position, v.angle, v.velocity, v.rate}), 1e-13);
  }
  ASSERT_FALSE(s.notes.empty());
  EXPECT_THAT(s.notes[0], AllOf(HasSubstr("assemble moved the body"), HasSubstr(" m and "), HasSubstr(" m/s and ")));
  EXPECT_TRUE(resolved("assemble = true\n" + jointed).notes.empty()) << "a start that closes them is left alone";
  EXPECT_EQ(resolved("assemble = true\n" + jointed).canonical(), resolved(jointed).canonical());
}

TEST(JointReader, ContradictoryLoopsCannotBeAssembled) {
  const std::string far = "assemble = true\n" + jointed + R"(
[[joint]]
name = "hand"
kind = "ball"
bodies = ["lower"]
anchor_world = [10.0, 0.0, 0.0]
)";
  EXPECT_THAT(error_of(far), AllOf(HasSubstr("contradict"), HasSubstr("the joint '")));
  EXPECT_THAT(error_of("assemble = true\nt_end = 1\n[[body]]\nmass = 1\ninertia = [1, 1, 1]\n"),
              HasSubstr("without a [[joint]]"));
}

TEST(JointReader, NamesJointsThatRepeatOthers) {
  const std::string twice = jointed + R"(
[[joint]]
name = "second elbow"
kind = "hinge"
bodies = ["upper", "lower"]
anchor_body = [0.0, 0.3, -0.5]
anchor_body_2 = [0.0, 0.3, 0.5]
axis_body = [0.0, 1.0, 0.0]
)";
  const Scenario s = resolved(twice);
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_THAT(s.notes[0], AllOf(HasSubstr("rank 8 of 13"), HasSubstr("elbow")));
}

}  // namespace
}  // namespace polhode::study::scenario_tests::joint_reader_test
