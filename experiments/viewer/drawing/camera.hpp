// SPDX-License-Identifier: BSD-3-Clause
// Where one looks from: a camera on a sphere about a target, z up, in perspective.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/math/linear_algebra.hpp"

namespace polhode::viewer::inline drawing {

struct Camera {
  Vector3<double> target = Vector3<double>::Zero();  ///< m, in the middle of the picture
  double distance = 5;                               ///< m, from the target
  double azimuth = 0.7;                              ///< rad, about z from x
  double elevation = 0.35;                           ///< rad, above the horizon; short of the poles
  double field_of_view = 0.8;                        ///< rad, from the lower to the upper edge

  Vector3<double> eye() const;
  /// World to camera axes: x right, y up, z towards the viewer.
  Eigen::Matrix4d view() const;
  /// Camera axes to clip space as OpenGL has it.
  Eigen::Matrix4d projection(double width_over_height) const;

  /// Where a point of the world is in a picture of that size: pixels right of its left edge and below its upper one.
  /// None of what is behind the eye.
  std::optional<Eigen::Vector2d> pixel(const Vector3<double>& point, int width, int height) const;

  void orbit(double by_azimuth, double by_elevation);
  void zoom(double factor);           ///< of the distance
  void pan(double right, double up);  ///< m, of the target
  /// Sees a ball of that middle and radius (m) whole.
  void look_at(const Vector3<double>& middle, double radius);
};

}  // namespace polhode::viewer
