// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/theta_zero.hpp"

#include <cmath>
#include <numbers>

#include "core/math/elliptic.hpp"

namespace polhode::inline core::inline exact {

using std::numbers::pi;

ThetaZeroDirection::ThetaZeroDirection(double m, double m_c, double beta) : constant_(false) {
  const double k = elliptic_k(m_c), k_prime = elliptic_k(m);
  half_period_ = k;
  transformed_ = !(k < k_prime);
  if (!transformed_) {
    // Series: Σ (−1)^n q^(n(n+1)) (sin νx cosh νy − i cos νx sinh νy), ν = 2n + 1, x = πu/2K, y = πβ/2K, over exp(y)/2
    frequency_ = pi / (2 * k);
    double re = 0, im = 0;  // real part and derivative of the imaginary part at u = K
    for (std::size_t n = 0; n < terms; ++n) {
      const double order = static_cast<double>(n), odd = 2 * order + 1, sign = n % 2 == 0 ? 1 : -1;
      const double decayed = std::exp(-2 * odd * frequency_ * beta);
      const double weight = std::exp(-2 * order * frequency_ * ((order + 1) * k_prime - beta));
      re_[n] = sign * weight * (1 + decayed);
      im_[n] = sign * weight * std::expm1(-2 * odd * frequency_ * beta);
      re += sign * re_[n];
      im -= sign * odd * frequency_ * im_[n];
    }
    slope_at_k_ = im / re;
  } else {
    // Series: exp(iπuβ/2KK') Σ (−1)^n p^(n(n+1)) (sinh νy cos νx − i cosh νy sin νx), x = πβ/2K', y = πu/2K'
    frequency_ = pi / (2 * k_prime);
    const double x = frequency_ * beta, p = std::exp(-2 * frequency_ * k);
    turn_ = std::isfinite(k) ? frequency_ * beta / k : 0;
    double re = 0, im = 0, re_rate = 0, im_rate = 0, power = 1;  // values and rates at u = K, divided by exp(y)/2
    for (std::size_t n = 0; n < terms; ++n) {
      const double order = static_cast<double>(n), odd = 2 * order + 1, sign = n % 2 == 0 ? 1 : -1;
      const double decay = n == 0 ? 1 : std::exp(-2 * frequency_ * k * order * order);
      re_[n] = sign * decay * std::cos(odd * x);
      im_[n] = -sign * decay * std::sin(odd * x);
      const double behind = power * p;  // exp(−2νy) = p^ν = p^(2n) p
      re += re_[n] * (1 - behind);
      im += im_[n] * (1 + behind);
      re_rate += odd * frequency_ * re_[n] * (1 + behind);
      im_rate += odd * frequency_ * im_[n] * (1 - behind);
      power *= p * p;
    }
    slope_at_k_ = turn_ + (im_rate * re - re_rate * im) / (re * re + im * im);
  }
}

ThetaZeroDirection::Values ThetaZeroDirection::operator()(double u) const {
  if (constant_) return {0, 1, 0};
  double re = 0, im = 0, turn = 0;
  if (!transformed_) {
    const double s1 = std::sin(frequency_ * u), c1 = std::cos(frequency_ * u);
    const double s2 = 2 * s1 * c1, c2 = (c1 - s1) * (c1 + s1);
    double s = s1, c = c1;
    for (std::size_t n = 0; n < terms; ++n) {
      re += re_[n] * s;
      im += im_[n] * c;
      const double next = s * c2 + c * s2;
      c = c * c2 - s * s2;
      s = next;
    }
  } else {
    double sign = 1;  // reduction of u to [−K, K]: each period 2K changes the sign
    if (std::isfinite(half_period_)) {
      const double periods = std::nearbyint(u / (2 * half_period_));
      if (std::remainder(periods, 2) != 0) sign = -1;
      u -= 2 * half_period_ * periods;
      turn = turn_ * u;
    }
    const double size = std::abs(u), step = std::exp(2 * frequency_ * (size - half_period_));
    const std::size_t count = std::isfinite(half_period_) ? terms : 1;
    double grown = 1;
    for (std::size_t n = 0; n < count; ++n) {
      const double odd = 2 * static_cast<double>(n) + 1, behind = std::expm1(-2 * odd * frequency_ * size);
      re -= re_[n] * grown * behind;
      im += im_[n] * grown * (2 + behind);
      grown *= step;
    }
    re = sign * std::copysign(1.0, u) * re;
    im = sign * im;
  }
  const double length = std::hypot(re, im);
  if (length == 0) return {0, 1, 0};
  return {turn, re / length, im / length};
}

}  // namespace polhode::core::exact
