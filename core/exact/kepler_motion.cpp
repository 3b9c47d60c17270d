// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/kepler_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>

namespace polhode::inline core::inline exact {
namespace {

using Precise = boost::multiprecision::cpp_bin_float_100;
using Precise3 = std::array<Precise, 3>;

Precise dot(const Precise3& a, const Precise3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Precise3 cross(const Precise3& a, const Precise3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Precise3 scaled(const Precise3& a, const Precise& s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Vector3<long double> rounded(const Precise3& a) {
  return {static_cast<long double>(a[0]), static_cast<long double>(a[1]), static_cast<long double>(a[2])};
}

/// Values of the universal functions U0 to U3.
template <class T>
struct UniversalFunctions {
  T u0, u1, u2, u3;
};

/// The universal functions U0 to U3 of s. For |βs²| < 1 they are computed by their power series.
template <class T>
UniversalFunctions<T> universal(const T& beta, const T& s) {
  using std::abs, std::cos, std::cosh, std::sin, std::sinh, std::sqrt;
  const T x = beta * s * s;
  if (abs(x) < 1) {
    T term2 = T(1) / 2, term3 = T(1) / 6, c2 = term2, c3 = term3;
    for (int k = 1; k < 40; ++k) {
      term2 *= -x / ((2 * k + 1) * (2 * k + 2));
      term3 *= -x / ((2 * k + 2) * (2 * k + 3));
      const T c3_before = c3;
      c2 += term2;
      c3 += term3;
      if (c3 == c3_before) break;
    }
    return {1 - x * c2, s * (1 - x * c3), s * s * c2, s * s * s * c3};
  }
  const T root = sqrt(abs(beta)), angle = root * s;
  const T half = beta > 0 ? T(sin(angle / 2)) : T(sinh(angle / 2));
  const T u0 = beta > 0 ? T(cos(angle)) : T(cosh(angle)), u1 = (beta > 0 ? T(sin(angle)) : T(sinh(angle))) / root;
  return {u0, u1, 2 * half * half / abs(beta), (s - u1) / beta};
}

}  // namespace

KeplerMotion::KeplerMotion(double mu, const Vector3<double>& position, const Vector3<double>& velocity) {
  if (!(mu > 0) || !position.allFinite() || !velocity.allFinite() || position.isZero(0)) {
    throw std::invalid_argument("KeplerMotion: mu must be positive and the bodies apart");
  }
  const Precise3 r{position[0], position[1], position[2]}, v{velocity[0], velocity[1], velocity[2]};
  const Precise distance = sqrt(dot(r, r)), beta = 2 * mu / distance - dot(v, v), eta = dot(r, v);
  const Precise3 l = cross(r, v), vl = cross(v, l);
  Precise3 e;
  for (std::size_t i = 0; i < 3; ++i) e[i] = vl[i] / mu - r[i] / distance;
  const Precise eccentricity = sqrt(dot(e, e)), l2 = dot(l, l), q = l2 / (mu * (1 + eccentricity));
  const bool circle = eccentricity < Precise("1e-60");

  Precise s = 0;  // s at t = 0, from U1 = η/μe and U2 = (r − q)/μe
  if (!circle) {
    const Precise u1 = eta / (mu * eccentricity), u2 = (distance - q) / (mu * eccentricity);
    if (abs(beta) * u1 * u1 < 1e-6 && abs(beta) * u2 < 1) {
      s = u1;
      for (int k = 0; k < 8; ++k) {
        const UniversalFunctions<Precise> u = universal(beta, s);
        s -= (u.u1 - u1) / u.u0;
      }
    } else if (beta > 0) {
      s = atan2(sqrt(beta) * u1, 1 - beta * u2) / sqrt(beta);
    } else {
      s = asinh(sqrt(-beta) * u1) / sqrt(-beta);
    }
  }
  const Precise since = q * universal(beta, s).u1 + mu * universal(beta, s).u3;

  const Precise3 towards = circle ? scaled(r, 1 / distance) : scaled(e, 1 / eccentricity);
  towards_pericentre_ = rounded(towards);
  across_ = l2 == 0 ? Vector3<Real>::Zero() : rounded(scaled(cross(l, towards), 1 / sqrt(l2)));
  mu_ = mu;
  beta_ = static_cast<Real>(beta);
  q_ = static_cast<Real>(q);
  eccentricity_ = static_cast<Real>(eccentricity);
  momentum_ = static_cast<Real>(sqrt(l2));
  since_pericentre_ = static_cast<Real>(since);
  if (beta > 0) period_ = static_cast<Real>(2 * acos(Precise(-1)) * mu / (beta * sqrt(beta)));
}

double KeplerMotion::period() const {
  return period_ > 0 ? static_cast<double>(period_) : std::numeric_limits<double>::infinity();
}

KeplerMotion::Real KeplerMotion::solve(Real since) const {
  const Real t = std::abs(since);
  if (t == 0) return 0;
  // Upper bound of s. Ellipses: U3 ≥ 0.6 s³/6 up to half a revolution. Hyperbolas: N = (e sinh H − H) μ/√|β|³ ≥
  // (sinh H)/3 for H > 2.
  Real most = std::cbrt(10 * t / mu_);
  if (beta_ > 0) most = std::min(most, std::numbers::pi_v<Real> / std::sqrt(beta_) * (1 + Real(1e-15)));
  if (beta_ < 0) {
    const Real root = std::sqrt(-beta_);
    most = std::min(most, std::max(Real(2), std::asinh(3 * t * root * root * root / mu_)) / root);
  }
  const auto equation = [&](Real s) {
    const UniversalFunctions<Real> u = universal(beta_, s);
    return std::make_tuple(q_ * u.u1 + mu_ * u.u3 - t, q_ * u.u0 + mu_ * u.u2);
  };
  // Initial guess from the cubic equation of the parabola, t = q s + μ s³/6.
  const Real guess = std::min(most, q_ > 0 ? std::min(t / q_, std::cbrt(6 * t / mu_)) : std::cbrt(6 * t / mu_));
  std::uintmax_t iterations = 200;
  const Real s = boost::math::tools::newton_raphson_iterate(equation, guess, Real(0), most,
                                                            std::numeric_limits<Real>::digits - 2, iterations);
  return std::copysign(s, since);
}

KeplerMotion::Motion KeplerMotion::at(double t) const {
  Real since = since_pericentre_ + static_cast<Real>(t);
  if (period_ > 0) since -= period_ * std::nearbyint(since / period_);
  const UniversalFunctions<Real> u = universal(beta_, solve(since));
  const Real distance = q_ * u.u0 + mu_ * u.u2;
  const Vector3<Real> position = (q_ - mu_ * u.u2) * towards_pericentre_ + momentum_ * u.u1 * across_;
  const Vector3<Real> velocity = (-mu_ * u.u1 * towards_pericentre_ + momentum_ * u.u0 * across_) / distance;
  return {position.cast<double>(), velocity.cast<double>()};
}

}  // namespace polhode::core::exact
