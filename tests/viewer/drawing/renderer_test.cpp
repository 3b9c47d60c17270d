// SPDX-License-Identifier: BSD-3-Clause
// Pictures show what the frames say: bodies where the camera projects them, the near before the far.
#include "experiments/viewer/drawing/renderer.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/viewer/stage/stage.hpp"

namespace polhode::viewer::renderer_test {
namespace {

class RendererStage : public PictureTest {};

const std::vector<Vector3<double>> apart = {{0, 0, 0}, {1.5, -1, 0.5}, {-1, 1.5, -0.7}, {0.5, 1, 1.2}};

Camera camera() {
  Camera c;
  c.distance = 7;
  return c;
}

void expect_at(const Picture& picture, Colour colour, int left, int right, const Eigen::Vector2d& pixel) {
  const Found found = find_colour(picture, colour, left, right);
  EXPECT_GT(found.pixels, 100u);
  EXPECT_NEAR(found.right, pixel[0], 2);
  EXPECT_NEAR(found.down, pixel[1], 2);
}

TEST_F(RendererStage, BodiesAreWhereTheCameraProjectsThem) {
  const study::Scene scene = cubes(apart.size());
  Renderer renderer(scene);
  Frame frame = standing_at(apart);
  frame.bodies[1].orientation = quaternion_from_rotation_vector<double>(Vector3<double>(0.3, -0.8, 0.5));
  const Picture picture = draw(renderer, frame, camera());
  for (std::size_t i = 0; i < apart.size(); ++i) {
    expect_at(picture, body_colour(i), 0, width, *camera().pixel(apart[i], width, height));
  }
}

TEST_F(RendererStage, FarFromTheOriginTooWhereFloatsAreCoarse) {
  const Vector3<double> far(1e7, -3e7, 2e7);
  Renderer renderer(cubes(1));
  Camera there = camera();
  there.target += far;
  const Vector3<double> position = far + Vector3<double>(0.5, 1, -0.5);
  expect_at(draw(renderer, standing_at({position}), there), body_colour(0), 0, width,
            *there.pixel(position, width, height));
}

TEST_F(RendererStage, RunsSideBySideEachInItsHalf) {
  Renderer renderer(cubes(2));
  const Frame left = standing_at({{0, 0, 0.5}, {1, -1, 0}}), right = standing_at({{0.5, 0, -0.5}, {-1, 1, 0.6}});
  renderer.draw(left, camera(), {}, {0, 0, width / 2, height});
  renderer.draw(right, camera(), {}, {width / 2, 0, width / 2, height});
  const Picture picture = offscreen_->read();
  for (std::size_t i = 0; i < 2; ++i) {
    expect_at(picture, body_colour(i), 0, width / 2, *camera().pixel(left.bodies[i].position, width / 2, height));
    expect_at(picture, body_colour(i), width / 2, width, *camera().pixel(right.bodies[i].position, width / 2, height));
  }
}

TEST_F(RendererStage, TheNearHidesTheFar) {
  Renderer renderer(cubes(2));
  const Vector3<double> towards = (camera().eye() - camera().target).normalized();
  for (const std::size_t near : {0u, 1u}) {
    std::vector<Vector3<double>> places(2, Vector3<double>::Zero());
    places[near] = 1.5 * towards;
    const Picture picture = draw(renderer, standing_at(places), camera());
    EXPECT_GT(find_colour(picture, body_colour(near), 0, width).pixels, 1000u);
    EXPECT_EQ(find_colour(picture, body_colour(1 - near), 0, width).pixels, 0u);
  }
}

TEST_F(RendererStage, TheSameFrameGivesTheSameBytes) {
  study::Scene scene = cubes(apart.size());
  add_floor(scene, -1);
  Frame frame = standing_at(apart);
  for (BodySnapshot<double>& body : frame.bodies)
    body.angular_velocity = body.angular_momentum = Vector3<double>(1, 2, 3);
  frame.contacts.push_back({0, 1, {0.2, 0, 0}, Vector3<double>::UnitX(), 0.1});
  Look all;
  all.axes = all.angular_velocity = all.angular_momentum = all.polhode = true;
  Renderer one(scene), other(scene);
  const Picture first = draw(one, frame, camera(), all);
  EXPECT_TRUE(first.rgb == draw(one, frame, camera(), all).rgb);
  EXPECT_TRUE(first.rgb == draw(other, frame, camera(), all).rgb);
  EXPECT_GT(std::set<std::uint8_t>(first.rgb.begin(), first.rgb.end()).size(), 50u);  // not blank
}

TEST_F(RendererStage, AFixedBodyIsGreyAndStaysWhereItStarts) {
  study::Scene scene = cubes(2);
  scene.bodies[1].fixed = true;
  scene.bodies[1].start.position = {0.5, -1, 0.3};
  Renderer with(scene), without(cubes(1));
  const Frame frame = standing_at({{-1, 1, 0}});
  const Picture picture = draw(with, frame, camera()), empty = draw(without, frame, camera());
  std::size_t pixels = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (std::equal(picture.pixel(x, y), picture.pixel(x, y) + 3, empty.pixel(x, y))) continue;
      EXPECT_TRUE(is_shade(picture.pixel(x, y), colours::fixed)) << x << ", " << y;
      ++pixels;
      sum += Eigen::Vector2d(x + 0.5, y + 0.5);
    }
  }
  const Eigen::Vector2d expected = *camera().pixel(scene.bodies[1].start.position, width, height);
  EXPECT_GT(pixels, 100u);
  EXPECT_LT((sum / double(std::max<std::size_t>(pixels, 1)) - expected).norm(), 2);
}

TEST_F(RendererStage, AThousandCubesEachInItsPlace) {
  std::vector<Vector3<double>> places;
  for (int i = 0; i < 1000; ++i) places.push_back(Vector3<double>(0, i % 40 - 19.5, i / 40 - 12.0) * 0.8);
  Camera front;
  front.azimuth = front.elevation = 0;
  front.distance = 40;
  Renderer renderer(cubes(places.size()));
  const Picture picture = draw(renderer, standing_at(places), front);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d at = *front.pixel(places[i], width, height);
    EXPECT_TRUE(is_shade(picture.pixel(int(at[0]), int(at[1])), body_colour(i))) << i;
  }
}

TEST_F(RendererStage, WhatIsNotFiniteIsLeftOut) {
  Renderer renderer(cubes(apart.size()));
  Frame frame = standing_at(apart);
  frame.bodies[0].position[1] = std::numeric_limits<double>::quiet_NaN();
  frame.bodies[3].orientation[2] = std::numeric_limits<double>::infinity();
  frame.bodies[2].angular_velocity[2] = std::numeric_limits<double>::quiet_NaN();
  Look look;
  look.axes = look.angular_velocity = look.angular_momentum = look.polhode = true;
  look.selected = 2;
  draw(renderer, frame, camera(), look);
  const Picture picture = draw(renderer, frame, camera());
  for (const std::size_t i : {0u, 3u}) EXPECT_EQ(find_colour(picture, body_colour(i), 0, width).pixels, 0u);
  for (const std::size_t i : {1u, 2u}) {
    expect_at(picture, body_colour(i), 0, width, *camera().pixel(apart[i], width, height));
  }
}

TEST_F(RendererStage, AFrameOfAnotherSceneIsRefused) {
  Renderer renderer(cubes(3));
  EXPECT_THROW(renderer.draw(standing_at(apart), camera(), {}, whole), std::invalid_argument);
}

TEST_F(RendererStage, MultisamplingSmoothsWithoutMovingAnything) {
  Renderer alone(cubes(1));
  const Frame frame = standing_at({{0.4, 0.3, 0}});
  const Found plain = find_colour(draw(alone, frame, camera()), body_colour(0), 0, width);
  Offscreen smooth(width, height, 4);
  if (smooth.samples() == 1) GTEST_SKIP() << "the driver has no multisampling";
  Renderer renderer(cubes(1));
  renderer.draw(frame, camera(), {}, whole);
  const Found found = find_colour(smooth.read(), body_colour(0), 0, width);
  EXPECT_NEAR(found.right, plain.right, 0.3);
  EXPECT_NEAR(found.down, plain.down, 0.3);
}

}  // namespace
}  // namespace polhode::viewer::renderer_test
