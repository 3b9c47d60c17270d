// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of the flat ODE ẏ = f(t, y) by central difference quotients. The relative error is about eps^(2/3).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::inline integrators {

/// Increment of a central difference quotient at x: eps^(1/3) max(|x|, 1), rounded so that x + increment is exact.
inline double quotient_step(double x) {
  const double step = std::cbrt(std::numeric_limits<double>::epsilon()) * std::max(std::abs(x), 1.0);
  const volatile double ahead = x + step;
  return ahead - x;
}

/// Calls put(i, j, ∂f_i/∂y_j) for all i and j. rate(t, y, dy) evaluates f. y is modified and restored; plus and minus
/// are scratch vectors.
template <class Rate, class Vector, class Put>
void jacobian_by_quotients(const Rate& rate, double t, Vector& y, Vector& plus, Vector& minus, const Put& put) {
  const auto n = y.size();
  for (decltype(y.size()) j = 0; j < n; ++j) {
    const double at = y[j], step = quotient_step(at);
    y[j] = at + step;
    rate(t, y, plus);
    y[j] = at - step;
    rate(t, y, minus);
    y[j] = at;
    for (decltype(y.size()) i = 0; i < n; ++i) put(i, j, (plus[i] - minus[i]) / (2 * step));
  }
}

/// Writes ∂f/∂t to dt. plus and minus are scratch vectors.
template <class Rate, class Vector, class Out>
void time_derivative_by_quotients(const Rate& rate, double t, const Vector& y, Vector& plus, Vector& minus, Out& dt) {
  const double step = quotient_step(t);
  rate(t + step, y, plus);
  rate(t - step, y, minus);
  for (decltype(y.size()) i = 0; i < y.size(); ++i) dt[i] = (plus[i] - minus[i]) / (2 * step);
}

}  // namespace polhode::integrators
