// SPDX-License-Identifier: BSD-3-Clause
// A perspective camera on a sphere about a target, z up.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/math/linear_algebra.hpp"

namespace polhode::viewer::inline drawing {

struct Camera {
  Vector3<double> target = Vector3<double>::Zero();  ///< point in the centre of the picture, m
  double distance = 5;                               ///< distance from the target, m
  double azimuth = 0.7;                              ///< angle about z from x, rad
  double elevation = 0.35;                           ///< angle above the horizon, less than at the poles, rad
  double field_of_view = 0.8;                        ///< angle from the lower to the upper edge, rad

  Vector3<double> eye() const;
  /// Rotation from world to camera axes: x right, y up, z towards the viewer.
  Eigen::Matrix4d view() const;
  /// Projection from camera axes to OpenGL's clip space.
  Eigen::Matrix4d projection(double width_over_height) const;

  /// Position of a point of the world in a picture of that size: pixels right of its left edge and below its upper
  /// edge. Absent for a point behind the eye.
  std::optional<Eigen::Vector2d> pixel(const Vector3<double>& point, int width, int height) const;

  void orbit(double by_azimuth, double by_elevation);
  void zoom(double factor);           ///< scales the distance
  void pan(double right, double up);  ///< moves the target by these lengths, m
  /// Moves the camera so that a ball with that centre and radius (m) is completely visible.
  void look_at(const Vector3<double>& middle, double radius);
};

}  // namespace polhode::viewer::drawing
