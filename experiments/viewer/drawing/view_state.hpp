// SPDX-License-Identifier: BSD-3-Clause
// The camera in the layout of the shaders: positions are relative to the eye, so that float suffices for scenes of any
// size.
#pragma once

#include <cmath>

#include "experiments/viewer/drawing/camera.hpp"
#include "experiments/viewer/drawing/look.hpp"

namespace polhode::viewer::inline drawing {

struct ViewState {
  Vector3<double> eye;
  Eigen::Matrix4f to_clip;    ///< matrix from world axes, relative to the eye, to clip space
  Eigen::Vector3f forward;    ///< unit vector of the view, world axes
  Eigen::Vector2f half_size;  ///< pixels
  double distance;            ///< distance from the eye to the target, m
  Vector3<double> target;
  float line_scale;        ///< pixels for each unit of width
  float pixels_per_slope;  ///< pixels of a length of 1 m at a distance of 1 m

  ViewState(const Camera& camera, const Rectangle& area, double scale_of_lines)
      : eye(camera.eye()),
        half_size(float(area.width) / 2, float(area.height) / 2),
        distance(camera.distance),
        target(camera.target),
        line_scale(float(scale_of_lines)) {
    Eigen::Matrix4d turn = camera.view();
    turn.topRightCorner<3, 1>().setZero();
    to_clip = (camera.projection(double(area.width) / area.height) * turn).cast<float>();
    forward = (target - eye).normalized().cast<float>();
    pixels_per_slope = half_size[1] / float(std::tan(camera.field_of_view / 2));
  }

  Vector3<float> from_eye(const Vector3<double>& point) const { return (point - eye).cast<float>(); }

  /// Pixels of a length of 1 m at a point; points behind the eye count as close to it.
  double pixels_per_metre(const Vector3<double>& point) const {
    const double ahead = (point - eye).dot(forward.cast<double>());
    return double(pixels_per_slope) / std::max(ahead, 1e-3 * distance);
  }
};

}  // namespace polhode::viewer::drawing
