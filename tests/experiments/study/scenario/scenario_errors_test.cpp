// SPDX-License-Identifier: BSD-3-Clause
// Errors in a scenario that are refused: line, column, key and words of the message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"
#include "tests/experiments/study/scenario/scenario_texts.hpp"

namespace polhode::study::scenario_tests::scenario_errors_test {
namespace {

struct Wrong {
  const char* from;
  const char* to;
  const char* where;  ///< beginning of the message after "test.toml:"
  const char* says;
};

void expect_refusals(const std::vector<Wrong>& cases) {
  for (const Wrong& c : cases) {
    SCOPED_TRACE(std::string(c.from) + " -> " + c.to);
    const std::string error = error_of(changed(c.from, c.to));
    EXPECT_THAT(error, StartsWith(std::string("test.toml:") + c.where));
    EXPECT_THAT(error, HasSubstr(c.says));
  }
}

TEST(ScenarioErrors, AreWordedToTheLetter) {
  EXPECT_EQ(error_of(changed("mass = 2.0", "mass = -1")),
            "test.toml:7:8: body.0.mass: -1 is not a valid mass; it must be a positive number of kg");
  EXPECT_EQ(error_of(changed("mass = 2.0", "masss = 2.0")).substr(0, 73),
            "test.toml:7:1: body.0.masss: there is no such key; did you mean 'mass'? A");
  EXPECT_EQ(error_of(changed("stiffness = 40.0", "")),
            "test.toml:20:1: force.0.stiffness: is missing; it must be a number of N/m");
}

TEST(ScenarioErrors, Syntax) {
  expect_refusals({{"mass = 2.0", "mass = 2.0\nmass = 2.0", "8:8: ", "cannot redefine existing floating-point 'mass'"},
                   {"mass = 2.0", "mass = ", "7:8: ", "value"},
                   {"title = \"Test\"", "title = Test", "1:9: ", "Error while parsing"},
                   {"[0.0, 0.0, -9.81]", "[0.0, 0.0, 1e999]", "2:", "1e999"},
                   {"static = true", "static = true\n[[bod y]]", "15:", ""}});
  EXPECT_THAT(error_of("a." + std::string(100000, '.') + "a=1"),
              AllOf(StartsWith("test.toml:1:"), HasSubstr("nested more than")));
  std::string deep = "a";
  for (int i = 0; i < 100000; ++i) deep += ".a";
  EXPECT_THAT(error_of(deep + "=1"), AllOf(StartsWith("test.toml:1:"), HasSubstr("nested more than")))
      << "would overflow the stack";
  EXPECT_THAT(error_of("a=" + std::string(100000, '[')), StartsWith("test.toml:1:"));
  EXPECT_THAT(error_of("title = \"\xff\""), StartsWith("test.toml:1:"));
}

TEST(ScenarioErrors, UnknownKeys) {
  expect_refusals(
      {{"title = ", "titel = ", "1:1: titel: there is no such key", "did you mean 'title'? A scenario has: "},
       {"mass = 2.0", "mass = 2.0\nmas = 1", "8:1: body.0.mas: there is no such key", "did you mean 'mass'?"},
       {"stiffness = 40.0", "stifness = 40.0", "23:1: force.0.stifness: ", "did you mean 'stiffness'? A spring has: "},
       {"radius = 0.1", "radius = 0.1, size = 1", "18:42: body.2.shape.size: ", "A sphere has: kind, radius"},
       {"frame = \"body\"", "zzz = 1", "29:1: force.1.zzz: there is no such key; A constant_torque has: ", "frame"}});
}

TEST(ScenarioErrors, MissingKeys) {
  expect_refusals({{"t_end = 10.0\n", "", "1:1: t_end: is missing", "positive number of s"},
                   {"mass = 2.0\n", "", "5:1: body.0.mass: is missing", "positive number of kg"},
                   {"inertia = [1.0, 2.0, 2.5]\n", "", "5:1: body.0.inertia: is missing", "shape"},
                   {"kind = \"spring\"\n", "", "20:1: force.0.kind: is missing", "name of a force"},
                   {"bodies = [\"box\"]\n", "", "20:1: force.0.bodies: is missing", "1 to 2 bodies"},
                   {"stiffness = 40.0\n", "", "20:1: force.0.stiffness: is missing", "N/m"},
                   {", radius = 0.1", "", "18:9: body.2.shape.radius: is missing", "number of m"},
                   {"kind = \"sphere\", ", "", "18:9: body.2.shape.kind: is missing", "name of a shape"}});
  EXPECT_EQ(error_of("t_end = 1"),
            "test.toml:1:1: body: is missing; it must be a list of tables, each under its own [[body]]");
  EXPECT_EQ(error_of(""), "test.toml:1:1: t_end: is missing; it must be a positive number of s");
}

TEST(ScenarioErrors, WrongTypes) {
  expect_refusals(
      {{"title = \"Test\"", "title = 3", "1:9: title: 3 is not a valid title", "a text"},
       {"[0.0, 0.0, -9.81]", "-9.81", "2:11: gravity: -9.81 is not a valid gravity", "3 finite numbers of m/s^2"},
       {"-9.81", "\"down\"", "2:22: gravity.2: \"down\" is not a valid item of gravity", "finite number of m/s^2"},
       {"t_end = 10.0", "t_end = true", "3:9: t_end: true is not a valid t_end", "positive number of s"},
       {"t_end = 10.0", "t_end = 1979-05-27", "3:9: t_end: a date", "positive number of s"},
       {"mass = 2.0", "mass = \"heavy\"", "7:8: body.0.mass: \"heavy\" is not a valid mass", "positive number of kg"},
       {"[1.0, 2.0, 2.5]", "3", "8:11: body.0.inertia: 3 is not a valid inertia", "3 principal moments"},
       {"[1.0, 2.0, 2.5]", "[[1, 0, 0], 2, 3]", "8:23: body.0.inertia.1: 2 is not a valid item of inertia",
        "3 finite numbers"},
       {"static = true", "static = 1", "14:10: body.1.static: 1 is not a valid static", "true or false"},
       {"{ kind = \"sphere\", radius = 0.1 }", "\"sphere\"", "18:9: body.2.shape: \"sphere\" is not a valid shape",
        "kind ="},
       {"bodies = [\"box\"]", "bodies = \"box\"", "22:10: force.0.bodies: \"box\" is not a valid bodies", "a list"},
       {"bodies = [\"box\"]", "bodies = [0]", "22:11: force.0.bodies.0: 0 is not a valid item of bodies",
        "name of a body"},
       {"stiffness = 40.0", "stiffness = [40.0]", "23:13: force.0.stiffness: a list of 1", "number of N/m"},
       {"torque = [0.0, 0.0, 0.1]", "torque = 0.1", "28:10: force.1.torque: 0.1", "3 finite numbers of N m"},
       {"frame = \"body\"", "frame = 1", "29:9: force.1.frame: 1 is not a valid frame", "\"world\" or \"body\""}});
  EXPECT_THAT(error_of(changed("mass = 2.0", "mass = \"" + std::string(39, 'x') + "äyz\"")),
              HasSubstr('"' + std::string(39, 'x') + "...\" is not"))
      << "no half letters";
  EXPECT_THAT(error_of("t_end = 1\n[body]\nmass = 1"), StartsWith("test.toml:2:1: body: a table is not a valid body"));
  EXPECT_THAT(error_of("t_end = 1\nbody = 3"), HasSubstr("[[body]]"));
  EXPECT_THAT(error_of("t_end = 1\nbody = [3]"), StartsWith("test.toml:2:9: body.0: 3 is not a valid item of body"));
  EXPECT_THAT(
      error_of(changed("[[force]]\nkind = \"spring\"\nbodies = [\"box\"]\nstiffness = 40.0\n\n[[force]]", "[force]")),
      HasSubstr("force: a table is not a valid force; it must be a list of tables, each under its own [[force]]"));
}

TEST(ScenarioErrors, VectorLengths) {
  expect_refusals(
      {{"[0.0, 0.0, -9.81]", "[0.0, -9.81]", "2:11: gravity: a list of 2", "3 finite numbers"},
       {"[1.0, 2.0, 2.5]", "[1.0, 2.0]", "8:11: body.0.inertia: a list of 2", "3 principal moments"},
       {"[1.0, 2.0, 2.5]", "[[1, 0, 0], [0, 2], [0, 0, 2]]", "8:23: body.0.inertia.1: a list of 2", "3 finite numbers"},
       {"[1.0, 0.0, 0.0, 0.0]", "[1.0, 0.0, 0.0]", "9:15: body.0.orientation: a list of 3", "4 numbers"},
       {"[0.1, 0.2, 0.3]", "[0.1, 0.2, 0.3, 0.4]", "10:20: body.0.angular_velocity: a list of 4", "3 finite numbers"}});
}

TEST(ScenarioErrors, NumbersThatAreNotFinite) {
  expect_refusals({{"-9.81", "nan", "2:22: gravity.2: nan is not a valid item of gravity", "finite number of m/s^2"},
                   {"t_end = 10.0", "t_end = inf", "3:9: t_end: inf is not", "positive number of s"},
                   {"mass = 2.0", "mass = inf", "7:8: body.0.mass: inf is not a valid mass", "positive number of kg"},
                   {"mass = 2.0", "mass = nan", "7:8: body.0.mass: nan is not a valid mass", "positive number of kg"},
                   {"2.5]", "inf]", "8:22: body.0.inertia.2: inf", "finite"},
                   {"0.3]", "-inf]", "10:31: body.0.angular_velocity.2: -inf", "finite number of rad/s"},
                   {"stiffness = 40.0", "stiffness = nan", "23:13: force.0.stiffness: nan", "non-negative number"}});
}

TEST(ScenarioErrors, Ranges) {
  expect_refusals({{"t_end = 10.0", "t_end = 0", "3:9: t_end: 0 is not", "positive number of s"},
                   {"t_end = 10.0", "t_end = -1.5", "3:9: t_end: -1.5 is not", "positive number of s"},
                   {"mass = 2.0", "mass = 0.0", "7:8: body.0.mass: 0 is not a valid mass", "positive number of kg"},
                   {"mass = 2.0", "mass = 1e-310", "7:8: body.0.mass: 1e-310 is not a valid mass", "large enough"},
                   {"radius = 0.1", "radius = 0", "18:37: body.2.shape.radius: 0 is not a valid radius", "positive"},
                   {"stiffness = 40.0", "stiffness = -1", "23:13: force.0.stiffness: -1 is not", "non-negative"},
                   {"frame = \"body\"", "frame = \"bodi\"", "29:9: force.1.frame: \"bodi\"", "\"world\" or \"body\""},
                   {"mass = 2.0", "mass = 2.0\nrestitution = 1.5", "8:15: body.0.restitution: 1.5", "from 0 to 1"},
                   {"mass = 2.0", "mass = 2.0\nrestitution = -0.5", "8:15: body.0.restitution: -0.5", "non-negative"},
                   {"mass = 2.0", "mass = 2.0\nfriction = -1", "8:12: body.0.friction: -1", "non-negative"}});
  const std::string box = "shape = { kind = \"box\", size = [1, 2, 0] }";
  EXPECT_THAT(
      error_of(changed("shape = { kind = \"sphere\", radius = 0.1 }", box)),
      StartsWith(
          "test.toml:18:39: body.2.shape.size.2: 0 is not a valid item of size; it must be a positive number of m"));
}

TEST(ScenarioErrors, ImpossibleInertia) {
  expect_refusals(
      {{"[1.0, 2.0, 2.5]", "[1.0, 2.0, 3.5]", "8:11: body.0.inertia: ", "breaks the triangle inequality"},
       {"[1.0, 2.0, 2.5]", "[1.0, 2.0, 0.0]", "8:11: body.0.inertia: ", "is not positive"},
       {"[1.0, 2.0, 2.5]", "[1.0, -2.0, 2.5]", "8:11: body.0.inertia: ", "is not positive"},
       {"[1.0, 2.0, 2.5]", "[[2, 0.1, 0], [0, 2, 0], [0, 0, 2]]", "8:11: body.0.inertia: ", "not symmetric"},
       {"radius = 0.1", "radius = 1e200", "18:9: body.2.shape: ", "the inertia is not finite"}});
  EXPECT_NO_THROW(resolved(changed("[1.0, 2.0, 2.5]", "[1.0, 2.0, 3.0]"))) << "a flat body";
}

TEST(ScenarioErrors, PointMasses) {
  const auto with = [](const std::string& points) {
    return changed("mass = 2.0\ninertia = [1.0, 2.0, 2.5]", "point_masses = " + points);
  };
  EXPECT_THAT(error_of(with("[]")),
              StartsWith("test.toml:7:16: body.0.point_masses: a list of 0 is not a valid point_masses"));
  EXPECT_THAT(error_of(with("[{ mass = 1, position = [1, 0, 0] }]")),
              HasSubstr("has its mass centre at [1, 0, 0] m; it must be at the origin"));
  EXPECT_THAT(error_of(with("[{ mass = 1, position = [1, 0, 0] }, { mass = 1, position = [-1, 0, 0] }]")),
              HasSubstr("body.0.point_masses: the inertia is not positive"));
  EXPECT_THAT(error_of(with("[{ mass = 0, position = [1, 0, 0] }]")),
              StartsWith("test.toml:7:26: body.0.point_masses.0.mass: 0 is not a valid mass"));
  EXPECT_THAT(error_of(with("[{ mass = 1 }]")),
              StartsWith("test.toml:7:17: body.0.point_masses.0.position: is missing"));
  EXPECT_THAT(error_of(with("[{ mass = 1, place = [1, 0, 0] }]")),
              HasSubstr("body.0.point_masses.0.place: there is no"));
  EXPECT_THAT(error_of(changed("mass = 2.0", "mass = 2.0\npoint_masses = [{ mass = 1, position = [0, 0, 0] }]")),
              StartsWith("test.toml:7:8: body.0.mass: is given beside point_masses"));
}

TEST(ScenarioErrors, Orientation) {
  expect_refusals(
      {{"[1.0, 0.0, 0.0, 0.0]", "[1.000002, 0.0, 0.0, 0.0]", "9:15: body.0.orientation: ", "has the length 1.000002; "},
       {"[1.0, 0.0, 0.0, 0.0]", "[0, 0, 0, 0]", "9:15: body.0.orientation: ", "it must be 1 to within 1e-6"},
       {"[1.0, 0.0, 0.0, 0.0]", "[0.7, 0.7, 0, 0]", "9:15: body.0.orientation: ", "it must be 1 to within 1e-6"},
       {"[1.0, 0.0, 0.0, 0.0]", "[1, 0, 0, \"z\"]", "9:25: body.0.orientation.3: ", "finite number"}});
}

TEST(ScenarioErrors, Names) {
  expect_refusals(
      {{"kind = \"spring\"", "kind = \"sprong\"", "21:8: force.0.kind: no force is called 'sprong'", "mean 'spring'?"},
       {"kind = \"sphere\"", "kind = \"cube\"", "18:18: body.2.shape.kind: no shape is called 'cube'",
        "There are: sphere, box"},
       {"bodies = [\"box\"]", "bodies = [\"bix\"]", "22:11: force.0.bodies.0: no body is called 'bix'", "mean 'box'?"},
       {"title = \"Test\"", "invariants = [\"p_fi\"]", "1:15: invariants.0: no invariant is called 'p_fi'", "'p_phi'?"},
       {"name = \"ground\"", "name = \"box\"", "13:8: body.1.name: body 0 is called 'box' already", "differ"},
       {"name = \"ground\"", "name = \"body2\"", "16:1: body.2.name: body 1 is called 'body2' already", "differ"},
       {"name = \"ground\"", "name = \"\"", "13:8: body.1.name: \"\" is not a valid name", "a text"},
       {"name = \"ground\"", "name = \"1\"", "13:8: body.1.name: \"1\" is not a valid name", "not a number"},
       {"name = \"ground\"", "name = \"a.b\"", "13:8: body.1.name: \"a.b\" is not a valid name", "dots"},
       {"name = \"ground\"", "name = \"a\\nb\"", "13:8: body.1.name: ", "is not a valid name"}});
}

TEST(ScenarioErrors, ForcesAndTheirBodies) {
  expect_refusals(
      {{"bodies = [\"box\"]", "bodies = []", "22:10: force.0.bodies: a list of 0", "the names of 1 to 2 bodies"},
       {"[\"box\", \"body2\"]", "[]", "27:10: force.1.bodies: a list of 0", "1 or more bodies"},
       {"bodies = [\"box\"]", "bodies = [\"box\", \"box\"]", "22:18: force.0.bodies.1: ", "named twice"},
       {"bodies = [\"box\"]", "bodies = [\"box\", \"body2\", \"ground\"]", "22:10: force.0.bodies: ", "names 3"},
       {"bodies = [\"box\"]", "bodies = [\"ground\"]", "22:10: force.0.bodies: ", "only static bodies"},
       {"[\"box\", \"body2\"]", "[\"box\", \"ground\"]", "27:18: force.1.bodies.1: ", "'ground' is static"},
       {"bodies = [\"box\"]", "bodies = [\"box\", \"body2\"]\nanchor_world = [0, 0, 0]",
        "23:16: force.0.anchor_world: makes sense with 1 body only", "names 2"},
       {"bodies = [\"box\"]", "bodies = [\"box\"]\nanchor_body_2 = [0, 0, 0]",
        "23:17: force.0.anchor_body_2: makes sense with 2 bodies only", "names 1"},
       {"kind = \"spring\"\nbodies = [\"box\"]\nstiffness = 40.0",
        "kind = \"point_gravity\"\nbodies = [\"box\", \"ground\"]", "22:18: force.0.bodies.1: ", "is given no mass"},
       {"kind = \"spring\"\nbodies = [\"box\"]\nstiffness = 40.0", "kind = \"point_gravity\"\nbodies = [\"box\"]",
        "22:10: force.0.bodies: a point_gravity acts on 2 bodies", "names 1"}});
}

TEST(ScenarioErrors, PinnedAndStaticBodies) {
  expect_refusals(
      {{"mass = 2.0", "mass = 2.0\npinned = true\nvelocity = [1, 0, 0]", "9:12: body.0.velocity: ", "pinned body"},
       {"mass = 2.0", "mass = 2.0\ncenter_of_mass = [1, 0, 0]", "8:18: body.0.center_of_mass: ", "pinned = true"},
       {"static = true", "static = true\npinned = true", "14:10: body.1.static: ", "not both"},
       {"static = true", "static = true\nvelocity = [1, 0, 0]", "15:12: body.1.velocity: ", "does not move"},
       {"static = true", "static = true\nangular_velocity = [1, 0, 0]",
        "15:20: body.1.angular_velocity: ", "does not move"},
       {"mass = 2.0", "mass = 2.0\nangular_velocity_frame = \"bod\"",
        "8:26: body.0.angular_velocity_frame: ", "\"world\""}});
  EXPECT_NO_THROW(resolved(changed("mass = 2.0", "mass = 2.0\npinned = true\nvelocity = [0, 0, 0]")));
  EXPECT_THAT(error_of("t_end = 1\n[[body]]\nstatic = true"), StartsWith("test.toml:2:1: body: every body is static"));
}

TEST(ScenarioErrors, Invariants) {
  expect_refusals(
      {{"title = \"Test\"", "invariants = [\"casimir\"]", "1:15: invariants.0: casimir is no invariant", ": it "},
       {"title = \"Test\"", "invariants = \"casimir\"", "1:14: invariants: \"casimir\" is not", "a list"},
       {"title = \"Test\"", "invariants = [1]", "1:15: invariants.0: 1 is not", "name of an invariant"}});
  EXPECT_THAT(error_of("t_end = 1\ninvariants = [\"casimir\", \"casimir\"]\n[[body]]\nmass = 1\ninertia = [1, 1, 1]"),
              StartsWith("test.toml:2:26: invariants.1: casimir is named twice"));
}

}  // namespace
}  // namespace polhode::study::scenario_tests::scenario_errors_test
