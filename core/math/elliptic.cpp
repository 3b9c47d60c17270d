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

template <class S>
JacobiEllipticOf<S>::JacobiEllipticOf(double m_c) requires std::same_as<S, double> {
  if (m_c == 0) return;
  double a = 1, b = std::sqrt(m_c);
  while (true) {
    const auto level = static_cast<std::size_t>(most_levels_);
    arithmetic_[level] = a;
    geometric_[level] = b;
    ++most_levels_;
    mean_ = (a + b) / 2;
    // The change by one more level is of the order of the square of this difference.
    if (std::abs(a - b) <= 1e-9 * a || most_levels_ == max_levels) break;
    b = std::sqrt(a * b);
    a = mean_;
  }
  levels_ = most_levels_;
  quarter_period_ = pi / 2 / mean_;
}

template <class S>
void JacobiEllipticOf<S>::set(int lane, const JacobiEllipticOf<double>& one) requires is_lanes<S> {
  levels_.set(lane, one.levels_);
  mean_.set(lane, one.mean_);
  quarter_period_.set(lane, one.quarter_period_);
  for (std::size_t n = 0; n < max_levels; ++n) {
    arithmetic_[n].set(lane, one.arithmetic_[n]);
    geometric_[n].set(lane, one.geometric_[n]);
  }
  most_levels_ = 0;
  for (int i = 0; i < lane_count; ++i) most_levels_ = std::max(most_levels_, int(levels_[i]));
}

template <class S>
typename JacobiEllipticOf<S>::Values JacobiEllipticOf<S>::operator()(S u) const {
  using std::abs, std::copysign, std::nearbyint, std::sqrt;
  if constexpr (!is_lanes<S>) {
    if (most_levels_ == 0) {
      const double e = std::exp(-std::abs(u));
      const double sech = 2 * e / (1 + e * e);
      return {std::tanh(u), sech, sech};
    }
  }
  // Reduce u to [−K, K] by whole periods 4K, then by a half period with a change of sign.
  u -= 4 * quarter_period_ * nearbyint(u / (4 * quarter_period_));
  const auto beyond = abs(u) > quarter_period_;
  u = select(beyond, u - copysign(2 * quarter_period_, u), u);
  const S sign = select(beyond, S(-1), S(1));
  // Recurrence for c from cot(mean u) to cn/sn (Bulirsch).
  const auto [sine, cosine] = sine_and_cosine(S(mean_ * u));
  S a = cosine / sine, c = mean_ * a, dn = 1;
  for (int n = most_levels_ - 1; n >= 0; --n) {
    const auto level = static_cast<std::size_t>(n);
    const S product = a * c, next = c * dn;
    const S ratio = (geometric_[level] + product) / (arithmetic_[level] + product);
    const auto has = S(n) < levels_;  // in lanes: the function of the lane has this level
    a = select(has, next / arithmetic_[level], a);
    c = select(has, next, c);
    dn = select(has, ratio, dn);
  }
  const S sn = copysign(sign / sqrt(c * c + 1), sign * sine);
  const auto tiny = abs(u) < S(1e-8);
  return {select(tiny, sign * u, sn), select(tiny, sign, c * sn), select(tiny, S(1), dn)};
}

template JacobiEllipticOf<double>::JacobiEllipticOf(double);
template void JacobiEllipticOf<Lanes>::set(int, const JacobiEllipticOf<double>&);
template JacobiEllipticOf<double>::Values JacobiEllipticOf<double>::operator()(double) const;
template JacobiEllipticOf<Lanes>::Values JacobiEllipticOf<Lanes>::operator()(Lanes) const;

template <class S>
ThetaDirectionOf<S>::ThetaDirectionOf(double m, double m_c, double beta) requires std::same_as<S, double> {
  const double k = elliptic_k(m_c), k_prime = elliptic_k(m);
  half_period_ = k;
  transformed_ = !(k < 2 * k_prime);
  double re = 0, im = 0;  // real part of θ and imaginary part of its derivative at u = 0
  if (!transformed_) {
    // Series: 1 + 2 Σ (−1)^n q^(n²) cos(2nπ(u + iβ)/2K)
    re_[0] = re = 1;
    if (m == 0) return;
    constant_ = false;
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
    constant_ = false;
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

template <class S>
void ThetaDirectionOf<S>::set(int lane, const ThetaDirectionOf<double>& one) requires is_lanes<S> {
  half_period_.set(lane, one.half_period_);
  frequency_.set(lane, one.frequency_);
  turn_.set(lane, one.turn_);
  slope_at_zero_.set(lane, one.slope_at_zero_);
  for (std::size_t n = 0; n <= terms; ++n) {
    re_[n].set(lane, one.re_[n]);
    im_[n].set(lane, one.im_[n]);
    nome_power_[n].set(lane, one.nome_power_[n]);
  }
  transformed_ = one.transformed_;
  constant_ = true;
  for (int i = 0; i < lane_count; ++i) constant_ = constant_ && frequency_[i] == 0;
}

template <class S>
typename ThetaDirectionOf<S>::Values ThetaDirectionOf<S>::operator()(S u) const {
  using std::abs, std::copysign, std::exp, std::nearbyint;
  if (constant_) return {0, 1, 0};
  if (!transformed_) {  // in a lane where m = 0 all terms but the first are 0
    const auto [s1, c1] = sine_and_cosine(S(frequency_ * u));
    S c = c1, s = s1, re = re_[0], im = 0;
    for (std::size_t n = 1; n <= terms; ++n) {
      re += re_[n] * c;
      im += im_[n] * s;
      const S next = c * c1 - s * s1;
      s = s * c1 + c * s1;
      c = next;
    }
    return {0, re, im};
  }
  const S reduced = u - 2 * half_period_ * nearbyint(u / (2 * half_period_));
  u = select(half_period_ < S(infinity), reduced, u);
  // Each term is divided by exp(y) p^n / 2: cosh and sinh((2n+1)y) p^(n(n+1)) become p^(n²) (g^n ± p^n d^(n+1)).
  const S d = exp(-frequency_ * abs(u)), g = exp(frequency_ * (abs(u) - half_period_));
  S g_n = 1, d_n = d, re = 0, im = 0;
  for (std::size_t n = 0; n <= terms; ++n) {
    const S decayed = nome_power_[n] * d_n;
    re += re_[n] * (g_n + decayed);
    im += im_[n] * (g_n - decayed);
    g_n *= g;
    d_n *= d;
  }
  return {turn_ * u, re, copysign(S(1), u) * im};
}

template ThetaDirectionOf<double>::ThetaDirectionOf(double, double, double);
template void ThetaDirectionOf<Lanes>::set(int, const ThetaDirectionOf<double>&);
template ThetaDirectionOf<double>::Values ThetaDirectionOf<double>::operator()(double) const;
template ThetaDirectionOf<Lanes>::Values ThetaDirectionOf<Lanes>::operator()(Lanes) const;

}  // namespace polhode::core::math
