// SPDX-License-Identifier: BSD-3-Clause
// The contents of a scenario as they are read.
#include "experiments/study/scenario/scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/experiments/study/scenario/scenario_texts.hpp"

namespace polhode::study::scenario_tests::scenario_test {
namespace {

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
  EXPECT_THAT(s.canonical(), HasSubstr("orientation=-1.0000009,0,0,0"));
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

}  // namespace
}  // namespace polhode::study::scenario_tests::scenario_test
