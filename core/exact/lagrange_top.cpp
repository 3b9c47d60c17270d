// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/lagrange_top.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

namespace polhode::inline core::inline exact {
namespace {

using Precise = boost::multiprecision::cpp_bin_float_100;
using Precise3 = std::array<Precise, 3>;
using Precise4 = std::array<Precise, 4>;
using Complex = std::complex<double>;

/// Threshold below which a difference of roots is round-off of the 100 digits.
const Precise nothing("1e-44");

double positive(const Precise& x) { return x > nothing ? static_cast<double>(x) : 0.0; }
double root(const Precise& x) { return x > nothing ? static_cast<double>(sqrt(x)) : 0.0; }

Precise4 product(const Precise4& a, const Precise4& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}
Precise4 conjugate(const Precise4& q) { return {q[0], -q[1], -q[2], -q[3]}; }
Precise4 unit(const Precise4& q) {
  const Precise length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}
Precise norm(const Vector3<double>& v) {
  return sqrt(Precise(v[0]) * v[0] + Precise(v[1]) * v[1] + Precise(v[2]) * v[2]);
}
Precise3 direction(const Vector3<double>& v) {
  const Precise length = norm(v);
  return {v[0] / length, v[1] / length, v[2] / length};
}
/// Rotation that maps e3 to the unit vector v. If v points down, it is a rotation by π about e1 followed by the
/// smallest rotation to v.
Precise4 from_third_axis(const Precise3& v) {
  if (v[2] >= 0) return unit({1 + v[2], -v[1], v[0], 0});
  return product(unit({1 - v[2], v[1], -v[0], 0}), {0, 1, 0, 0});
}
Quaternion<double> rounded(const Precise4& q) {
  return {static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]), static_cast<double>(q[3])};
}

/// The three real roots of u³ − p u² + r u + s in ascending order (Viète).
Precise3 cubic_roots(const Precise& p, const Precise& r, const Precise& s) {
  const Precise shift = p / 3, third = (p * p / 3 - r) / 3;
  if (third <= 0) return {shift, shift, shift};
  const Precise rest = ((shift - p) * shift + r) * shift + s, size = sqrt(third);
  Precise cosine = -rest / (2 * third * size);
  cosine = cosine > 1 ? Precise(1) : cosine < -1 ? Precise(-1) : cosine;
  const Precise angle = acos(cosine) / 3, turn = 2 * acos(Precise(-1)) / 3;
  return {shift + 2 * size * cos(angle + turn), shift + 2 * size * cos(angle - turn), shift + 2 * size * cos(angle)};
}

double across(const Matrix3<double>& inertia, const Vector3<double>& axis) {
  return (inertia.trace() - axis.dot(inertia * axis)) / 2;
}

bool symmetric_about(const Matrix3<double>& inertia, const Vector3<double>& axis) {
  const Matrix3<double> along = axis * axis.transpose();
  const Matrix3<double> ideal =
      axis.dot(inertia * axis) * along + across(inertia, axis) * (Matrix3<double>::Identity() - along);
  return (inertia - ideal).cwiseAbs().maxCoeff() <= 8 * std::numeric_limits<double>::epsilon() * inertia.trace();
}

/// Unit axis of a planar swing, body axes: parallel to the angular velocity or, at rest, to the torque. Zero if the
/// motion is not a planar swing.
Vector3<double> swing_axis(const Matrix3<double>& inertia, const Vector3<double>& center,
                           const Vector3<double>& gravity, const Quaternion<double>& orientation,
                           const Vector3<double>& omega) {
  const Vector3<double> down = (rotation_matrix(orientation).transpose() * gravity).normalized();
  const Vector3<double> arm = center.normalized();
  const Vector3<double> axis = (omega.isZero(0) ? Vector3<double>(arm.cross(down)) : omega).stableNormalized();
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
  const Vector3<double> momentum = inertia * axis;
  const bool planar = std::abs(axis.dot(arm)) <= round_off && std::abs(axis.dot(down)) <= round_off &&
                      (momentum - axis.dot(momentum) * axis).norm() <= round_off * momentum.norm();
  return planar ? axis : Vector3<double>::Zero();
}

}  // namespace

bool LagrangeTop::applies(const Matrix3<double>& inertia_body, const Vector3<double>& center_of_mass,
                          const Vector3<double>& gravity, const Quaternion<double>& orientation,
                          const Vector3<double>& angular_velocity_body) {
  if (center_of_mass.isZero(0) || gravity.isZero(0)) return false;
  return symmetric_about(inertia_body, center_of_mass.stableNormalized()) ||
         !swing_axis(inertia_body, center_of_mass, gravity, orientation, angular_velocity_body).isZero(0);
}

LagrangeTop::LagrangeTop(double mass, const Matrix3<double>& inertia_body, const Vector3<double>& center_of_mass,
                         const Vector3<double>& gravity, const Quaternion<double>& orientation,
                         const Vector3<double>& angular_velocity_body) {
  if (!applies(inertia_body, center_of_mass, gravity, orientation, angular_velocity_body)) {
    throw std::invalid_argument("LagrangeTop: the body must be symmetric about its mass centre, or swing in a plane");
  }
  const Vector3<double> axis = center_of_mass.stableNormalized();
  double i1 = across(inertia_body, axis), i3 = axis.dot(inertia_body * axis);
  if (!symmetric_about(inertia_body, axis)) {
    const Vector3<double> hinge = swing_axis(inertia_body, center_of_mass, gravity, orientation, angular_velocity_body);
    i1 = i3 = hinge.dot(inertia_body * hinge);
  }

  const Precise4 up = from_third_axis(direction(-gravity)), to_body = from_third_axis(direction(center_of_mass));
  const Precise4 q =
      product(product(conjugate(up), unit({orientation[0], orientation[1], orientation[2], orientation[3]})), to_body);
  const Precise4 turned = product(
      product(conjugate(to_body), {0, angular_velocity_body[0], angular_velocity_body[1], angular_velocity_body[2]}),
      to_body);
  up_to_world_ = rounded(up);
  body_to_axis_ = polhode::conjugate(rounded(to_body));
  axis_to_body_ = rotation_matrix(rounded(to_body));

  const Precise &w1 = turned[1], &w2 = turned[2], &w3 = turned[3];
  spin_ = static_cast<double>(w3);
  const Precise g1 = 2 * (q[1] * q[3] - q[0] * q[2]), g2 = 2 * (q[2] * q[3] + q[0] * q[1]);
  const Precise above = 2 * (q[0] * q[0] + q[3] * q[3]), below = 2 * (q[1] * q[1] + q[2] * q[2]);  // 1 + u, 1 − u
  const Precise u = (above - below) / 2;
  const Precise a = i3 * w3 / i1, beta = 2 * mass * norm(gravity) * norm(center_of_mass) / i1;
  const Precise b = w1 * g1 + w2 * g2 + a * u, alpha = w1 * w1 + w2 * w2 + beta * u;
  const Precise rising = g1 * w2 - g2 * w1;  // rate u̇

  const Precise u_alpha = alpha / beta;
  Precise3 roots = cubic_roots(u_alpha + a * a / beta, 2 * a * b / beta - 1, u_alpha - b * b / beta);
  const bool at_rest = w1 == 0 && w2 == 0 && g1 == 0 && g2 == 0;  // a spinning top that is upright or hanging
  if (at_rest || roots[1] - roots[0] <= nothing) roots[0] = roots[1] = u;
  const auto& [u1, u2, u3] = roots;
  const Precise range = u2 - u1;
  const bool steady = range == 0;
  const double m = positive(range / (u3 - u1)), m_c = steady ? 1 : positive((u3 - u2) / (u3 - u1));
  lowest_ = static_cast<double>(u1);
  highest_ = static_cast<double>(u2);
  double to_highest = 0;  // λt + δ − K or λt + δ + K at t = 0
  if (!steady) {
    phase_rate_ = static_cast<double>(sqrt(beta * (u3 - u1))) / 2;
    jacobi_ = JacobiElliptic(m_c);
    const double sine = root(u - u1), cosine = root(u2 - u), sign = rising < 0 ? -1 : 1;
    phase_ = sign * elliptic_f(sine, cosine, m_c);
    to_highest = -sign * elliptic_f(cosine, std::sqrt(m_c) * sine, m_c);
  }

  // Builds the complex amplitude z(t). |z|² varies from `least` to `least` + `gain`. `rate` is the angular rate of z
  // (rad/s) at the largest |z|. The sign of `kappa` is the sense of rotation near the zero.
  const auto make = [&](const Precise& least, const Precise& gain, const Precise& rate, const Precise& kappa,
                        double beta_of_zero, double phase, Complex z, Complex z_dot) {
    Amplitude f;
    f.least = positive(least);
    f.gain = steady ? 0 : static_cast<double>(gain);
    f.rate = static_cast<double>(rate);
    f.sense = kappa < 0 ? -1 : 1;
    f.phase = phase;
    if (!steady) {
      f.theta = ThetaZeroDirection(m, m_c, beta_of_zero);
      f.rate -= f.sense * phase_rate_ * f.theta.slope_at_k();
    }
    const Complex along = z != 0.0 ? z : z_dot;
    if (along == 0.0) return f;
    const auto [turn, re, im] = f.theta(phase);
    const Complex start = along / std::abs(along) * std::polar(1.0, -f.sense * turn) * Complex(re, -f.sense * im);
    f.start_re = start.real();
    f.start_im = start.imag();
    return f;
  };
  const auto number = [](const Precise& re, const Precise& im) {
    return Complex(static_cast<double>(re), static_cast<double>(im));
  };
  const Complex wz = number(q[0], q[3]), xy = number(q[1], q[2]), omega = number(w1, w2), vertical = number(g1, g2);
  const auto ratio = [](const Precise& x, const Precise& y) { return y > nothing ? Precise(x / y) : Precise(0); };
  const Precise turning_zero = u_alpha - u2;
  wz_ = make((1 + u1) / 2, range / 2, (w3 - a + ratio(b + a, 1 + u2)) / 2, b + a,
             elliptic_f(root(1 + u1), root(range), m), phase_, wz, -0.5 * xy * std::conj(omega));
  xy_ = make((1 - u2) / 2, range / 2, (a - w3 + ratio(b - a, 1 - u1)) / 2, b - a,
             elliptic_f(root(1 - u2), root(m * (u3 - 1)), m), to_highest, xy, 0.5 * wz * omega);
  turning_ = make(beta * turning_zero, beta * range, a / 2 - w3 - ratio(b - a * u_alpha, u_alpha - u1) / 2,
                  a * u_alpha - b, elliptic_f(root(turning_zero), root(m * (u3 - u_alpha)), m), to_highest, omega,
                  Complex(0, -static_cast<double>(beta) / 2) * vertical);
}

LagrangeTop::Motion LagrangeTop::at(double t) const {
  const double advance = phase_rate_ * t;
  const auto [sn, cn, dn] = jacobi_(phase_ + advance);
  const auto value = [&](const Amplitude& f, double s) {
    const auto [turn, re, im] = f.theta(f.phase + advance);
    const double angle = f.rate * t + f.sense * turn, length = std::sqrt(f.least + f.gain * s * s);
    return std::polar(length, angle) * Complex(re, f.sense * im) * Complex(f.start_re, f.start_im);
  };
  const Complex wz = value(wz_, sn), xy = value(xy_, cn), turning = value(turning_, cn);
  const Quaternion<double> q(wz.real(), xy.real(), xy.imag(), wz.imag());
  const Vector3<double> omega(turning.real(), turning.imag(), spin_);
  return {polhode::product(up_to_world_, polhode::product(q, body_to_axis_)), axis_to_body_ * omega};
}

}  // namespace polhode::core::exact
