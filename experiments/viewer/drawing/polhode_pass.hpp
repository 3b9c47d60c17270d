// SPDX-License-Identifier: BSD-3-Clause
// The polhode in an inset: Poinsot's inertia ellipsoid, the surface of constant energy 2T = ω · I ω, with the family of
// curves along which |L| is constant too, the one that the motion should follow, and the ω that a run has had.
// In world axes it is Poinsot's construction: where no torque acts the ellipsoid rolls, without slipping, on the plane
// ω · L = 2T, which stands still. Source: Poinsot 1834; Goldstein, Classical Mechanics, 1980, section 5.6.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/viewer/drawing/arrow_pass.hpp"
#include "experiments/viewer/drawing/gl_objects.hpp"
#include "experiments/viewer/drawing/line_pass.hpp"
#include "experiments/viewer/drawing/view_state.hpp"

namespace polhode::viewer::inline drawing {

/// The ellipsoid of one body at one instant; lengths are shares of the longest semi-axis.
struct InertiaEllipsoid {
  Matrix3<double> body;       ///< columns: the body's axes in those of the inset, which are its own or the world's
  Matrix3<double> axes;       ///< columns: the principal axes in those of the inset, right-handed
  Vector3<double> moments;    ///< kg m², ascending
  Vector3<double> semi_axes;  ///< the first is 1
  double unit = 1;            ///< rad/s, the longest semi-axis
  Vector3<double> omega;      ///< ω in units, the inset's axes
  Vector3<double> momentum;   ///< unit vector of L, likewise

  /// None where nothing turns.
  static std::optional<InertiaEllipsoid> of(const Matrix3<double>& inertia, const Vector3<double>& omega_in_body,
                                            const Matrix3<double>& body);
};

class PolhodePass {
 public:
  PolhodePass();

  static Rectangle area(const Rectangle& whole, Corner corner);
  /// Looks at the ellipsoid from where `main` looks at the scene, and at all within `reach` units.
  static Camera camera(const Camera& main, double reach);
  /// Where each axis of the inset ends: x, y, z of the body, then ω; in units.
  static std::array<Vector3<double>, 4> label_points(const InertiaEllipsoid& ellipsoid);

  /// `past`: ω so far, body axes, rad/s; `plane`: with the plane that touches the ellipsoid at ω. The viewport must be
  /// `area`.
  void draw(const ViewState& view, const InertiaEllipsoid& ellipsoid, std::span<const Vector3<double>> past, bool plane,
            LinePass& lines, ArrowPass& arrows);

 private:
  Program panel_, surface_;
  VertexArray nothing_, sphere_;
  std::vector<LineInstance> curve_;
  std::vector<ArrowInstance> vectors_;
};

}  // namespace polhode::viewer
