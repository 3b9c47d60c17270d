// SPDX-License-Identifier: BSD-3-Clause
// The first view: all bodies in the picture, and no more empty room about them than needed.
#include "experiments/viewer/drawing/default_camera.hpp"

#include <gtest/gtest.h>

#include "tests/viewer/stage/stage.hpp"

namespace polhode::viewer::default_camera_test {
namespace {

/// The reach of the bodies' corners towards an edge of the picture, in shares of the half picture.
double reach(const Camera& camera, std::span<const Frame> frames, double width_over_height) {
  const int height = 1000, width = int(height * width_over_height);
  double most = 0;
  for (const Frame& frame : frames) {
    for (const BodySnapshot<double>& body : frame.bodies) {
      for (unsigned i = 0; i < 8; ++i) {
        const Vector3<double> corner =
            body.position + 0.2 * Vector3<double>(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        const auto at = camera.pixel(corner, width, height);
        if (!at) return std::numeric_limits<double>::infinity();
        most = std::max({most, std::abs(2 * (*at)[0] / width - 1), std::abs(2 * (*at)[1] / height - 1)});
      }
    }
  }
  return most;
}

void expect_fit(const study::Scene& scene, const std::vector<Frame>& frames) {
  for (const double shape : {0.5, 1.0, 16.0 / 9, 3.0}) {
    const double most = reach(default_camera(scene, frames, shape), frames, shape);
    EXPECT_LT(most, 1) << shape;
    EXPECT_GT(most, 0.6) << shape;
  }
}

TEST(DefaultCamera, SeesEveryBodyWhole) {
  expect_fit(cubes(1), {standing_at({{3, 4, 5}})});
  expect_fit(cubes(5), {standing_at({{0, 0, 0}, {3, 0, 0}, {6, 0, 0}, {9, 0, 0}, {12, 0, 0}})});
  expect_fit(cubes(3), {standing_at({{0, 0, 0}, {0, 0, 5}, {0.3, 0, 9}})});
}

TEST(DefaultCamera, SeesWhereTheyGo) {
  const std::vector<Frame> frames = {standing_at({{0, 0, 0}}), standing_at({{4, 1, 2}}), standing_at({{8, 2, 0}})};
  expect_fit(cubes(1), frames);
}

TEST(DefaultCamera, SeesTheEndsOfJointsAndTheirReactions) {
  study::Scene scene = cubes(1);
  study::SceneJoint& rod = scene.joints.emplace_back();
  rod.ends.anchor_other = {0, 0, 3};
  const std::vector<Frame> frames = {standing_at({{0, 0, 0}})};
  const Camera camera = default_camera(scene, frames, 1.5);
  for (const Vector3<double>& x : {Vector3<double>(0, 0, 3), Vector3<double>(0, 1.5, 0), Vector3<double>(0, 0, -1.5)}) {
    const Eigen::Vector2d at = camera.pixel(x, 1500, 1000).value();
    EXPECT_TRUE(at[0] > 0 && at[0] < 1500 && at[1] > 0 && at[1] < 1000) << x.transpose();
  }
}

TEST(DefaultCamera, AFloorAndWhatIsNotFiniteDoNotCount) {
  study::Scene scene = cubes(2);
  const std::vector<Frame> frames = {standing_at({{0, 0, 0}, {1, 1, 0}})};
  const Camera alone = default_camera(scene, frames, 1.5);
  add_floor(scene, -100);
  EXPECT_EQ(default_camera(scene, frames, 1.5).distance, alone.distance);
  std::vector<Frame> broken = frames;
  broken.push_back(standing_at({{0, 0, std::numeric_limits<double>::quiet_NaN()}, {1, 1, 0}}));
  EXPECT_EQ(default_camera(scene, broken, 1.5).distance, alone.distance);
}

TEST(DefaultCamera, ARowIsSeenFromItsSide) {
  for (const double angle : {0.0, 0.7, 2.5}) {
    std::vector<Vector3<double>> row;
    for (int i = 0; i < 6; ++i) row.push_back(2.0 * i * Vector3<double>(std::cos(angle), std::sin(angle), 0));
    const std::vector<Frame> frames = {standing_at(row)};
    const Camera camera = default_camera(cubes(6), frames, 1.8);
    const Vector3<double> looks = (camera.target - camera.eye()).normalized();
    EXPECT_LT(std::abs(looks.dot(row[1].normalized())), 0.4) << angle;
  }
}

}  // namespace
}  // namespace polhode::viewer::default_camera_test
