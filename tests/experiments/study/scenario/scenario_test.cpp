// SPDX-License-Identifier: BSD-3-Clause
// Scenarios: what is read and what is refused, with the place and the key that the message names; overrides; the
// canonical text; the built-in ones.
#include "experiments/study/scenario/scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "collision/shapes/shape_inertia.hpp"
#include "core/forces/catalogue.hpp"
#include "core/problem/inertia.hpp"
#include "core/system/invariants.hpp"
#include "core/system/system.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/input_error.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using Vector = Vector3<double>;

/// Line numbers stand at the left in the tests below.
const std::string base = R"(title = "Test"
gravity = [0.0, 0.0, -9.81]
t_end = 10.0

[[body]]
name = "box"
mass = 2.0
inertia = [1.0, 2.0, 2.5]
orientation = [1.0, 0.0, 0.0, 0.0]
angular_velocity = [0.1, 0.2, 0.3]

[[body]]
name = "ground"
static = true

[[body]]
mass = 3
shape = { kind = "sphere", radius = 0.1 }

[[force]]
kind = "spring"
bodies = ["box"]
stiffness = 40.0

[[force]]
kind = "constant_torque"
bodies = ["box", "body2"]
torque = [0.0, 0.0, 0.1]
frame = "body"
)";

Scenario resolved(const std::string& text, const std::vector<Override>& overrides = {}) {
  return ScenarioSource::parse(text, "test.toml").resolve(overrides);
}

std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    resolved(text, overrides);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

/// `base` with the one place where `from` stands changed.
std::string changed(const std::string& from, const std::string& to) {
  const std::size_t at = base.find(from);
  EXPECT_TRUE(at != std::string::npos && base.find(from, at + 1) == std::string::npos) << from << " must stand once";
  return base.substr(0, at) + to + base.substr(at + from.size());
}

// What is read.

TEST(Scenario, ReadsBodiesAndForces) {
  const Scenario s = resolved(base);
  EXPECT_EQ(s.name, "test");
  EXPECT_EQ(s.title, "Test");
  EXPECT_EQ(s.t_end, 10);
  ASSERT_EQ(s.problem.bodies.size(), 3u);
  EXPECT_EQ(s.problem.moving(), 2u);
  EXPECT_EQ(s.problem.bodies[0].name, "box");
  EXPECT_EQ(s.problem.bodies[1].name, "body2") << "named by its place in the file";
  EXPECT_EQ(s.problem.bodies[2].name, "ground") << "static bodies stand last";
  EXPECT_EQ(s.problem.bodies[0].mass, 2);
  EXPECT_EQ(s.problem.bodies[0].inertia, Matrix3<double>(Vector(1, 2, 2.5).asDiagonal()));
  EXPECT_NEAR(s.problem.bodies[1].inertia(1, 1), 0.4 * 3 * 0.01, 1e-17);
  EXPECT_EQ(s.problem.starts[0].angular_velocity, Vector(0.1, 0.2, 0.3));
  ASSERT_EQ(s.problem.forces.size(), 3u);
  EXPECT_EQ(s.problem.forces[0].kind, "uniform_gravity");
  EXPECT_EQ(s.problem.forces[0].bodies, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(s.problem.forces[0].vector("acceleration"), Vector(0, 0, -9.81));
  EXPECT_EQ(s.problem.forces[1].number("stiffness"), 40);
  EXPECT_EQ(s.problem.forces[1].number("rest_length"), 0);
  EXPECT_EQ(s.problem.forces[2].bodies, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(s.problem.forces[2].text("frame"), "body");
}

TEST(Scenario, NoGravityNoForce) {
  EXPECT_EQ(resolved(changed("gravity = [0.0, 0.0, -9.81]\n", "")).problem.forces.size(), 2u);
  EXPECT_EQ(resolved(changed("-9.81", "0.0")).problem.forces.size(), 2u);
}

TEST(Scenario, TitleIsTheNameWhereThereIsNone) { EXPECT_EQ(resolved(changed("title = \"Test\"", "")).title, "test"); }

TEST(Scenario, InertiaAsMatrix) {
  const Scenario s = resolved(changed("[1.0, 2.0, 2.5]", "[[2, 0.5, 0], [0.5, 2, -0.25], [0, -0.25, 1.5]]"));
  Matrix3<double> expected;
  expected << 2, 0.5, 0, 0.5, 2, -0.25, 0, -0.25, 1.5;
  EXPECT_EQ(s.problem.bodies[0].inertia, expected);
}

TEST(Scenario, InertiaOfAPinnedBodyFromItsShapeIsAboutThePivot) {
  const Scenario s = resolved(changed("inertia = [1.0, 2.0, 2.5]",
                                      "pinned = true\ncenter_of_mass = [0, 0, -0.5]\n"
                                      "shape = { kind = \"box\", size = [0.1, 0.2, 1.0] }"));
  const Vector central = Vector(0.04 + 1, 0.01 + 1, 0.05) * 2 / 12;
  EXPECT_LE((s.problem.bodies[0].inertia.diagonal() - central - Vector(0.5, 0.5, 0)).norm(), 1e-15);
  EXPECT_EQ(s.problem.bodies[0].center_of_mass, Vector(0, 0, -0.5));
}

TEST(Scenario, PointMassesGiveMassAndInertia) {
  const std::string four = R"([{ mass = 1, position = [1, 0, 0] }, { mass = 1, position = [-1, 0, 0] },
                              { mass = 2, position = [0, 1, 1] }, { mass = 2, position = [0, -1, -1] }])";
  const Scenario s = resolved(changed("mass = 2.0\ninertia = [1.0, 2.0, 2.5]", "point_masses = " + four));
  Matrix3<double> expected;
  expected << 8, 0, 0, 0, 6, -4, 0, -4, 6;
  EXPECT_EQ(s.problem.bodies[0].mass, 6);
  EXPECT_EQ(s.problem.bodies[0].inertia, expected);

  const std::string off = R"(pinned = true
point_masses = [{ mass = 1, position = [1, 0, 0] }, { mass = 1, position = [0, 1, 0] }])";
  const Scenario pinned = resolved(changed("mass = 2.0\ninertia = [1.0, 2.0, 2.5]", off));
  EXPECT_EQ(pinned.problem.bodies[0].center_of_mass, Vector(0.5, 0.5, 0));
  EXPECT_EQ(pinned.problem.bodies[0].inertia, Matrix3<double>(Vector(1, 1, 2).asDiagonal())) << "about the pivot";
}

TEST(Scenario, QuaternionNearUnitLengthIsUsedAsGiven) {
  const Scenario s = resolved(changed("[1.0, 0.0, 0.0, 0.0]", "[-1.0000009, 0.0, 0.0, 0.0]"));
  EXPECT_EQ(s.problem.starts[0].orientation[0], -1.0000009);
  EXPECT_THAT(s.canonical, HasSubstr("orientation=-1.0000009,0,0,0"));
}

TEST(Scenario, UnphysicalInertiaOnRequest) {
  const std::string text = changed("[1.0, 2.0, 2.5]", "[3.0, 5.0, 9.0]\nunphysical_inertia = true");
  EXPECT_EQ(resolved(text).problem.bodies[0].inertia(2, 2), 9);
  EXPECT_THAT(error_of(changed("[1.0, 2.0, 2.5]", "[3.0, -5.0, 9.0]\nunphysical_inertia = true")),
              HasSubstr("not positive"));
}

TEST(Scenario, StaticBodiesNeedNoMatter) { EXPECT_NO_THROW(resolved(changed("static = true", "static = true"))); }

TEST(Scenario, DeclaredInvariantsAreKept) {
  const std::string text =
      "t_end = 1\ninvariants = [\"p_psi\", \"casimir\"]\n[[body]]\nmass = 1\ninertia = [2, 2, 1]\n";
  EXPECT_EQ(resolved(text).invariants, (std::vector<std::string>{"p_psi", "casimir"}));
}

// What is refused: line, column, key, and words of the message.

struct Wrong {
  const char* from;
  const char* to;
  const char* where;  ///< how the message begins, after "test.toml:"
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

// Overrides.

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
  const std::string before = source.resolve().canonical;
  const std::vector<Override> overrides = {{"body.0.mass", "7"}, {"body.0.velocity.1", "3"}};
  EXPECT_NE(source.resolve(overrides).canonical, before);
  EXPECT_EQ(source.resolve().canonical, before);
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
  EXPECT_NE(resolved(text, {{"body.0.shape.radius", "0.25"}}).canonical, resolved(text).canonical);
  EXPECT_TRUE(resolved(text, {{"end_at_contact", "true"}}).end_at_contact);
  EXPECT_NE(resolved(text, {{"end_at_contact", "true"}}).canonical, resolved(text).canonical);
  EXPECT_EQ(error_of(base, {{"body.0.friction", "0.5"}}),
            "--vary body.0.friction: the friction decides nothing about a run without contact = true");
  EXPECT_THAT(error_of("end_at_contact = true\n" + base), HasSubstr("end_at_contact: needs contact = true"));
}

// The canonical text.

TEST(ScenarioCanonical, SaysNothingOfNamesTitlesAndSpelling) {
  const std::string canonical = resolved(base).canonical;
  EXPECT_EQ(ScenarioSource::parse(base, "elsewhere/other.toml").resolve().canonical, canonical);
  for (const auto& [from, to] : std::map<std::string, std::string>{
           {"title = \"Test\"", "title = \"Other\"\ndescription = \"Text\""},
           {"t_end = 10.0", "t_end = 20"},
           {"name = \"ground\"", "name = \"floor\""},
           {"mass = 2.0", "mass = 2 # kg\nrestitution = 0.5\nfriction = 0.3"},
           {"inertia = [1.0, 2.0, 2.5]", "inertia = [[1, 0, 0], [0, 2, 0], [0, 0, 2.5]]"},
           {"inertia = [1.0, 2.0, 2.5]", "inertia = [1.0, 2.0, 2.5]\nvelocity = [0, 0, 0]\npinned = false"},
           {"stiffness = 40.0", "stiffness = 4e1\nrest_length = 0.0"}}) {
    EXPECT_EQ(resolved(changed(from, to)).canonical, canonical) << to;
  }
  EXPECT_EQ(canonical.find("box"), std::string::npos);
}

TEST(ScenarioCanonical, OfAKnownScenario) {
  const std::string text = R"(t_end = 1
invariants = ["casimir"]
[[body]]
name = "ground"
static = true
[[body]]
name = "top"
mass = 1
inertia = [1, 2, 3]
velocity = [0, 1, 0]
angular_velocity = [0.3, 1, -0.5]
[[force]]
kind = "spring"
bodies = ["top", "ground"]
stiffness = 1e-30
)";
  EXPECT_EQ(resolved(text).canonical,
            "body mass=1 static=false position=0,0,0 orientation=1,0,0,0 inertia=1,0,0,0,2,0,0,0,3 pinned=false "
            "center_of_mass=0,0,0 velocity=0,1,0 angular_velocity=0.3,1,-0.5 frame=world\n"
            "body mass=1 static=true position=0,0,0 orientation=1,0,0,0\n"
            "spring bodies=0,1 anchor_body=0,0,0 anchor_body_2=0,0,0 anchor_world=0,0,0 damping=0 rest_length=0 "
            "stiffness=1e-30\n"
            "invariant casimir\n")
      << "a change here makes every stored run anew: is that meant?";
}

TEST(ScenarioCanonical, NumbersReadBackExactly) {
  const double mass = 0.1 + 0.2;
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.17g", mass);
  EXPECT_THAT(resolved(base, {{"body.0.mass", digits}}).canonical, HasSubstr("mass=0.30000000000000004 "));
}

/// A value for each key of a body that makes another run; a key that is missing here fails the test.
TEST(ScenarioCanonical, SeesEveryKeyOfABody) {
  const std::map<std::string_view, Override> other = {
      {"mass", {"body.0.mass", "3"}},
      {"shape", {"body.2.shape", "{ kind = \"sphere\", radius = 0.2 }"}},
      {"inertia", {"body.0.inertia", "[1, 2, 2.25]"}},
      {"position", {"body.0.position", "[1, 0, 0]"}},
      {"orientation", {"body.0.orientation", "[-1, 0, 0, 0]"}},
      {"velocity", {"body.0.velocity", "[1, 0, 0]"}},
      {"angular_velocity", {"body.0.angular_velocity", "[1, 0, 0]"}},
      {"angular_velocity_frame", {"body.0.angular_velocity_frame", "\"body\""}},
      {"pinned", {"body.0.pinned", "true"}},
      {"center_of_mass", {"body.1.center_of_mass", "[1, 0, 0]"}},
      {"static", {"body.1.static", "true"}},
      {"repeat", {"body.1.repeat", "[1, 1, 2]"}},
      {"spacing", {"body.1.spacing", "[0, 2, 0]"}},
      {"jitter", {"body.1.jitter", "0.1"}},
      {"jitter_angle", {"body.1.jitter_angle", "0.1"}}};
  const std::string text = changed("name = \"ground\"\nstatic = true", R"(name = "hung"
mass = 1
inertia = [2, 2, 2]
pinned = true)");
  const std::string canonical = resolved(text).canonical;
  for (const ScenarioKey& key : body_keys()) {
    // These two allow or replace what other keys say.
    if (key.decides != Decides::always || key.name == "unphysical_inertia" || key.name == "point_masses") continue;
    ASSERT_TRUE(other.contains(key.name)) << key.name;
    std::vector<Override> overrides = {other.at(key.name)};
    std::vector<Override> beside;
    if (key.name == "static") overrides.push_back({"body.1.pinned", "false"});
    if (key.name == "repeat") overrides.push_back({"body.1.spacing", "[0, 0, 1]"});
    if (key.name == "spacing" || key.name.starts_with("jitter")) {
      beside = {{"body.1.repeat", "[1, 2, 1]"}, {"body.1.spacing", "[0, 1, 0]"}};
      overrides.insert(overrides.begin(), beside.begin(), beside.end());
    }
    EXPECT_NE(resolved(text, overrides).canonical, beside.empty() ? canonical : resolved(text, beside).canonical)
        << key.name;
  }
  EXPECT_NE(resolved(text, {{"gravity", "[0, 0, 1]"}}).canonical, canonical);
  EXPECT_NE(resolved(text, {{"gravity", "[0, 0, 0]"}}).canonical, canonical);
}

TEST(ScenarioCanonical, SeesEveryKeyOfAForce) {
  for (const ForceEntry& entry : force_catalogue()) {
    const ForceKind& kind = entry.kind;
    for (const int bodies : {1, 2}) {
      if (bodies < kind.min_bodies || (kind.max_bodies != 0 && bodies > kind.max_bodies)) continue;
      std::string text =
          "t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 1, 1]\n[[body]]\nmass = 1\ninertia = [1, 1, 1]\n";
      text += "[[force]]\nkind = \"" + kind.name + "\"\nbodies = [\"body0\"" + (bodies == 2 ? ", \"body1\"]\n" : "]\n");
      for (const Parameter& p : kind.parameters) {
        if (p.need != Parameter::Need::required && !std::holds_alternative<double>(p.value)) continue;
        text += p.key + (std::holds_alternative<double>(p.value) ? " = 0.5\n" : " = [0.5, 0.5, 0.5]\n");
      }
      const std::string canonical = resolved(text).canonical;
      EXPECT_NE(resolved(text, {{"force.0.bodies", bodies == 2 ? "[\"body1\", \"body0\"]" : "[\"body1\"]"}}).canonical,
                canonical);
      for (const Parameter& p : kind.parameters) {
        if (p.needs_bodies != 0 && p.needs_bodies != bodies) continue;
        const std::string value = std::holds_alternative<double>(p.value)   ? "0.25"
                                  : std::holds_alternative<Vector>(p.value) ? "[1, 2, 3]"
                                                                            : '"' + p.choices.back() + '"';
        EXPECT_NE(resolved(text, {{"force.0." + p.key, value}}).canonical, canonical) << kind.name << "." << p.key;
      }
    }
  }
}

TEST(ScenarioCanonical, SeesTheInvariants) {
  const std::string text = "t_end = 1\n[[body]]\nmass = 1\ninertia = [2, 2, 1]\n";
  const auto with = [&](const char* list) { return resolved(text, {{"invariants", list}}).canonical; };
  EXPECT_NE(with("[\"casimir\"]"), with("[]"));
  EXPECT_EQ(with("[\"casimir\", \"p_psi\"]"), with("[\"p_psi\", \"casimir\"]"));
}

// Where scenarios come from.

std::string open_error(const std::string& name) {
  try {
    ScenarioSource::open(name).resolve();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

TEST(ScenarioOpen, UnknownNames) {
  EXPECT_THAT(open_error("dzanibekov"),
              HasSubstr("no built-in scenario is called 'dzanibekov'; did you mean 'dzhanibekov'?"));
  EXPECT_THAT(open_error("coursework.toml"), StartsWith("coursework.toml: no such file"));
  EXPECT_THAT(open_error("coursework.toml"), HasSubstr("did you mean 'coursework'?"));
  EXPECT_THAT(open_error("./coursework"), StartsWith("./coursework: no such file"));
  EXPECT_THAT(open_error("no/such/file.toml"), StartsWith("no/such/file.toml: no such file"));
  EXPECT_THAT(open_error("./"), HasSubstr("is a folder"));
  EXPECT_THAT(open_error(""), HasSubstr("; ./run energy_drift --list scenarios prints all "));
  EXPECT_THAT(open_error("a\nb/c"), StartsWith("a\\x0ab/c: no such file"));
}

TEST(ScenarioOpen, FilesByPath) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "my top.toml").string();
  std::ofstream(path) << base;
  const ScenarioSource source = ScenarioSource::open(path);
  EXPECT_EQ(source.name(), "my top");
  EXPECT_EQ(source.resolve().canonical, resolved(base).canonical);
  std::ofstream(path) << changed("mass = 2.0", "mass = 0");
  EXPECT_THAT(open_error(path), StartsWith(path + ":7:8: body.0.mass: 0 is not a valid mass"));
}

// The built-in ones.

Scenario builtin(const char* name) { return ScenarioSource::open(name).resolve(); }

double initial_energy(const Scenario& s) {
  const auto system = make_system<double>(s.problem, {});
  const Measurement<double> m = system->measure(system->start().y);
  return m.kinetic + m.potential;
}

TEST(BuiltinScenarios, AllResolveAndAreDocumented) {
  EXPECT_GE(builtin_scenarios().size(), 17u);
  for (const BuiltinScenario& b : builtin_scenarios()) {
    const Scenario s = builtin(std::string(b.name).c_str());
    EXPECT_EQ(s.name, b.name);
    EXPECT_FALSE(s.title.empty()) << b.name;
    EXPECT_FALSE(s.description.empty()) << b.name;
    EXPECT_TRUE(std::isfinite(initial_energy(s))) << b.name;
    EXPECT_THAT(std::string(b.text), HasSubstr("\n# ")) << b.name << " must open with its physics";
  }
}

TEST(BuiltinScenarios, NumbersCarryUnits) {
  for (const BuiltinScenario& b : builtin_scenarios()) {
    std::istringstream lines{std::string(b.text)};
    for (std::string line; std::getline(lines, line);) {
      const std::size_t equals = line.find(" = ");
      const bool number =
          equals != std::string::npos && std::string("0123456789-[{").find(line[equals + 3]) != std::string::npos;
      if (number && line.find("[\"") == std::string::npos && line[0] != '#') {
        EXPECT_NE(line.find("# "), std::string::npos) << b.name << ": " << line;
      }
    }
  }
}

TEST(BuiltinScenarios, ReferenceNumbers) {
  EXPECT_NEAR(initial_energy(builtin("peters_hsu")), 368.546416625, 1e-9);
  EXPECT_NEAR(initial_energy(builtin("simo_wong")), 1269.975005208, 1e-9);
  EXPECT_NEAR(initial_energy(builtin("oscillator")), 0.5, 1e-15);
  const auto momentum_body = [](const char* name) {
    const Scenario s = builtin(name);
    EXPECT_TRUE(s.problem.starts[0].angular_velocity_in_body) << name;
    return Vector(s.problem.bodies[0].inertia * s.problem.starts[0].angular_velocity);
  };
  EXPECT_LE((momentum_body("dzhanibekov") - Vector(0, 2, 0.01)).norm(), 1e-17);
  EXPECT_LE((momentum_body("hairer_vilmart") - Vector(1.8, 0.4, -0.9)).norm(), 1e-15);
  EXPECT_LE((momentum_body("detest_b5") - Vector(0, 3 * std::sqrt(0.51), std::sqrt(3.0))).norm(), 1e-15);
  for (const Body& cube : builtin("five_cubes").problem.bodies) EXPECT_NEAR(cube.inertia(2, 2), 1 / 6.0, 1e-16);
  // I = m w²/12 + m l²/12 + m l²/4
  EXPECT_NEAR(builtin("physical_pendulum").problem.bodies[0].inertia(0, 0), 0.0004 / 12 + 1 / 3.0, 1e-15);
}

TEST(BuiltinScenarios, TwoBodiesAreOnTheirEllipse) {
  const Problem p = builtin("two_bodies").problem;
  const double r = (p.starts[1].position - p.starts[0].position).norm();
  const double v = (p.starts[1].velocity - p.starts[0].velocity).norm();
  EXPECT_NEAR(1 / (2 / r - v * v / 2), 1, 1e-14) << "the semi-major axis, with G (m1 + m2) = 2";
  EXPECT_NEAR(r, 1.5, 1e-15);
}

std::string readme() {
  std::ifstream file(std::string(POLHODE_TESTS_DIR) + "/../experiments/README.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The README's tables of keys are written by hand; this keeps them whole.
TEST(ScenarioReadme, NamesEveryKey) {
  const std::string text = readme();
  const auto expect_named = [&](std::string_view name) { EXPECT_THAT(text, HasSubstr('`' + std::string(name) + '`')); };
  for (const ScenarioKey& key : root_keys()) expect_named(key.name);
  for (const ScenarioKey& key : body_keys()) expect_named(key.name);
  for (const ForceEntry& entry : force_catalogue()) {
    expect_named(entry.kind.name);
    for (const Parameter& p : entry.kind.parameters) expect_named(p.key);
  }
  for (const ShapeKind& kind : shape_catalogue()) {
    expect_named(kind.name);
    for (const Parameter& p : kind.parameters) expect_named(p.key);
  }
  for (const InvariantKind& kind : invariant_catalogue()) expect_named(kind.name);
  for (const BuiltinScenario& b : builtin_scenarios()) expect_named(b.name);
}

TEST(ScenarioReadme, ItsExampleResolves) {
  const std::string text = readme(), fence = "```toml\n";
  const std::size_t begin = text.find(fence) + fence.size();
  const Scenario s = resolved(text.substr(begin, text.find("```", begin) - begin));
  EXPECT_EQ(s.problem.bodies.size(), 1u);
}

}  // namespace
}  // namespace polhode::study
