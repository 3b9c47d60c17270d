// SPDX-License-Identifier: BSD-3-Clause
// Each switch of a Look changes the picture where it should, and nowhere far from there.
#include "experiments/viewer/drawing/look.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/viewer/stage/stage.hpp"

namespace polhode::viewer::look_test {
namespace {

class LookStage : public PictureTest {
 protected:
  void SetUp() override {
    PictureTest::SetUp();
    scene_ = cubes(2);
    scene_.bodies[0].inertia = Vector3<double>(1, 2, 3).asDiagonal();
    scene_.bodies[1].center_of_mass = {0, 0, 0.8};
    add_floor(scene_, -0.6);
    study::SceneLink spring;
    spring.anchor_other = {0, -1.5, 1.5};
    scene_.springs.push_back(spring);
    frame_ = standing_at({{0, 0, 0}, {0, 1, 0.5}});
    frame_.bodies[0].angular_velocity = {0, 0, 2};
    frame_.bodies[0].angular_momentum = {0, 0, -6};
    frame_.contacts.push_back({0, 2, {0.9, -0.9, -0.2}, Vector3<double>::UnitZ(), 0.1});
    frame_.cells.push_back(Bounds(Vector3<double>(-0.4, 0.6, 0.1), Vector3<double>(0.4, 1.4, 0.9)));
    trails_.push_back({1, {{0, 0.5, 1}, {0, 1, 1.1}, {0, 1.6, 1.2}}});
    polhode_ = {{0.1, 0, 2}, {0, 0.1, 2}, {-0.1, 0, 2}};
    camera_.distance = 6;
  }

  /// The picture with a switch turned one way and the other from a Look that shows little.
  void expect_switch(const std::function<void(Look&, bool)>& turn, const std::vector<Vector3<double>>& changed,
                     const std::vector<Vector3<double>>& kept) {
    if (!offscreen_) return;
    Look off;
    off.springs = off.joints = off.reactions = off.contacts = off.cells = off.trails = off.shadows = off.edges = false;
    Look on = off;
    turn(on, true);
    turn(off, false);
    Renderer renderer(scene_);
    const Past past{trails_, polhode_};
    const Picture without = draw(renderer, frame_, camera_, off, past);
    with_ = draw(renderer, frame_, camera_, on, past);
    for (const Vector3<double>& x : changed) EXPECT_TRUE(differ(without, with_, x)) << x.transpose();
    for (const Vector3<double>& x : kept) EXPECT_FALSE(differ(without, with_, x)) << x.transpose();
  }

  /// Within two pixels of a point.
  bool differ(const Picture& a, const Picture& b, const Vector3<double>& point) const {
    bool different = false;
    near(point,
         [&](int x, int y) { different = different || !std::equal(a.pixel(x, y), a.pixel(x, y) + 3, b.pixel(x, y)); });
    return different;
  }

  bool has(Colour colour, const Vector3<double>& point) const {
    bool found = false;
    near(point, [&](int x, int y) { found = found || is_shade(with_.pixel(x, y), colour); });
    return found;
  }

  int darkest(const Vector3<double>& point) const {
    int least = 255;
    near(point, [&](int x, int y) { least = std::min(least, int(with_.pixel(x, y)[0])); });
    return least;
  }

  void near(const Vector3<double>& point, const std::function<void(int, int)>& visit) const {
    const Eigen::Vector2d at = camera_.pixel(point, width, height).value();
    ASSERT_TRUE(at[0] >= 2 && at[0] < width - 3 && at[1] >= 2 && at[1] < height - 3) << point.transpose();
    for (int y = int(at[1]) - 2; y <= int(at[1]) + 2; ++y) {
      for (int x = int(at[0]) - 2; x <= int(at[0]) + 2; ++x) visit(x, y);
    }
  }

  study::Scene scene_;
  Frame frame_;
  std::vector<Trail> trails_;
  std::vector<Vector3<double>> polhode_;
  Camera camera_;
  Picture with_;
};

const Vector3<double> sky(-2, -2, 2), corner(0.2, 0.2, 0.2), face(0.05, 0.05, 0.2);

TEST_F(LookStage, Floor) {
  expect_switch([](Look& look, bool on) { look.floor = on; }, {{1.5, 0.5, -0.6}, {0.5, 1.5, -0.6}}, {sky, face});
}

TEST_F(LookStage, ShadowsLieOnTheFloorAwayFromTheLight) {
  // The light comes from (0.45, −0.25, 0.86): from the middle of the cube the shadow falls so far.
  const Vector3<double> shadow = Vector3<double>(0, 0, -0.6) + 0.6 / 0.86 * Vector3<double>(-0.45, 0.25, 0);
  expect_switch([](Look& look, bool on) { look.shadows = on; }, {shadow + Vector3<double>(0, 0.15, 0)},
                {sky, face, {1.5, -0.5, -0.6}});
}

TEST_F(LookStage, Edges) {
  expect_switch([](Look& look, bool on) { look.edges = on; }, {corner, {0.2, 0, 0.2}, {0, 0.2, 0.2}},
                {sky, face, {0.2, 0.05, 0}});
}

TEST_F(LookStage, Springs) {
  expect_switch([](Look& look, bool on) { look.springs = on; }, {{0, -1.45, 1.45}, {0, -1.5, 1.5}},
                {sky, {0, 1, 0.75}});
}

TEST_F(LookStage, ContactPointsNormalsAndDepths) {
  const Vector3<double> point = frame_.contacts[0].point;
  expect_switch([](Look& look, bool on) { look.contacts = on; }, {point, point + Vector3<double>(0, 0, 0.15)},
                {sky, face});
  if (!offscreen_) return;
  EXPECT_TRUE(has(colours::normal, point + Vector3<double>(0, 0, 0.15)));
  EXPECT_TRUE(has(colours::depth, point - Vector3<double>(0, 0, 0.045)));
  EXPECT_FALSE(has(colours::depth, point - Vector3<double>(0, 0, 0.1)));
  expect_switch(
      [](Look& look, bool on) {
        look.contacts = true;
        look.depth_scale = on ? 4 : 1;
      },
      {point - Vector3<double>(0, 0, 0.15)}, {sky, point - Vector3<double>(0, 0, 0.3)});
}

TEST_F(LookStage, JointsHaveAnchorsALineBetweenThemAndAnAxis) {
  study::SceneJoint open_hinge;
  open_hinge.ends.anchor = {0, 0, 0.6};
  open_hinge.ends.anchor_other = {0, 0, 1.6};
  open_hinge.axis = {0, 1, 0};
  scene_.joints.push_back(open_hinge);
  const Vector3<double> axis(0, 0.13, 0.6), between(0, 0, 1.1);
  expect_switch([](Look& look, bool on) { look.joints = on; }, {{0, 0, 0.6}, {0, 0, 1.6}, axis, between},
                {sky, {0, 0.13, 1.6}, {0, 0, 1.8}, {0, 0.25, 0.6}});
  if (!offscreen_) return;
  EXPECT_LT(darkest(axis), 60);
  EXPECT_LT(darkest(between), 60);
}

TEST_F(LookStage, AJointOnAPlaneHasNoSecondAnchor) {
  study::SceneJoint planar;
  planar.ends.anchor = {0, 0, 0.6};
  planar.ends.anchor_other = {0, 0, 1.2};
  planar.on_plane = true;
  scene_.joints.push_back(planar);
  expect_switch([](Look& look, bool on) { look.joints = on; }, {{0, 0, 0.6}}, {sky, {0, 0, 1.2}, {0, 0, 0.9}});
}

TEST_F(LookStage, ABodyThatRollsTouchesWhereTheReactionIs) {
  study::SceneJoint rolling;
  rolling.on_plane = true;
  rolling.radius = 0.6;
  scene_.joints.push_back(rolling);
  frame_.reactions.push_back({{0, -0.8, -0.6}, {0, 0, 1}});
  expect_switch([](Look& look, bool on) { look.joints = on; }, {{0, -0.8, -0.6}}, {sky, {0, 0, 0.6}});
}

TEST_F(LookStage, ReactionsAreArrowsToOneScaleWithTheirForces) {
  frame_.reactions.push_back({{0, -0.8, 0.4}, {0, 0, 20}});
  frame_.reactions.push_back({{0, -1.2, 0.4}, {0, 0, -10}});
  const double longest = longest_reaction * 0.2 * std::sqrt(3.0);
  const Vector3<double> up(0, -0.8, 0.4 + 0.8 * longest), half_way_down(0, -1.2, 0.4 - 0.3 * longest);
  expect_switch([](Look& look, bool on) { look.reactions = on; }, {up, half_way_down},
                {sky, {0, -0.8, 0.3}, {0, -1.2, 0.4 - 0.6 * longest}});
  if (!offscreen_) return;
  EXPECT_TRUE(has(colours::reaction, up));
  EXPECT_TRUE(has(colours::reaction, half_way_down));
  Renderer renderer(scene_);
  draw(renderer, frame_, camera_);
  const auto labels = renderer.labels(frame_, camera_, {}, whole);
  ASSERT_EQ(labels.size(), 2u);
  EXPECT_EQ(labels[0].text, "20 N");
  EXPECT_EQ(labels[1].text, "10 N");
}

TEST_F(LookStage, CellsOfTheBroadPhase) {
  expect_switch([](Look& look, bool on) { look.cells = on; }, {{0.4, 0.6, 0.5}, {0.4, 1.0, 0.9}, {0.4, 1.4, 0.1}},
                {sky, face});
}

TEST_F(LookStage, BodyAxes) {
  expect_switch([](Look& look, bool on) { look.axes = on; }, {}, {sky});
  if (!offscreen_) return;
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(has(colours::axes[std::size_t(k)], 0.3 * Vector3<double>::Unit(k))) << k;
}

TEST_F(LookStage, AngularVelocityAndMomentum) {
  expect_switch([](Look& look, bool on) { look.angular_velocity = on; }, {{0, 0, 0.4}},
                {sky, {0, 0, -0.4}, {0, 1, 0.75}});
  if (!offscreen_) return;
  EXPECT_TRUE(has(colours::angular_velocity, {0, 0, 0.4}));
  expect_switch([](Look& look, bool on) { look.angular_momentum = on; }, {{0, 0, -0.4}},
                {sky, {0, 0, 0.4}, {0, 1, 0.75}});
  EXPECT_TRUE(has(colours::angular_momentum, {0, 0, -0.4}));
}

TEST_F(LookStage, TrailsFade) {
  expect_switch([](Look& look, bool on) { look.trails = on, look.floor = false; }, {{0, 1.3, 1.15}, {0, 1.55, 1.19}},
                {sky, face});
  if (!offscreen_) return;
  EXPECT_LT(darkest(trails_[0].points[2]) + 40, darkest(trails_[0].points[0]));
}

TEST_F(LookStage, LinesAreAsWideAsAskedFor) {
  const Vector3<double> beside(0, 1.3, 1.15 + 0.05);
  expect_switch([](Look& look, bool on) { look.trails = true, look.line_scale = on ? 8 : 1; }, {beside}, {sky, face});
}

TEST_F(LookStage, TheSelectedBodyHasStrongEdges) {
  expect_switch([](Look& look, bool on) { look.edges = true, look.selected = on ? 1 : 9; }, {{0.2, 1.2, 0.7}},
                {sky, corner});
}

TEST_F(LookStage, ThePolhodeStaysInItsInset) {
  expect_switch([](Look& look, bool on) { look.polhode = on; }, {}, {sky, face});
  if (!offscreen_) return;
  Renderer renderer(scene_);
  for (const Corner place : {Corner::upper_left, Corner::upper_right, Corner::lower_left, Corner::lower_right}) {
    Look off, on;
    on.polhode = true;
    on.polhode_corner = place;
    const Picture without = draw(renderer, frame_, camera_, off),
                  with = draw(renderer, frame_, camera_, on, {{}, polhode_});
    const Rectangle inset = Renderer::polhode_area(whole, on);
    std::size_t inside = 0, outside = 0, curve = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int up = height - 1 - y;
        const bool in =
            x >= inset.left && x < inset.left + inset.width && up >= inset.bottom && up < inset.bottom + inset.height;
        const bool different = !std::equal(with.pixel(x, y), with.pixel(x, y) + 3, without.pixel(x, y));
        (in ? inside : outside) += different;
        curve += in && is_shade(with.pixel(x, y), colours::polhode);
      }
    }
    EXPECT_EQ(outside, 0u);
    EXPECT_GT(inside, std::size_t(inset.width * inset.height) * 9 / 10);
    EXPECT_GT(curve, 5u);
  }
}

TEST_F(LookStage, PoinsotsPlaneStandsInTheInset) {
  if (!offscreen_) return;
  Renderer renderer(scene_);
  Look look;
  look.polhode = true;
  look.trails = false;
  const Picture without = draw(renderer, frame_, camera_, look);
  look.poinsot = true;
  const Picture with = draw(renderer, frame_, camera_, look);
  const Rectangle inset = Renderer::polhode_area(whole, look);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int up = height - 1 - y;
      if (x >= inset.left && up >= inset.bottom && x < inset.left + inset.width && up < inset.bottom + inset.height)
        continue;
      ASSERT_TRUE(std::equal(with.pixel(x, y), with.pixel(x, y) + 3, without.pixel(x, y))) << x << ", " << y;
    }
  }
  const auto purple = [&](const Picture& picture) {
    std::size_t pixels = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = inset.left; x < width; ++x) {
        const std::uint8_t* p = picture.pixel(x, y);
        pixels += p[0] > p[1] + 25 && p[2] > p[1] + 15;
      }
    }
    return pixels;
  };
  EXPECT_GT(purple(with), purple(without) + 200);
}

TEST_F(LookStage, LabelsStandAtTheTipsOfTheArrows) {
  if (!offscreen_) return;
  Look look;
  look.axes = look.angular_velocity = true;
  Renderer renderer(scene_);
  draw(renderer, frame_, camera_, look);
  const auto labels = renderer.labels(frame_, camera_, look, whole);
  ASSERT_EQ(labels.size(), 7u);  // x, y, z of two bodies; one turns
  EXPECT_EQ(labels[0].text, "x");
  EXPECT_EQ(labels[3].text, "ω");
  const Eigen::Vector2d tip = *camera_.pixel({1.08 * 1.35 * 0.2 * std::sqrt(3.0), 0, 0}, width, height);
  EXPECT_NEAR(labels[0].right, tip[0], 1e-3);
  EXPECT_NEAR(labels[0].down, tip[1], 1e-3);
}

}  // namespace
}  // namespace polhode::viewer::look_test
