// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/free_top.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace polhode::inline core::inline exact {

namespace {

// Double-double number: the unevaluated sum hi + lo, about 32 digits. Near the separatrix Δ_B is a small difference of
// large terms. In double the distance from the separatrix, and with it the period, would be lost to round-off.
// Source: Dekker, Numerische Mathematik 18 (1971) 224–242.
struct DoubleDouble {
  double hi = 0, lo = 0;

  DoubleDouble() = default;
  DoubleDouble(double x) : hi(x) {}
  DoubleDouble(double high, double low) : hi(high + low), lo(low - (hi - high)) {}  // requires |high| ≥ |low|
};

DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const double s = a.hi + b.hi, v = s - a.hi, error = (a.hi - (s - v)) + (b.hi - v);
  const double t = a.lo + b.lo, w = t - a.lo, low_error = (a.lo - (t - w)) + (b.lo - w);
  const DoubleDouble sum(s, error + t);
  return {sum.hi, sum.lo + low_error};
}
DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }
DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }
DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const double p = a.hi * b.hi;
  return {p, std::fma(a.hi, b.hi, -p) + (a.hi * b.lo + a.lo * b.hi)};
}
DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double quotient = a.hi / b.hi;
  const DoubleDouble rest = a - b * quotient;
  const double next = rest.hi / b.hi;
  return DoubleDouble(quotient, next) + (rest - b * next).hi / b.hi;
}
DoubleDouble sqrt(DoubleDouble a) {
  const double root = std::sqrt(a.hi);
  return {root, (a - DoubleDouble(root) * root).hi / (2 * root)};
}

using DoubleDouble3 = std::array<DoubleDouble, 3>;

Vector3<double> rounded(const DoubleDouble3& v) { return {v[0].hi, v[1].hi, v[2].hi}; }

struct ExtendedAxes {
  DoubleDouble3 moment;
  std::array<DoubleDouble3, 3> axis;  // axis[j] belongs to moment[j], body axes
  bool given = true;                  // true: the inertia matrix is diagonal
};

// Principal axes by the cyclic Jacobi method (Golub and Van Loan, Matrix Computations, section 8.5).
ExtendedAxes extended_axes(const Matrix3<double>& inertia) {
  std::array<DoubleDouble3, 3> a;
  ExtendedAxes found;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      a[i][j] = (DoubleDouble(inertia(row, column)) + inertia(column, row)) * 0.5;
      found.axis[i][j] = i == j ? 1.0 : 0.0;
    }
  }
  const double negligible = 1e-33 * inertia.trace();
  bool turned = true;
  for (int sweep = 0; sweep < 20 && turned; ++sweep) {  // quadratic convergence: five or six suffice
    turned = false;
    for (const auto [p, q, r] : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}) {
      if (std::abs(a[p][q].hi) <= negligible) continue;
      turned = true;
      found.given = false;
      const DoubleDouble cot = (a[q][q] - a[p][p]) / (a[p][q] * 2.0);  // cotangent of twice the angle
      const double sign = cot.hi < 0 ? -1 : 1;
      const DoubleDouble tangent = DoubleDouble(sign) / (cot * sign + sqrt(cot * cot + 1.0));
      const DoubleDouble cosine = DoubleDouble(1) / sqrt(tangent * tangent + 1.0), sine = tangent * cosine;
      const DoubleDouble half_tangent = sine / (cosine + 1.0);
      const auto turn = [&](DoubleDouble& x, DoubleDouble& y) {
        const DoubleDouble x_old = x;
        x = x - sine * (y + half_tangent * x);
        y = y + sine * (x_old - half_tangent * y);
      };
      a[p][p] = a[p][p] - tangent * a[p][q];
      a[q][q] = a[q][q] + tangent * a[p][q];
      a[p][q] = a[q][p] = 0.0;
      turn(a[r][p], a[r][q]);
      a[p][r] = a[r][p];
      a[q][r] = a[r][q];
      for (std::size_t k = 0; k < 3; ++k) turn(found.axis[p][k], found.axis[q][k]);
    }
  }
  for (std::size_t j = 0; j < 3; ++j) found.moment[j] = a[j][j];
  return found;
}

// The top at t = 0 in principal axes, with the moments in ascending order. Moments and angular velocity are scaled by
// powers of two to be near 1. The motion depends only on ratios of moments, and the angular velocity sets the time
// unit.
struct PrincipalTop {
  DoubleDouble3 moment, omega;
  std::array<Vector3<double>, 3> axis;  // principal axis of each moment, body axes
  DoubleDouble i21, i32, i31;           // differences of moments, all ≥ 0
  int time_scale;                       // 1 s = 2^time_scale time units

  PrincipalTop(const Matrix3<double>& inertia, const Vector3<double>& angular_velocity);

  // True if ω̇ = 0 in Euler's equations.
  bool steady() const {
    const auto zero = [&](DoubleDouble d, std::size_t j, std::size_t k) {
      return d.hi == 0 || omega[j].hi == 0 || omega[k].hi == 0;
    };
    return zero(i21, 0, 1) && zero(i32, 1, 2) && zero(i31, 0, 2);
  }
};

PrincipalTop::PrincipalTop(const Matrix3<double>& inertia, const Vector3<double>& angular_velocity)
    : time_scale(std::ilogb(std::max(angular_velocity.cwiseAbs().maxCoeff(), 1e-300))) {
  const int inertia_scale = std::ilogb(std::max(inertia.cwiseAbs().maxCoeff(), 1e-300));
  const auto scaled = [&](double x) { return std::scalbn(x, -inertia_scale); };
  const ExtendedAxes found = extended_axes(inertia.unaryExpr(scaled));
  const double negligible_omega = found.given ? 1e-120 : 1e-30, negligible_difference = found.given ? 0 : 1e-30;

  std::array<std::size_t, 3> order{0, 1, 2};
  // Equal moments keep their order. std::stable_sort would allocate memory.
  std::sort(order.begin(), order.end(), [&](std::size_t j, std::size_t k) {
    const double ahead = (found.moment[k] - found.moment[j]).hi;
    return ahead > 0 || (ahead == 0 && j < k);
  });
  for (std::size_t j = 0; j < 3; ++j) {
    moment[j] = found.moment[order[j]];
    axis[j] = rounded(found.axis[order[j]]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double component = angular_velocity[static_cast<Eigen::Index>(k)];
      omega[j] = omega[j] + found.axis[order[j]][k] * std::scalbn(component, -time_scale);
    }
    if (std::abs(omega[j].hi) < negligible_omega) omega[j] = 0.0;
  }
  const auto difference = [&](std::size_t j, std::size_t k) {
    const DoubleDouble d = moment[j] - moment[k];
    return d.hi <= negligible_difference * moment[2].hi ? DoubleDouble(0) : d;
  };
  i21 = difference(1, 0);
  i32 = difference(2, 1);
  i31 = i21 + i32;
}

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

}  // namespace

FreeTop::FreeTop(const Matrix3<double>& inertia_body, const Quaternion<double>& orientation,
                 const Vector3<double>& angular_velocity_body) {
  require(inertia_body.allFinite() && orientation.allFinite() && angular_velocity_body.allFinite(),
          "FreeTop: inertia, orientation and angular velocity must be finite");
  require((inertia_body - inertia_body.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * inertia_body.cwiseAbs().maxCoeff(),
          "FreeTop: the inertia matrix must be symmetric");
  const PrincipalTop top(inertia_body, angular_velocity_body);
  require(top.moment[0].hi > 0, "FreeTop: the inertia matrix must be positive definite");
  const auto& [i1, i2, i3] = top.moment;
  const auto& [w1, w2, w3] = top.omega;
  const double round_off = 4 * std::numeric_limits<double>::epsilon() * i3.hi;
  const bool sphere = top.i31.hi <= round_off, symmetric = top.i21.hi <= round_off || top.i32.hi <= round_off;

  steady_ = top.steady();
  if (steady_) {
    start_ = orientation;
    angular_velocity_ = angular_velocity_body;
    speed_ = angular_velocity_body.stableNorm();
    axis_ = speed_ > 0 ? Vector3<double>(angular_velocity_body.stableNormalized()) : Vector3<double>::Zero();
    regime_ = speed_ == 0 ? "at rest" : sphere ? "sphere" : "pure spin";
    return;
  }

  // |Δ1|, |Δ3| and Δ2 from differences of moments. Cancellation is possible only in towards3 − towards1.
  const double delta1 = (i2 * top.i21 * w2 * w2 + i3 * top.i31 * w3 * w3).hi;
  const double delta3 = (i1 * top.i31 * w1 * w1 + i2 * top.i32 * w2 * w2).hi;
  const DoubleDouble towards3 = i3 * top.i32 * w3 * w3, towards1 = i1 * top.i21 * w1 * w1;
  double delta2 = (towards3 - towards1).hi;
  if (std::abs(delta2) < 1e-30 * (towards3.hi + towards1.hi)) delta2 = 0;  // below the accuracy of double-double

  VaryingTop<double>& v = varying_;
  const bool about_smallest = delta2 <= 0;
  regime_ = sphere           ? "sphere"
            : symmetric      ? "symmetric"
            : delta2 == 0    ? "separatrix"
            : about_smallest ? "about the smallest axis"
                             : "about the largest axis";
  const std::size_t pole = about_smallest ? 0 : 2, other = 2 - pole;
  const double a = top.moment[pole].hi, b = i2.hi, c = top.moment[other].hi;
  const double ba = (about_smallest ? top.i21 : top.i32).hi, cb = (about_smallest ? top.i32 : top.i21).hi;
  const double ca = top.i31.hi;
  const double delta_a = about_smallest ? delta1 : delta3, delta_c = about_smallest ? delta3 : delta1;

  v.axes.col(0) = top.omega[pole].hi < 0 ? -top.axis[pole] : top.axis[pole];
  v.axes.col(1) = top.axis[1];
  v.axes.col(2) = v.axes.col(0).cross(v.axes.col(1));
  double omega_b = w2.hi, omega_c = v.axes.col(2).dot(top.axis[other]) < 0 ? -top.omega[other].hi : top.omega[other].hi;
  if (omega_c < 0) {  // rotate by π about A: on the separatrix y_C = Y_C sech u ≥ 0
    v.axes.rightCols<2>() *= -1;
    omega_b = -omega_b;
    omega_c = -omega_c;
  }

  const double y_a = std::sqrt(a * delta_c / ca), y_b = std::sqrt(b * delta_a / ba), y_c = std::sqrt(c * delta_a / ca);
  const double momentum = std::hypot(y_a, y_c);
  const double twice_energy =
      a * (top.omega[pole] * top.omega[pole]).hi + b * omega_b * omega_b + c * omega_c * omega_c;
  const double m_c = std::min(1.0, std::abs(delta2) * ca / (delta_c * ba));
  const double m = std::min(1.0, delta_a * cb / (delta_c * ba));
  const double lambda = std::copysign(std::sqrt(delta_c * ba / (a * b * c)), about_smallest ? 1 : -1);
  v.jacobi = JacobiElliptic(m_c);
  v.theta = ThetaDirection(m, m_c, m == 0 ? 0 : elliptic_f(std::sqrt(c * ba), std::sqrt(a * cb), m));
  // ψ̇ at u = 0 minus the contribution of θ
  const double precession =
      (twice_energy + momentum * y_a / a) / (momentum + y_a) - 2 * lambda * v.theta.slope_at_zero();

  v.momentum_amplitude = Vector3<double>(y_a, y_b, y_c) / momentum;
  for (const Eigen::Index j : {0, 1, 2}) {
    v.rate_per_momentum[j] = std::scalbn(momentum / (j == 0 ? a : j == 1 ? b : c), top.time_scale);
  }
  v.phase = elliptic_f(omega_b * std::sqrt(b * ba), omega_c * std::sqrt(c * ca), m_c);
  v.phase_rate = std::scalbn(lambda, top.time_scale);
  v.precession_rate = std::scalbn(precession, top.time_scale);
  v.body_to_frame = quaternion_from_rotation_matrix(Matrix3<double>(v.axes.transpose()));
  v.left = product(orientation,
                   conjugate(product(v.attitude_in_frame(0, v.phase, v.momentum_direction(v.phase)), v.body_to_frame)));
}

FreeTop::Motion FreeTop::at(double t) const {
  if (!steady_) return varying_.at(t);
  const double half = speed_ * t / 2, s = std::sin(half);
  const Quaternion<double> spin(std::cos(half), s * axis_[0], s * axis_[1], s * axis_[2]);
  return {product(start_, spin), angular_velocity_};
}

}  // namespace polhode::core::exact
