// SPDX-License-Identifier: BSD-3-Clause
// The drawing of a scenario: of every built-in one, to scale, hidden surfaces behind, and its data in words.
#include "experiments/study/report/drawing/scenario_drawing.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>

#include "collision/shapes/box.hpp"
#include "collision/shapes/sphere.hpp"
#include "experiments/study/report/drawing/scenario_words.hpp"
#include "experiments/study/report/drawing/solid.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "tests/experiments/study/report/result_files.hpp"

namespace polhode::study::report_tests::scenario_drawing_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Vector = Vector3<double>;

const View from_above(Vector::UnitZ());

Scenario scenario_of(std::string text) { return ScenarioSource::parse(std::move(text), "made_up.toml").resolve(); }

TEST(ScenarioDrawing, EveryBuiltInScenarioHasOne) {
  for (const BuiltinScenario& builtin : builtin_scenarios()) {
    SCOPED_TRACE(builtin.name);
    const Scenario scenario = ScenarioSource::open(std::string(builtin.name)).resolve();
    const ScenarioDrawing drawing = drawing_of(scenario);
    EXPECT_EQ(unbalanced(drawing.svg), "");
    EXPECT_LT(drawing.svg.size(), 600'000U);
    EXPECT_THAT(drawing.svg, HasSubstr("aria-label=\"Drawing of the scenario " + scenario.name));
    EXPECT_THAT(drawing.svg, HasSubstr("class=\"bar\""));
    EXPECT_THAT(drawing.svg, HasSubstr("class=\"outline\""));
    EXPECT_EQ(drawing.svg.find("nan"), std::string::npos);
    EXPECT_EQ(drawing.svg.find("inf\""), std::string::npos);
    EXPECT_EQ(drawing.svg, drawing_of(scenario).svg);
    EXPECT_LE(scenario_words(scenario).size(), 12U);
    EXPECT_EQ(drawing.svg.find("class=\"spin") != std::string::npos, drawing.reading.find("ω") != std::string::npos);
  }
}

TEST(ScenarioDrawing, AllPointsAreInThePicture) {
  for (const char* name : {"peters_hsu", "lagrange_top", "pile_10", "two_bodies", "spring_box", "five_cubes"}) {
    SCOPED_TRACE(name);
    const std::string svg = drawing_of(ScenarioSource::open(name).resolve()).svg;
    std::smatch box;
    ASSERT_TRUE(std::regex_search(svg, box, std::regex("viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")));
    const std::regex point("[ML](-?[0-9.]+) (-?[0-9.]+)");
    std::size_t points = 0;
    for (std::sregex_iterator at(svg.begin(), svg.end(), point), end; at != end; ++at, ++points) {
      EXPECT_GE(std::stod((*at)[1]), 0);
      EXPECT_LE(std::stod((*at)[1]), std::stod(box[1]));
      EXPECT_GE(std::stod((*at)[2]), 0);
      EXPECT_LE(std::stod((*at)[2]), std::stod(box[2]));
    }
    EXPECT_GT(points, 20U);
  }
}

/// The length that a path of a class has on the page.
double length_of(const std::string& svg, const std::string& style) {
  std::smatch found;
  const std::regex line("<path class=\"" + style + "\" d=\"M([-0-9.]+) ([-0-9.]+)L([-0-9.]+) ([-0-9.]+)\"");
  if (!std::regex_search(svg, found, line)) return 0;
  return std::hypot(std::stod(found[3]) - std::stod(found[1]), std::stod(found[4]) - std::stod(found[2]));
}

TEST(ScenarioDrawing, ABodyIsAsLongAsTheBarSays) {
  // A rod of 2 m along x: its dashed axis runs from the middle to its end, 1 m of the world's x.
  const Scenario scenario = scenario_of(
      "t_end = 1\n[[body]]\nmass = 1\nshape = { kind = \"box\", size = [2.0, 0.1, 0.1] }\n"
      "angular_velocity = [0, 0, 1]\n");
  const std::string svg = drawing_of(scenario).svg;
  std::smatch bar;
  ASSERT_TRUE(std::regex_search(svg, bar, std::regex(">([0-9.]+) m</text>")));
  const double metre = length_of(svg, "bar") / std::stod(bar[1]);
  EXPECT_NEAR(length_of(svg, "axis hidden") / metre, from_above.direction(Vector::UnitX()).norm(), 0.01);
}

TEST(ScenarioDrawing, AnArrowAlongTheLineOfSightIsACircle) {
  const Vector toward = from_above.toward();
  const std::string spin = fmt::format("angular_velocity = [{}, {}, {}]\n", toward[0], toward[1], toward[2]);
  const auto drawn = [](const std::string& with) {
    return drawing_of(scenario_of("t_end = 1\n[[body]]\nmass = 1\ninertia = [1, 2, 3]\n" + with)).svg;
  };
  EXPECT_THAT(drawn(spin), HasSubstr("class=\"spin round\""));
  EXPECT_EQ(drawn("angular_velocity = [0, 0, 1]\n").find("class=\"spin round\""), std::string::npos);
}

TEST(View, IsAParallelProjectionWithItsUpUpwards) {
  for (const Vector& up : {Vector(0, 0, 1), Vector(0, 1, 0), Vector(-3, 0.1, 0), Vector(1, 1, 1)}) {
    const View view(up);
    double squares = 0;  // sum over the axes, which is 2 for a parallel projection along a unit vector
    for (int k = 0; k < 3; ++k) squares += view.direction(Vector::Unit(k)).squaredNorm();
    EXPECT_NEAR(squares, 2, 1e-12);
    EXPECT_LT(view.direction(up).y(), 0);
    EXPECT_NEAR(view.direction(up).x(), 0, 1e-12);
    EXPECT_NEAR(view.direction(view.toward()).norm(), 0, 1e-12);
  }
}

TEST(Pieces, ABoxHasSixFacesOfWhichThreeAreSeen) {
  const auto pieces = pieces_of(surface_of(Box({1, 2, 3})));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].points.size(), 8U);
  ASSERT_EQ(pieces[0].faces.size(), 6U);
  for (const Piece::Face& face : pieces[0].faces) EXPECT_EQ(face.corners.size(), 4U);
  const SeenPiece box = seen(pieces[0], {}, from_above, true);
  EXPECT_EQ(box.faces.size(), 3U);
  ASSERT_EQ(box.outlines.size(), 1U);
  EXPECT_EQ(box.outlines[0].size(), 6U);
  EXPECT_TRUE(box.rings.empty());
}

TEST(Pieces, TheOutlineOfASphereIsACircle) {
  const auto pieces = pieces_of(surface_of(Sphere(2)));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(pieces[0].faces.empty());
  const SeenPiece ball = seen(pieces[0], {}, from_above, true);
  ASSERT_EQ(ball.outlines.size(), 1U);
  for (const Vector& x : ball.outlines[0]) EXPECT_NEAR(from_above.direction(x).norm(), 2, 0.06);
  EXPECT_GE(ball.rings.size(), 3U);
  for (const auto& ring : ball.rings)
    for (const Vector& x : ring) EXPECT_GT(from_above.depth(x), -0.3);  // the side that is seen
}

TEST(PaintingOrder, WhatStandsOnASlabIsPaintedAfterIt) {
  const auto slab = pieces_of(surface_of(Box({10, 10, 0.1}))), cube = pieces_of(surface_of(Box({1, 1, 1})));
  // A place at the far end of the slab: its middle is further from the viewer than that of the slab.
  const Vector away(-9 * from_above.toward()[0], -9 * from_above.toward()[1], 1.1);
  const std::vector<SeenPiece> pieces = {seen(cube[0], {away, Matrix3<double>::Identity()}, from_above, false),
                                         seen(slab[0], {}, from_above, false)};
  ASSERT_LT(from_above.depth(pieces[0].centre), from_above.depth(pieces[1].centre));
  EXPECT_EQ(painting_order(pieces, from_above), (std::vector<std::size_t>{1, 0}));
}

TEST(PaintingOrder, TheNearerIsPaintedLast) {
  const auto cube = pieces_of(surface_of(Box({1, 1, 1})));
  std::vector<SeenPiece> pieces;
  for (const double distance : {4.0, -4.0, 0.0})
    pieces.push_back(seen(cube[0], {distance * from_above.toward(), Matrix3<double>::Identity()}, from_above, false));
  EXPECT_EQ(painting_order(pieces, from_above), (std::vector<std::size_t>{1, 2, 0}));
}

TEST(ScenarioWords, SayMassesMomentsStartsAndForces) {
  const auto words = [](const char* name) { return scenario_words(ScenarioSource::open(name).resolve()); };
  EXPECT_THAT(words("peters_hsu"),
              Contains(HasSubstr("10 kg, a box of 0.1 × 0.4 × 0.9 m; principal moments of inertia 0.14167, 0.68333 and "
                                 "0.80833 kg m² about the mass centre; it starts with ω = (0.1, 5, 0.1) rad/s")));
  EXPECT_THAT(words("pile_10"), Contains(HasSubstr("cube_0 to cube_9 (10 bodies): each 1 kg")));
  EXPECT_THAT(words("spring_box"), Contains(HasSubstr("Spring between box and the world: stiffness 40 N/m")));
  EXPECT_THAT(words("two_bodies"),
              Contains("Point gravity between left and right: gravitational constant 1 m³/(kg s²)."));
  EXPECT_THAT(words("lagrange_top"), Contains(HasSubstr("it turns about the pivot at (0, 0, 0) m")));
  EXPECT_THAT(words("dzhanibekov"), Contains("No forces act."));
}

}  // namespace
}  // namespace polhode::study::report_tests::scenario_drawing_test
