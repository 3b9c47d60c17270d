// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polhode::viewer::inline drawing {

Vector3<double> Camera::eye() const {
  const double level = std::cos(elevation);
  return target + distance * Vector3<double>(level * std::cos(azimuth), level * std::sin(azimuth), std::sin(elevation));
}

Eigen::Matrix4d Camera::view() const {
  const Vector3<double> back = (eye() - target).normalized();
  const Vector3<double> right = Vector3<double>::UnitZ().cross(back).normalized(), up = back.cross(right);
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.block<1, 3>(0, 0) = right.transpose();
  m.block<1, 3>(1, 0) = up.transpose();
  m.block<1, 3>(2, 0) = back.transpose();
  m.block<3, 1>(0, 3) = -m.block<3, 3>(0, 0) * eye();
  return m;
}

Eigen::Matrix4d Camera::projection(double width_over_height) const {
  const double near = 0.01 * distance, far = 100 * distance, high = 1 / std::tan(field_of_view / 2);
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m(0, 0) = high / width_over_height;
  m(1, 1) = high;
  m(2, 2) = (far + near) / (near - far);
  m(2, 3) = 2 * far * near / (near - far);
  m(3, 2) = -1;
  return m;
}

std::optional<Eigen::Vector2d> Camera::pixel(const Vector3<double>& point, int width, int height) const {
  const Eigen::Vector4d clip = projection(double(width) / height) * (view() * point.homogeneous());
  if (!(clip[3] > 0)) return std::nullopt;
  return Eigen::Vector2d((clip[0] / clip[3] + 1) / 2 * width, (1 - clip[1] / clip[3]) / 2 * height);
}

void Camera::orbit(double by_azimuth, double by_elevation) {
  constexpr double steepest = 1.55;
  azimuth = std::remainder(azimuth + by_azimuth, 2 * std::numbers::pi);
  elevation = std::clamp(elevation + by_elevation, -steepest, steepest);
}

void Camera::zoom(double factor) { distance = std::clamp(distance * factor, 1e-6, 1e12); }

void Camera::pan(double right, double up) {
  const Eigen::Matrix4d axes = view();
  target += right * axes.block<1, 3>(0, 0).transpose() + up * axes.block<1, 3>(1, 0).transpose();
}

void Camera::look_at(const Vector3<double>& middle, double radius) {
  target = middle;
  distance = std::max(radius, 1e-6) / std::sin(field_of_view / 2);
}

}  // namespace polhode::viewer::drawing
