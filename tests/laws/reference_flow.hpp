// SPDX-License-Identifier: BSD-3-Clause
// The motion of a system to about 1e-17, by a method that shares nothing with those under test: Gragg's extrapolated
// midpoint rule of order 12 in long double (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, II.9).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/system/system.hpp"

namespace polhode::laws {

/// y at t1 from y at t0.
inline VectorX<long double> reference_flow(const System<long double>& system, VectorX<long double> y, long double t0,
                                           long double t1, int steps_per_second = 64) {
  using Real = long double;
  using Flat = VectorX<Real>;
  constexpr int columns = 6;
  const int steps = std::max(1, int(std::ceil(std::abs(t1 - t0) * Real(steps_per_second))));
  const Real big = (t1 - t0) / Real(steps);
  Flat dy(y.size());
  const auto rate = [&](Real t, const Flat& at) -> const Flat& {
    system.rate(t, at.data(), dy.data());
    return dy;
  };
  for (int s = 0; s < steps; ++s) {
    const Real t = t0 + big * Real(s);
    std::array<Flat, columns> row;  // T_{j,1} … T_{j,j} of the last j
    for (int j = 0; j < columns; ++j) {
      const int n = 2 * (j + 1);
      const Real h = big / Real(n);
      // All in increments over y, so that the extrapolation magnifies their round-off and not that of y.
      Flat before = Flat::Zero(y.size()), now = h * rate(t, y);
      for (int i = 1; i < n; ++i) {
        Flat next = before + 2 * h * rate(t + h * Real(i), y + now);
        before.swap(now);
        now.swap(next);
      }
      Flat value = now;  // Aitken and Neville, with n_j² as abscissae
      for (int k = 0; k < j; ++k) {
        const Real ratio = Real(j + 1) / Real(j - k);
        const Flat better = value + (value - row[std::size_t(k)]) / (ratio * ratio - 1);
        row[std::size_t(k)] = value;
        value = better;
      }
      row[std::size_t(j)] = value;
    }
    y += row[columns - 1];
  }
  return y;
}

}  // namespace polhode::laws
