// SPDX-License-Identifier: BSD-3-Clause
// Scenes by hand, a picture without a display, and where a colour is in it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <vector>

#include "collision/shapes/box.hpp"
#include "experiments/study/scene/scene.hpp"
#include "experiments/viewer/drawing/renderer.hpp"
#include "experiments/viewer/pictures/offscreen.hpp"

namespace polhode::viewer {

inline study::Surface cube_surface(double edge) { return study::surface_of(Box(Vector3<double>::Constant(edge / 2))); }

/// Moving cubes of edge 0.4 m, as many as requested.
inline study::Scene cubes(std::size_t count) {
  study::Scene scene;
  scene.surfaces.push_back(cube_surface(0.4));
  for (std::size_t i = 0; i < count; ++i) {
    study::SceneBody body;
    body.name = "cube";
    body.surface = 0;
    body.mass = 1;
    scene.bodies.push_back(body);
  }
  return scene;
}

inline Frame standing_at(const std::vector<Vector3<double>>& positions) {
  Frame frame;
  for (const Vector3<double>& x : positions) {
    BodySnapshot<double> body;
    body.position = x;
    frame.bodies.push_back(body);
  }
  return frame;
}

/// A half-space below the bodies of a scene.
inline void add_floor(study::Scene& scene, double height) {
  study::SceneBody floor;
  floor.fixed = true;
  floor.floor_normal = Vector3<double>::UnitZ();
  floor.floor_offset = height;
  scene.bodies.push_back(floor);
}

/// True of the shades of a colour: lights are white.
inline bool is_shade(const std::uint8_t* pixel, Colour colour) {
  const double most = std::max({pixel[0], pixel[1], pixel[2], std::uint8_t(1)});
  const double full = std::max({colour.red, colour.green, colour.blue});
  return std::abs(pixel[0] / most - colour.red / full) < 0.05 &&
         std::abs(pixel[1] / most - colour.green / full) < 0.05 &&
         std::abs(pixel[2] / most - colour.blue / full) < 0.05;
}

struct Found {
  std::size_t pixels = 0;
  double right = 0, down = 0;  ///< the mean of their middles, from the left and upper edge of the part
};

/// The shades of a colour in the columns of a picture from `left` to `right`.
inline Found find_colour(const Picture& picture, Colour colour, int left, int right) {
  Found found;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = left; x < right; ++x) {
      if (!is_shade(picture.pixel(x, y), colour)) continue;
      ++found.pixels;
      found.right += x - left + 0.5;
      found.down += y + 0.5;
    }
  }
  found.right /= double(std::max<std::size_t>(found.pixels, 1));
  found.down /= double(std::max<std::size_t>(found.pixels, 1));
  return found;
}

/// A picture to draw into by Mesa's software renderer; the test is skipped where there is none.
class PictureTest : public testing::Test {
 protected:
  static constexpr int width = 640, height = 480;
  static constexpr Rectangle whole = {0, 0, width, height};

  void SetUp() override {
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    try {
      offscreen_ = std::make_unique<Offscreen>(width, height, 1);
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  Picture draw(Renderer& renderer, const Frame& frame, const Camera& camera, const Look& look = {},
               const Past& past = {}) {
    renderer.draw(frame, camera, look, whole, past);
    return offscreen_->read();
  }

  std::unique_ptr<Offscreen> offscreen_;
};

}  // namespace polhode::viewer
