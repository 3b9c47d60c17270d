// SPDX-License-Identifier: BSD-3-Clause
// Overrides of keys of a scenario, and the errors that name them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"
#include "tests/experiments/study/scenario/scenario_texts.hpp"

namespace polhode::study::scenario_tests::scenario_overrides_test {
namespace {

TEST(ScenarioOverrides, SetNumbersVectorsAndTexts) {
  EXPECT_EQ(resolved(base, {{"body.0.mass", "7"}}).problem.bodies[0].mass, 7);
  EXPECT_EQ(resolved(base, {{"body.box.mass", "7"}}).problem.bodies[0].mass, 7) << "by name";
  EXPECT_EQ(resolved(base, {{"body.body2.mass", "7"}}).problem.bodies[1].mass, 7) << "by its default name";
  EXPECT_EQ(resolved(base, {{"body.2.mass", "7"}}).problem.bodies[1].mass, 7) << "by its place in the file";
  EXPECT_EQ(resolved(base, {{"body.0.inertia.1", "1.75"}}).problem.bodies[0].inertia(1, 1), 1.75);
  EXPECT_EQ(resolved(base, {{"body.0.angular_velocity", "[1, 2, 3]"}}).problem.starts[0].angular_velocity,
            Vector(1, 2, 3));
  EXPECT_EQ(resolved(base, {{"force.0.stiffness", "5.5"}}).problem.forces[1].number("stiffness"), 5.5);
  EXPECT_EQ(resolved(base, {{"force.1.frame", "\"world\""}}).problem.forces[2].text("frame"), "world");
  EXPECT_EQ(resolved(base, {{"gravity.2", "-1.62"}}).problem.forces[0].vector("acceleration"), Vector(0, 0, -1.62));
  EXPECT_EQ(resolved(base, {{"t_end", "3"}}).t_end, 3);
  EXPECT_NEAR(resolved(base, {{"body.2.shape.radius", "1"}}).problem.bodies[1].inertia(0, 0), 1.2, 1e-15);
}

TEST(ScenarioOverrides, SetWhatTheFileLeavesOut) {
  EXPECT_EQ(resolved(base, {{"body.0.velocity.1", "3"}}).problem.starts[0].velocity, Vector(0, 3, 0));
  EXPECT_EQ(resolved(base, {{"body.2.orientation.0", "-1"}}).problem.starts[1].orientation[0], -1);
  EXPECT_EQ(resolved(base, {{"body.0.pinned", "true"}}).problem.bodies[0].pinned, true);
  EXPECT_EQ(resolved(base, {{"force.0.rest_length", "0.5"}}).problem.forces[1].number("rest_length"), 0.5);
  EXPECT_EQ(resolved(base, {{"force.0.anchor_world.2", "2"}}).problem.forces[1].vector("anchor_world"),
            Vector(0, 0, 2));
  const std::string weightless = changed("gravity = [0.0, 0.0, -9.81]\n", "");
  EXPECT_EQ(resolved(weightless, {{"gravity.0", "1"}}).problem.forces[0].vector("acceleration"), Vector(1, 0, 0));
}

TEST(ScenarioOverrides, LeaveTheSourceAsItWas) {
  const ScenarioSource source = ScenarioSource::parse(base, "test.toml");
  const std::string before = source.resolve().canonical();
  const std::vector<Override> overrides = {{"body.0.mass", "7"}, {"body.0.velocity.1", "3"}};
  EXPECT_NE(source.resolve(overrides).canonical(), before);
  EXPECT_EQ(source.resolve().canonical(), before);
}

TEST(ScenarioOverrides, ErrorsNameTheOverride) {
  const auto wrong = [](const char* key, const char* value) { return error_of(base, {{key, value}}); };
  EXPECT_EQ(wrong("body.0.mass", "-1"),
            "--vary body.0.mass: -1 is not a valid mass; it must be a positive number of kg");
  EXPECT_EQ(wrong("body.box.mass", "-1"),
            "--vary body.box.mass: -1 is not a valid mass; it must be a positive number of kg");
  EXPECT_THAT(wrong("body.0.inertia.1", "20"), StartsWith("--vary body.0.inertia.1: the inertia breaks the triangle"));
  EXPECT_THAT(wrong("body.0.inertia", "[1, 2, 20]"), StartsWith("--vary body.0.inertia: the inertia breaks"));
  EXPECT_THAT(wrong("body.0.angular_velocity", "[1, 2]"), StartsWith("--vary body.0.angular_velocity: a list of 2"));
  EXPECT_THAT(wrong("body.0.angular_velocity", "[1, 2, inf]"),
              StartsWith("--vary body.0.angular_velocity: body.0.angular_velocity.2: inf is not"));
  EXPECT_THAT(wrong("body.0.orientation.1", "0.5"), StartsWith("--vary body.0.orientation.1: the quaternion has"));
  EXPECT_THAT(wrong("force.1.frame", "\"bdy\""), StartsWith("--vary force.1.frame: \"bdy\" is not a valid frame"));
  EXPECT_THAT(wrong("t_end", "0"), StartsWith("--vary t_end: 0 is not"));
}

TEST(ScenarioOverrides, ErrorsOfKeys) {
  const auto wrong = [](const char* key, const char* value) { return error_of(base, {{key, value}}); };
  EXPECT_THAT(wrong("body.0.masss", "1"),
              StartsWith("--vary body.0.masss: there is no key 'masss'; did you mean 'mass'?"));
  EXPECT_THAT(wrong("grvity", "1"), StartsWith("--vary grvity: there is no key 'grvity'; did you mean 'gravity'?"));
  EXPECT_THAT(wrong("", "1"), StartsWith("--vary : there is no key ''"));
  EXPECT_THAT(wrong("body", "1"), HasSubstr("it must name one key of one body"));
  EXPECT_THAT(wrong("body.0", "1"), HasSubstr("it must name one key of one body"));
  EXPECT_THAT(wrong("body.3.mass", "1"), HasSubstr("has no body '3'; it has 3: 0 (box), 1 (ground), 2"));
  EXPECT_THAT(wrong("body.bix.mass", "1"), HasSubstr("has no body 'bix'"));
  EXPECT_THAT(wrong("body.-1.mass", "1"), HasSubstr("has no body '-1'"));
  EXPECT_THAT(wrong("force.2.stiffness", "1"),
              HasSubstr("has no force '2'; it has 2: 0 (spring), 1 (constant_torque)"));
  EXPECT_THAT(wrong("force.0.stifness", "1"), HasSubstr("did you mean 'stiffness'?"));
  EXPECT_THAT(wrong("gravity.3", "1"), HasSubstr("'3' is not a place in a list of 3"));
  EXPECT_THAT(wrong("gravity.x", "1"), HasSubstr("'x' is not a place in a list of 3"));
  EXPECT_THAT(wrong("body.0.mass.0", "1"), HasSubstr("there is nothing below 'mass'"));
  EXPECT_THAT(wrong("body.0.mass.", "1"), HasSubstr("there is nothing below 'mass'"));
  EXPECT_THAT(wrong("title", "\"x\""), HasSubstr("decides nothing"));
  EXPECT_THAT(wrong("body.0.name", "\"x\""), HasSubstr("decides nothing"));
  EXPECT_THAT(wrong("body.2.shape.size", "1"), StartsWith("--vary body.2.shape.size: there is no such key"));
  EXPECT_THAT(wrong("body.2.inertia.1", "1"), HasSubstr("write inertia = [I1, I2, I3] in the scenario"));
  const std::string both = changed("inertia = [1.0", "shape = { kind = \"sphere\", radius = 1 }\ninertia = [1.0");
  EXPECT_THAT(error_of(both, {{"body.0.shape.radius", "2"}}),
              HasSubstr("decides nothing about a run while the inertia"));
}

TEST(ScenarioOverrides, ErrorsOfValues) {
  for (const char* text : {"", "world", "[1, 2", "1\nmass = 2", "1\nz = 2", "1 2", "= 1", "1e999", "\"x", "\xff"}) {
    EXPECT_THAT(error_of(base, {{"body.0.mass", text}}), StartsWith("--vary body.0.mass: '")) << text;
  }
}

TEST(ScenarioOverrides, AreBlamedForWhatTheyMakeOfTheRest) {
  const std::string error = error_of(base, {{"gravity.2", "-1"}, {"force.0.kind", "\"damper\""}});
  EXPECT_THAT(error,
              StartsWith("--vary gravity.2, --vary force.0.kind: test.toml:23:1: force.0.stiffness: there is no such"));
  const std::string of_file = error_of(changed("mass = 2.0", "mass = -2.0"), {{"gravity.2", "-1"}});
  EXPECT_THAT(of_file, StartsWith("test.toml:7:8: body.0.mass: -2")) << "the file is wrong by itself";
}

TEST(ScenarioOverrides, SurfacesDecideWhereThereIsContact) {
  const std::string text =
      "t_end = 1\ncontact = true\n[[body]]\nmass = 1\nrestitution = 0.5\ninertia = [1, 1, 1]\n"
      "shape = { kind = \"sphere\", radius = 0.5 }\n[[body]]\nstatic = true\n"
      "shape = { kind = \"half_space\", normal = [0, 0, 1] }\n";
  EXPECT_EQ(resolved(text, {{"body.0.restitution", "0.25"}}).colliders[0].restitution, 0.25);
  EXPECT_EQ(resolved(text, {{"body.1.friction", "0.5"}}).colliders[1].friction, 0.5);
  EXPECT_NE(resolved(text, {{"body.0.shape.radius", "0.25"}}).canonical(), resolved(text).canonical());
  EXPECT_TRUE(resolved(text, {{"end_at_contact", "true"}}).end_at_contact);
  EXPECT_NE(resolved(text, {{"end_at_contact", "true"}}).canonical(), resolved(text).canonical());
  EXPECT_EQ(error_of(base, {{"body.0.friction", "0.5"}}),
            "--vary body.0.friction: the friction decides nothing about a run without contact = true");
  EXPECT_THAT(error_of("end_at_contact = true\n" + base), HasSubstr("end_at_contact: needs contact = true"));
}

}  // namespace
}  // namespace polhode::study::scenario_tests::scenario_overrides_test
