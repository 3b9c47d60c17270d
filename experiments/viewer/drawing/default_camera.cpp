// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/default_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/viewer/drawing/marks.hpp"
#include "experiments/viewer/drawing/places.hpp"

namespace polhode::viewer::inline drawing {

namespace {

struct Ball {
  Vector3<double> middle;
  double radius;
};

std::vector<Ball> balls_of(const study::Scene& scene, std::span<const Frame> frames, const Look& look) {
  const Cast cast = cast_of(scene);
  const double arrows = cast.typical_radius * std::max(look.angular_velocity ? longest_angular_velocity : 0,
                                                       look.angular_momentum ? longest_angular_momentum : 0);
  std::vector<Ball> balls;
  const auto add = [&](const Vector3<double>& middle, double radius) {
    if (middle.allFinite()) balls.push_back({middle, radius});
  };
  for (const Frame& frame : frames) {
    for (std::size_t i = 0; i < std::min(frame.bodies.size(), cast.moving.size()); ++i) {
      const BodySnapshot<double>& body = frame.bodies[i];
      add(body.position, std::max(look.axes ? axis_length(cast.radius[i]) : cast.radius[i], arrows));
      const Vector3<double>& center = scene.bodies[cast.moving[i]].center_of_mass;
      if (!center.isZero()) add(body.position - rotation_matrix(body.orientation) * center, 0.1 * cast.radius[i]);
    }
    const Places places(scene, cast, frame);
    for (const study::SceneJoint& joint : scene.joints) {
      const double around = look.reactions ? longest_reaction * cast.joint_size : 0.1 * cast.typical_radius;
      if (look.joints || look.reactions) add(places.from(joint.ends), joint.radius + around);
      if (look.joints && !joint.on_plane) add(places.to(joint.ends), 0.1 * cast.typical_radius);
    }
  }
  for (const study::SceneLink& spring : scene.springs) {
    if (!spring.other) add(spring.anchor_other, 0.1 * cast.typical_radius);
  }
  return balls;
}

/// The azimuth at which the longest horizontal extent of the balls lies across the picture, rotated slightly for a view
/// in perspective. Of the two, the one nearer to the usual azimuth.
double azimuth_across(std::span<const Ball> balls, double usual) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Ball& ball : balls) mean += ball.middle.head<2>() / double(balls.size());
  double xx = 0, yy = 0, xy = 0, size = 0;
  for (const Ball& ball : balls) {
    const Eigen::Vector2d d = ball.middle.head<2>() - mean;
    xx += d[0] * d[0], yy += d[1] * d[1], xy += d[0] * d[1], size += ball.radius * ball.radius;
  }
  const double spread = std::hypot(xx - yy, 2 * xy);
  if (!(spread > 0.5 * (xx + yy)) || !(xx + yy > size / 4)) return usual;
  constexpr double aside = 0.35;
  const double along = std::atan2(2 * xy, xx - yy) / 2;
  double best = usual, least = std::numeric_limits<double>::infinity();
  for (const double side : {-1.0, 1.0}) {
    for (const double turn : {-aside, aside}) {
      const double azimuth = std::remainder(along + side * std::numbers::pi / 2 + turn, 2 * std::numbers::pi);
      const double off = std::abs(std::remainder(azimuth - usual, 2 * std::numbers::pi));
      if (off < least) best = azimuth, least = off;
    }
  }
  return best;
}

/// Fits the balls between two opposite edges of the picture. A ball of radius r, x across and z towards the eye from
/// the target, is inside both edges at distance d if (d − z) s ∓ (x − shift) c ≥ r, with s and c the sine and cosine of
/// half the angle of view.
struct Fit {
  double distance, shift;
  Fit(std::span<const Ball> balls, const Vector3<double>& across, const Vector3<double>& back, double half_angle) {
    const double s = std::sin(half_angle), c = std::cos(half_angle);
    double right = -std::numeric_limits<double>::infinity(), left = right;
    for (const Ball& ball : balls) {
      const double x = across.dot(ball.middle), z = back.dot(ball.middle);
      right = std::max(right, ball.radius + z * s + x * c);
      left = std::max(left, ball.radius + z * s - x * c);
    }
    distance = (right + left) / (2 * s);
    shift = (right - left) / (2 * c);
  }
};

}  // namespace

Camera default_camera(const study::Scene& scene, std::span<const Frame> frames, double width_over_height,
                      const Look& look) {
  Camera camera;
  std::vector<Ball> balls = balls_of(scene, frames, look);
  if (balls.empty()) return camera;
  camera.azimuth = azimuth_across(balls, camera.azimuth);

  Eigen::AlignedBox3d box;
  for (const Ball& ball : balls) box.extend(ball.middle);
  const Vector3<double> middle = box.center();
  for (Ball& ball : balls) ball.middle -= middle;
  constexpr double margin = 1.08;
  const double slope = std::tan(camera.field_of_view / 2) / margin;
  const Eigen::Matrix4d axes = camera.view();
  const auto axis = [&](int k) { return Vector3<double>(axes.block<1, 3>(k, 0).transpose()); };
  const Fit level(balls, axis(0), axis(2), std::atan(slope * width_over_height)),
      upright(balls, axis(1), axis(2), std::atan(slope));
  camera.target = middle + level.shift * axis(0) + upright.shift * axis(1);
  camera.distance = std::max({level.distance, upright.distance, 1e-6});
  return camera;
}

}  // namespace polhode::viewer::drawing
