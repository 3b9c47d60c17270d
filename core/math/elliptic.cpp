// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/elliptic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace polhode::inline core::inline math {

using std::numbers::pi;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Carlson's R_F(x, y, z) = ½ ∫ ds/√((s + x)(s + y)(s + z)) over [0, ∞), with at most one zero argument (DLMF 19.36.1).
double carlson_rf(double x, double y, double z) {
  const double mean0 = (x + y + z) / 3;
  // 90 ≈ ε^(−1/8) for the relative error ε; the first omitted term of the series has order 8
  const double spread = 90 * std::max({std::abs(mean0 - x), std::abs(mean0 - y), std::abs(mean0 - z)});
  double mean = mean0, shrink = 1, x_n = x, y_n = y;
  double z_n = z;
  while (shrink * spread > mean) {
    const double rx = std::sqrt(x_n), ry = std::sqrt(y_n), rz = std::sqrt(z_n);
    const double lambda = rx * ry + ry * rz + rz * rx;
    mean = (mean + lambda) / 4;
    x_n = (x_n + lambda) / 4;
    y_n = (y_n + lambda) / 4;
    z_n = (z_n + lambda) / 4;
    shrink /= 4;
  }
  const double dx = (mean0 - x) * shrink / mean, dy = (mean0 - y) * shrink / mean, dz = -dx - dy;
  const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
  return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44 - 5 * e2 * e2 * e2 / 208 + 3 * e3 * e3 / 104 +
          e2 * e2 * e3 / 16) /
         std::sqrt(mean);
}

}  // namespace

double elliptic_k(double m_c) { return m_c == 0 ? infinity : JacobiElliptic(m_c).quarter_period(); }

double elliptic_f(double sine, double cosine, double m_c) {
  const double length = std::hypot(sine, cosine);
  if (length == 0) return 0;
  const double s = std::abs(sine) / length, c = std::abs(cosine) / length;
  double f;
  if (m_c == 0) {
    f = c == 0 ? infinity : std::asinh(s / c);
  } else {
    f = s * carlson_rf(c * c, c * c + m_c * s * s, 1);
  }
  if (cosine < 0) f = m_c == 0 ? infinity : 2 * elliptic_k(m_c) - f;
  return std::copysign(f, sine);
}

double elliptic_f(double phi, double m_c) {
  const double half_turns = std::nearbyint(phi / pi);
  const double rest = phi - half_turns * pi;
  const double f = elliptic_f(std::sin(rest), std::cos(rest), m_c);
  return half_turns == 0 ? f : f + 2 * half_turns * elliptic_k(m_c);
}

JacobiElliptic::JacobiElliptic(double m_c) {
  if (m_c == 0) {
    quarter_period_ = infinity;
    return;
  }
  double a = 1, b = std::sqrt(m_c);
  while (true) {
    const auto level = static_cast<std::size_t>(levels_);
    arithmetic_[level] = a;
    geometric_[level] = b;
    ++levels_;
    mean_ = (a + b) / 2;
    // The change by one more level is of the order of the square of this difference.
    if (std::abs(a - b) <= 1e-9 * a || levels_ == max_levels) break;
    b = std::sqrt(a * b);
    a = mean_;
  }
  quarter_period_ = pi / 2 / mean_;
}

JacobiElliptic::Values JacobiElliptic::operator()(double u) const {
  if (levels_ == 0) {
    const double e = std::exp(-std::abs(u));
    const double sech = 2 * e / (1 + e * e);
    return {std::tanh(u), sech, sech};
  }
  // Reduce u to [−K, K] by whole periods 4K, then by a half period with a change of sign.
  u -= 4 * quarter_period_ * std::nearbyint(u / (4 * quarter_period_));
  double sign = 1;
  if (std::abs(u) > quarter_period_) {
    u -= std::copysign(2 * quarter_period_, u);
    sign = -1;
  }
  if (std::abs(u) < 1e-8) return {sign * u, sign, 1};
  // Recurrence for c from cot(mean u) to cn/sn (Bulirsch).
  const double phase = mean_ * u, sine = std::sin(phase);
  double a = std::cos(phase) / sine, c = mean_ * a, dn = 1;
  for (int n = levels_ - 1; n >= 0; --n) {
    const auto level = static_cast<std::size_t>(n);
    a *= c;
    c *= dn;
    dn = (geometric_[level] + a) / (arithmetic_[level] + a);
    a = c / arithmetic_[level];
  }
  const double sn = std::copysign(sign / std::sqrt(c * c + 1), sign * sine);
  return {sn, c * sn, dn};
}

ThetaDirection::ThetaDirection(double m, double m_c, double beta) {
  const double k = elliptic_k(m_c), k_prime = elliptic_k(m);
  half_period_ = k;
  transformed_ = !(k < 2 * k_prime);
  double re = 0, im = 0;  // real part of θ and imaginary part of its derivative at u = 0
  if (!transformed_) {
    // Series: 1 + 2 Σ (−1)^n q^(n²) cos(2nπ(u + iβ)/2K)
    re_[0] = re = 1;
    if (m == 0) return;
    frequency_ = pi / k;
    for (std::size_t n = 1; n <= terms; ++n) {
      const double order = static_cast<double>(n), sign = n % 2 == 0 ? 1 : -1;
      // q^(n²) exp(±2nπβ/2K). No overflow: 2n² K' ≥ n β.
      const double grown = std::exp(-pi * order / k * (2 * order * k_prime - beta));
      const double decayed = std::exp(-pi * order / k * (2 * order * k_prime + beta));
      re_[n] = sign * (grown + decayed);
      im_[n] = -sign * (grown - decayed);
      re += re_[n];
      im += order * frequency_ * im_[n];
    }
    slope_at_zero_ = im / re;
  } else {
    // Series: exp(−iπuβ/4KK') Σ p^(n(n+1)) cos((2n+1)(x − iy)), x = πβ/4K', y = πu/4K', p = exp(−πK/2K')
    frequency_ = pi / (2 * k_prime);
    turn_ = -pi * beta / (4 * k * k_prime);
    const double x = frequency_ * beta / 2, p = std::exp(-frequency_ * k);
    nome_power_[0] = 1;
    for (std::size_t n = 0; n <= terms; ++n) {
      const double order = static_cast<double>(n);
      if (n > 0) nome_power_[n] = nome_power_[n - 1] * p;
      const double odd = 2 * order + 1, weight = n == 0 ? 1 : std::exp(-frequency_ * k * order * order);
      const double weight_at_zero = weight * nome_power_[n];
      re_[n] = weight * std::cos(odd * x);
      im_[n] = weight * std::sin(odd * x);
      re += weight_at_zero * std::cos(odd * x);
      im += weight_at_zero * odd * std::sin(odd * x);
    }
    slope_at_zero_ = turn_ + frequency_ / 2 * im / re;
  }
}

ThetaDirection::Values ThetaDirection::operator()(double u) const {
  if (frequency_ == 0) return {0, 1, 0};
  if (!transformed_) {
    const double c1 = std::cos(frequency_ * u), s1 = std::sin(frequency_ * u);
    double c = c1, s = s1, re = re_[0], im = 0;
    for (std::size_t n = 1; n <= terms; ++n) {
      re += re_[n] * c;
      im += im_[n] * s;
      const double next = c * c1 - s * s1;
      s = s * c1 + c * s1;
      c = next;
    }
    return {0, re, im};
  }
  if (std::isfinite(half_period_)) u -= 2 * half_period_ * std::nearbyint(u / (2 * half_period_));
  // Each term is divided by exp(y) p^n / 2: cosh and sinh((2n+1)y) p^(n(n+1)) become p^(n²) (g^n ± p^n d^(n+1)).
  const double d = std::exp(-frequency_ * std::abs(u)), g = std::exp(frequency_ * (std::abs(u) - half_period_));
  double g_n = 1, d_n = d, re = 0, im = 0;
  for (std::size_t n = 0; n <= terms; ++n) {
    const double decayed = nome_power_[n] * d_n;
    re += re_[n] * (g_n + decayed);
    im += im_[n] * (g_n - decayed);
    g_n *= g;
    d_n *= d;
  }
  return {turn_ * u, re, std::copysign(1.0, u) * im};
}

}  // namespace polhode::core::math
