// SPDX-License-Identifier: BSD-3-Clause
// The exact motion of a heavy symmetric top about a fixed pivot (Lagrange's top), attitude included, by elliptic
// functions. A body of any inertia that swings in a plane (a physical pendulum) moves as such a top, and is one here.
// Sources: Klein & Sommerfeld, Über die Theorie des Kreisels, ch. II and VI (the parameters α, β of the attitude as
// quotients of theta functions); Whittaker, Analytical Dynamics, 4th ed., sections 71 to 73; core/exact/theta_zero.hpp.
#pragma once

#include "core/exact/motion_at.hpp"
#include "core/exact/theta_zero.hpp"
#include "core/math/elliptic.hpp"
#include "core/math/linear_algebra.hpp"
#include "core/math/quaternion.hpp"

namespace polhode::inline core::inline exact {

/// With the third body axis from the pivot through the mass centre, the vertical up, I1 across and I3 along the axis,
/// Ω body axes, q = (w, x, y, z), u = cos θ:
///   a = I3Ω3/I1, b = p_φ/I1, β = 2mgl/I1, α = Ω1² + Ω2² + βu,
///   f(u) = (α − βu)(1 − u²) − (b − au)² = β(u − u1)(u − u2)(u − u3),  u1 ≤ u2 ≤ 1 ≤ u3,
///   u = u1 + (u2 − u1) sn²(λt + δ | m),  λ = ½√(β(u3 − u1)), m = (u2 − u1)/(u3 − u1).
/// Three complex functions give everything, and none is singular where the top passes the vertical:
///   w + iz, |·|² = (1 + u)/2;  x + iy, |·|² = (1 − u)/2;  Ω1 + iΩ2, |·|² = α − βu.
/// The angle of each is an integral of the third kind, Im (ż/z) = const + ½κ/(u − u_zero), κ² = −f(u_zero), where
/// u_zero = −1, 1 or α/β is where z would vanish.
class LagrangeTop {
 public:
  /// gravity: m/s², world; center_of_mass: m, body axes, from the pivot, on an axis of symmetry of inertia_body
  /// (kg m², about the pivot), or anywhere in the plane of a planar swing; orientation: body to world at t = 0, of any
  /// length; angular_velocity_body: rad/s. The numbers are taken as exact: what a motion near a sleeping top or a
  /// separatrix depends on is computed to 100 digits from them. Costs about 0.2 ms. Throws std::invalid_argument
  /// where applies() is false.
  LagrangeTop(double mass, const Matrix3<double>& inertia_body, const Vector3<double>& center_of_mass,
              const Vector3<double>& gravity, const Quaternion<double>& orientation,
              const Vector3<double>& angular_velocity_body);

  /// True if the body is such a top to round-off, or swings in a plane.
  static bool applies(const Matrix3<double>& inertia_body, const Vector3<double>& center_of_mass,
                      const Vector3<double>& gravity, const Quaternion<double>& orientation,
                      const Vector3<double>& angular_velocity_body);

  using Motion = TopAt<double>;

  /// The motion at t (s, of either sign), to a few units of round-off times 1 + (|ω| + λ) |t|. Costs about 0.2 µs.
  /// The orientation has length 1 and is continuous in t.
  Motion at(double t) const;

  /// Range of cos θ, the nutation.
  double lowest_cosine() const { return lowest_; }
  double highest_cosine() const { return highest_; }

 private:
  /// z(t) = √(least + gain s²) exp(i rate t) d start, s = sn or cn of λt + δ, d = θ/|θ| or its conjugate (sense −1) at
  /// λt + phase.
  struct Amplitude {
    double least = 0, gain = 0, rate = 0, sense = 1, phase = 0;
    ThetaZeroDirection theta;
    double start_re = 1, start_im = 0;
  };

  Quaternion<double> up_to_world_, body_to_axis_;
  Matrix3<double> axis_to_body_;
  double spin_ = 0;                    // Ω3, rad/s
  double phase_ = 0, phase_rate_ = 0;  // δ; λ, rad/s
  double lowest_ = 0, highest_ = 0;
  JacobiElliptic jacobi_{1};
  Amplitude wz_, xy_, turning_;
};

}  // namespace polhode::core::exact
