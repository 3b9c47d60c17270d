// SPDX-License-Identifier: BSD-3-Clause
// Motions in the few coordinates that joints leave free, without the code under test: y' = f(y) in long double by the
// classical Runge-Kutta method, whose steps are short enough for 14 digits of the problems here.
#pragma once

#include <array>
#include <cstddef>

namespace polhode::study::joints_tests {

template <std::size_t N>
using Reduced = std::array<long double, N>;

/// y at the end of `steps` steps from 0 to t.
template <std::size_t N, class Rate>
Reduced<N> reduced_motion(const Rate& rate, Reduced<N> y, long double t, int steps) {
  const long double h = t / steps;
  const auto ahead = [&y](const Reduced<N>& slope, long double by) {
    Reduced<N> to = y;
    for (std::size_t i = 0; i < N; ++i) to[i] += by * slope[i];
    return to;
  };
  for (int step = 0; step < steps; ++step) {
    const Reduced<N> k1 = rate(y), k2 = rate(ahead(k1, h / 2)), k3 = rate(ahead(k2, h / 2)), k4 = rate(ahead(k3, h));
    for (std::size_t i = 0; i < N; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return y;
}

}  // namespace polhode::study::joints_tests
