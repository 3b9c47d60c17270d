// SPDX-License-Identifier: BSD-3-Clause
// The direction from which a scenario is drawn: a parallel projection from above and from the side, without
// perspective.
#pragma once

#include "core/math/linear_algebra.hpp"
#include "core/problem/problem.hpp"

namespace polhode::study::inline report::inline drawing {

using PagePoint = Eigen::Vector2d;  ///< place on the page, measured to the right and downwards

/// Sum of the uniform accelerations of a problem, m/s², world axes; zero without gravity.
Vector3<double> gravity_of(const Problem& problem);

class View {
 public:
  /// `up` (world, not zero) points upwards on the page.
  explicit View(const Vector3<double>& up);

  const Vector3<double>& toward() const { return toward_; }                ///< unit vector to the viewer, world axes
  double depth(const Vector3<double>& x) const { return toward_.dot(x); }  ///< depth, larger for a nearer point, m

  /// A point of the world on the page; m before fit(), units of the picture after it.
  PagePoint on_page(const Vector3<double>& x) const { return scale_ * direction(x) + shift_; }
  /// A direction of the world on the page, m.
  PagePoint direction(const Vector3<double>& d) const { return {right_.dot(d), -above_.dot(d)}; }

  double scale() const { return scale_; }  ///< units of the picture in a metre across the line of sight

  void fit(double scale, const PagePoint& shift) {
    scale_ = scale;
    shift_ = shift;
  }

 private:
  Vector3<double> right_, above_, toward_;
  double scale_ = 1;
  PagePoint shift_ = PagePoint::Zero();
};

}  // namespace polhode::study::report::drawing
