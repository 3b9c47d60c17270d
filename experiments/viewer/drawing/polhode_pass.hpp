// SPDX-License-Identifier: BSD-3-Clause
// Draws the polhode in an inset: Poinsot's inertia ellipsoid, the surface of constant energy 2T = ω · I ω; on it curves
// of constant |L|, the exact polhode among them, and the path of ω in the run. In world axes this is Poinsot's
// construction: without torque the ellipsoid rolls without slipping on the fixed plane ω · L = 2T. Source: Poinsot
// 1834; Goldstein, Classical Mechanics, 1980, section 5.6.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/viewer/drawing/arrow_pass.hpp"
#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/line_pass.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

/// The ellipsoid of one body at one instant. Lengths are relative to the longest semi-axis.
struct InertiaEllipsoid {
  Matrix3<double> body;       ///< columns: the axes of the body in the axes of the inset, which are body or world axes
  Matrix3<double> axes;       ///< columns: the principal axes in the axes of the inset, right-handed
  Vector3<double> moments;    ///< principal moments, ascending, kg m²
  Vector3<double> semi_axes;  ///< the first is 1
  double unit = 1;            ///< length of the longest semi-axis, rad/s
  Vector3<double> omega;      ///< ω relative to `unit`, in the axes of the inset
  Vector3<double> momentum;   ///< unit vector of L, in the axes of the inset

  /// The ellipsoid; absent for a body that does not rotate.
  static std::optional<InertiaEllipsoid> of(const Matrix3<double>& inertia, const Vector3<double>& omega_in_body,
                                            const Matrix3<double>& body);
};

class PolhodePass {
 public:
  PolhodePass();

  static Rectangle area(const Rectangle& whole, Corner corner);
  /// The camera of the inset: the direction of `main`, with everything within `reach` units visible.
  static Camera camera(const Camera& main, double reach);
  /// Tips of the axes of the inset, in units: x, y, z of the body, then ω.
  static std::array<Vector3<double>, 4> label_points(const InertiaEllipsoid& ellipsoid);

  /// `past`: ω so far (rad/s, body axes). `plane`: draws the plane that touches the ellipsoid at ω. The viewport must
  /// be `area`.
  void draw(const ViewState& view, const InertiaEllipsoid& ellipsoid, std::span<const Vector3<double>> past, bool plane,
            LinePass& lines, ArrowPass& arrows);

 private:
  Program panel_, surface_;
  VertexArray nothing_, sphere_;
  std::vector<LineInstance> curve_;
  std::vector<ArrowInstance> vectors_;
};

}  // namespace polhode::viewer::drawing
