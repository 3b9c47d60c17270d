// SPDX-License-Identifier: BSD-3-Clause
// The drawing of a scenario: surfaces of every shape of the catalogue, boxes that stand for an inertia, floors,
// springs.
#include "experiments/study/scene/scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "collision/shapes/box.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/shape_inertia.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "tests/collision/shapes/corner_obj.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::scene_test {
namespace {

using Vector = Vector3<double>;

std::string obj_file() {
  static const TemporaryFolder folder;
  const std::string path = (folder.path() / "corner.obj").string();
  write_corner_obj(path);
  return path;
}

/// Any shape of the catalogue, its numbers all different.
ShapePointer sample(const ShapeEntry& entry) {
  ShapeParameters sizes;
  double number = 0.4;
  for (const Parameter& p : entry.parameters) {
    sizes.values[p.key] = p.value;
    if (std::holds_alternative<double>(p.value)) sizes.values[p.key] = number;
    if (std::holds_alternative<Vector>(p.value)) sizes.values[p.key] = Vector(number, 3 * number, 5 * number);
    if (std::holds_alternative<std::string>(p.value)) sizes.values[p.key] = obj_file();
    number += 0.3;
  }
  return entry.make(sizes);
}

Vector corner(const Surface& s, std::size_t k) { return s.points[s.corners[k]].cast<double>(); }

double volume(const Surface& s) {
  double six = 0;
  for (std::size_t k = 0; k < s.corners.size(); k += 3)
    six += corner(s, k).dot(corner(s, k + 1).cross(corner(s, k + 2)));
  return six / 6;
}

/// Each edge as often in one direction as in the other, by where its ends are; of one convex piece once.
void expect_watertight(const Surface& s, bool convex) {
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, int> edges;
  const auto place = [&](std::size_t k) {
    const Vector3<float>& x = s.points[s.corners[k]];
    return Place{x[0], x[1], x[2]};
  };
  ASSERT_EQ(s.corners.size() % 3, 0u);
  for (std::size_t k = 0; k < s.corners.size(); k += 3) {
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>(0, 1), {1, 2}, {2, 0}})
      ++edges[{place(k + i), place(k + j)}];
  }
  for (const auto& [edge, times] : edges) {
    ASSERT_EQ((edges[{edge.second, edge.first}]), times);
    ASSERT_TRUE(times == 1 || !convex);
  }
}

/// Triangles turn counterclockwise seen along their normals, none of which lies more than the smoothed angle beside its
/// face.
void expect_normals_outward(const Surface& s) {
  ASSERT_EQ(s.points.size(), s.normals.size());
  for (std::size_t k = 0; k < s.corners.size(); k += 3) {
    const Vector across = (corner(s, k + 1) - corner(s, k)).cross(corner(s, k + 2) - corner(s, k)).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector n = s.normals[s.corners[k + i]].cast<double>();
      ASSERT_NEAR(n.norm(), 1, 1e-6);
      ASSERT_GT(n.dot(across), 0.86);
    }
  }
}

/// Depth of a point inside a convex shape, m: the least of h(d) - d·x over the directions, found by descent from d.
double depth(const Shape& shape, const Vector& x, Vector d) {
  const auto gap = [&](const Vector& u) { return u.dot(shape.support(u) - x); };
  double step = 1;
  for (int k = 0; k < 200 && step > 1e-12; ++k) {
    const Vector next = (d - step * (shape.support(d) - x)).normalized();
    if (gap(next) < gap(d)) d = next;
    else step /= 2;
  }
  return gap(d);
}

class SurfaceOf : public testing::TestWithParam<std::string> {};

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const ShapeEntry& e : shape_catalogue()) names.push_back(e.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, SurfaceOf, testing::ValuesIn(kinds()),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(SurfaceOf, IsClosedAndOutward) {
  const ShapePointer shape = sample(*find_shape(GetParam()));
  if (!shape->finite()) {
    EXPECT_THROW(surface_of(*shape), std::invalid_argument);
    return;
  }
  const Surface s = surface_of(*shape);
  const bool convex = shape->tag() != ShapeTag::compound;
  expect_watertight(s, convex);
  expect_normals_outward(s);
  EXPECT_NEAR(volume(s), shape->mass_properties().volume, 0.02 * shape->mass_properties().volume);
  if (!convex) return;
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    EXPECT_NEAR(depth(*shape, s.points[i].cast<double>(), s.normals[i].cast<double>()), 0, 1e-6);
  }
}

TEST(Surface, OfABoxIsExact) {
  const Surface s = surface_of(Box(Vector(0.2, 0.6, 1)));
  EXPECT_EQ(s.points.size(), 24u) << "8 corners with 3 normals each";
  EXPECT_EQ(s.corners.size(), 3 * 12u);
  EXPECT_NEAR(volume(s), 0.4 * 1.2 * 2, 1e-6);
  for (const Vector3<float>& x : s.points) EXPECT_EQ(x.cwiseAbs(), Vector3<float>(0.2f, 0.6f, 1.0f));
  for (const Vector3<float>& n : s.normals) EXPECT_FLOAT_EQ(n.cwiseAbs().sum(), 1) << "flat";
}

TEST(Surface, OfACylinderIsSmoothRoundItsSideAndFlatOnItsEnds) {
  const Surface s = surface_of(Cylinder(0.5, 2));
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    const Vector x = s.points[i].cast<double>(), n = s.normals[i].cast<double>();
    const Vector side(x[0] / 0.5, x[1] / 0.5, 0), end(0, 0, x[2]);
    EXPECT_NEAR(x.head<2>().norm(), 0.5, 1e-6);
    EXPECT_LT(std::min((n - side).norm(), (n - end).norm()), 1e-5);
  }
}

Scenario scenario_of(const std::string& text) { return ScenarioSource::parse(text, "test.toml").resolve(); }

/// The edges along the body axes.
Vector edges_of(const Scene& scene, std::size_t body) {
  Eigen::AlignedBox3d around;
  for (const Vector3<float>& x : scene.surfaces[*scene.bodies[body].surface].points) around.extend(x.cast<double>());
  return around.sizes();
}

TEST(Scene, DrawsABodyWithoutAShapeAsTheBoxOfItsInertia) {
  const Vector size(0.1, 0.9, 0.4);
  const Vector m = box_moments(3, size);
  const auto text = [](const Vector& v) {
    return "[" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) + "]";
  };
  const Scene scene = scene_of(scenario_of("t_end = 1\n[[body]]\nmass = 3\ninertia = " + text(m) + "\n"));
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_TRUE(scene.bodies[0].from_inertia);
  EXPECT_LT((edges_of(scene, 0) - size).norm(), 1e-4);
}

TEST(Scene, TurnsThatBoxToThePrincipalAxesAndPutsItAtTheMassCentre) {
  const Scenario scenario = scenario_of(R"(t_end = 1
[[body]]
pinned = true
position = [5, 0, 0]
orientation = [0.7071067811865476, 0, 0, 0.7071067811865476]
point_masses = [{ mass = 1, position = [1, 1, 1] }, { mass = 1, position = [3, 3, 1] }, { mass = 2, position = [2.5, 1.5, 1] },
                { mass = 2, position = [1.5, 2.5, 1] }]
)");
  const Scene scene = scene_of(scenario);
  EXPECT_LT((scene.bodies[0].start.position - Vector(5 - 2, 2, 1)).norm(), 1e-12) << "(2, 2, 1) turned about z";
  const Surface& s = scene.surfaces[*scene.bodies[0].surface];
  expect_watertight(s, true);
  expect_normals_outward(s);
  // Second moments along the diagonals (1, 1, 0) and (1, -1, 0) are 4 and 2 kg m², of 6 kg: edges √(12 · 4/6) and √(12
  // · 2/6).
  Eigen::AlignedBox3d turned;
  const double h = std::sqrt(0.5);
  for (const Vector3<float>& x : s.points) turned.extend(Vector(h * (x[0] + x[1]), h * (x[0] - x[1]), x[2]));
  EXPECT_NEAR(turned.sizes()[0], std::sqrt(8), 1e-6);
  EXPECT_NEAR(turned.sizes()[1], 2, 1e-6);
  EXPECT_NEAR(turned.sizes()[2], 0.04 * std::sqrt(8), 1e-6) << "flat: a least thickness";
  EXPECT_LT(turned.center().norm(), 1e-6);
}

TEST(Scene, HasFloorsSpringsAndSharedSurfaces) {
  const Scene scene = scene_of(scenario_of(R"(title = "Two copies"
t_end = 1
[[body]]
name = "ball"
mass = 1
shape = { kind = "sphere", radius = 0.1 }
repeat = [2, 1, 1]
spacing = [1, 0, 0]
[[body]]
name = "post"
static = true
[[body]]
name = "slope"
static = true
position = [0, 0, 1]
orientation = [0.7071067811865476, 0.7071067811865476, 0, 0]
shape = { kind = "half_space", offset = 2 }
[[force]]
kind = "spring"
bodies = ["ball_0", "ball_1"]
stiffness = 1
anchor_body = [0, 0, 0.1]
anchor_body_2 = [0, 0.1, 0]
[[force]]
kind = "damper"
bodies = ["ball_0"]
damping = 1
anchor_world = [0, 0, 3]
)"));
  EXPECT_EQ(scene.title, "Two copies");
  ASSERT_EQ(scene.bodies.size(), 4u);
  EXPECT_EQ(scene.bodies[0].surface, scene.bodies[1].surface);
  EXPECT_EQ(scene.surfaces.size(), 2u);
  EXPECT_FALSE(scene.bodies[0].from_inertia);
  EXPECT_TRUE(scene.bodies[2].fixed);
  EXPECT_NEAR(edges_of(scene, 2)[0], 0.25 * 0.2, 1e-6) << "a quarter of the smallest moving body";
  EXPECT_FALSE(scene.bodies[3].surface);
  EXPECT_LT((scene.bodies[3].floor_normal - Vector(0, -1, 0)).norm(), 1e-12) << "z turned by 90 degrees about x";
  EXPECT_NEAR(scene.bodies[3].floor_offset, 2, 1e-12);
  ASSERT_EQ(scene.springs.size(), 2u);
  EXPECT_EQ(scene.springs[0].other, 1u);
  EXPECT_EQ(scene.springs[0].anchor, Vector(0, 0, 0.1));
  EXPECT_EQ(scene.springs[0].anchor_other, Vector(0, 0.1, 0));
  EXPECT_FALSE(scene.springs[1].other);
  EXPECT_EQ(scene.springs[1].anchor_other, Vector(0, 0, 3));
}

TEST(Scene, HasTheAnchorsAndAxesOfItsJoints) {
  const Scene scene = scene_of(scenario_of(R"(
t_end = 1
[[body]]
name = "disk"
mass = 1
inertia = [1, 1, 1.5]
[[body]]
name = "floor"
static = true
orientation = [0.7071067811865476, 0.7071067811865476, 0, 0]
[[joint]]
name = "cross"
kind = "universal"
bodies = ["disk"]
anchor_body = [0, 0, 1]
anchor_world = [0, 0, 1]
axis_body = [2, 0, 0]
axis_body_2 = [0, 3, 0]
[[joint]]
name = "plane"
kind = "planar"
bodies = ["disk"]
axis_body = [0, 0, 1]
[[joint]]
name = "contact"
kind = "rolling"
bodies = ["disk", "floor"]
anchor_body_2 = [0, -2, 0]
radius = 2
normal = [0, 0, 5]
)"));
  ASSERT_EQ(scene.joints.size(), 3u);
  const SceneJoint &cross = scene.joints[0], &plane = scene.joints[1], &contact = scene.joints[2];
  EXPECT_EQ(cross.name, "cross");
  EXPECT_FALSE(cross.ends.other);
  EXPECT_FALSE(cross.on_plane);
  EXPECT_EQ(cross.ends.anchor, Vector(0, 0, 1));
  EXPECT_EQ(cross.ends.anchor_other, Vector(0, 0, 1));
  EXPECT_EQ(cross.axis, Vector(1, 0, 0));
  EXPECT_EQ(cross.axis_other, Vector(0, 1, 0));
  EXPECT_TRUE(plane.on_plane);
  EXPECT_EQ(plane.radius, 0);
  EXPECT_TRUE(contact.on_plane);
  EXPECT_EQ(contact.ends.other, 1u);
  EXPECT_EQ(contact.radius, 2);
  EXPECT_LT((contact.normal - Vector(0, 1, 0)).norm(), 1e-12) << "in the axes of the floor, z is its y";
}

TEST(Scene, OfEveryBuiltInScenarioShowsEachBody) {
  for (const BuiltinScenario& b : builtin_scenarios()) {
    const Scenario scenario = ScenarioSource::open(std::string(b.name)).resolve();
    const Scene scene = scene_of(scenario);
    ASSERT_EQ(scene.bodies.size(), scenario.problem.bodies.size()) << b.name;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const SceneBody& body = scene.bodies[i];
      ASSERT_EQ(body.from_inertia, !scenario.shapes[i]) << b.name;
      if (!body.surface) {
        EXPECT_NEAR(body.floor_normal.norm(), 1, 1e-12) << b.name;
        continue;
      }
      const Surface& s = scene.surfaces.at(*body.surface);
      ASSERT_GT(volume(s), 0) << b.name << ' ' << body.name;
      for (const Vector3<float>& x : s.points) ASSERT_TRUE(x.allFinite()) << b.name;
    }
  }
}

}  // namespace
}  // namespace polhode::study::scene_test
