// SPDX-License-Identifier: BSD-3-Clause
// The coursework study as a student would write it: one file, plain doubles, no generality. Body angular velocity, unit
// quaternion normalized after each step, a spring at the mass centre, energy after every step. It runs 4 methods × 10
// steps × 5 angular velocities over 50 s and prints the largest relative energy drift of each run. The yardstick of
// tests/benchmarks/coursework.sh, which times the same study through energy_drift.
#include <cmath>
#include <cstdio>

namespace {

struct State {
  double p[3], q[4], v[3], w[3];
};

constexpr double inertia[3] = {1, 2, 3}, inverse[3] = {1, 1.0 / 2, 1.0 / 3}, stiffness = 1, mass = 1;

inline State rate(const State& s) {
  State d;
  for (int i = 0; i < 3; ++i) {
    d.p[i] = s.v[i];
    d.v[i] = -stiffness * s.p[i] / mass;
  }
  const double a = 0.5 * s.w[0], b = 0.5 * s.w[1], c = 0.5 * s.w[2];
  d.q[0] = -a * s.q[1] - b * s.q[2] - c * s.q[3];
  d.q[1] = a * s.q[0] + c * s.q[2] - b * s.q[3];
  d.q[2] = b * s.q[0] + a * s.q[3] - c * s.q[1];
  d.q[3] = c * s.q[0] + b * s.q[1] - a * s.q[2];
  d.w[0] = inverse[0] * (inertia[1] - inertia[2]) * s.w[1] * s.w[2];
  d.w[1] = inverse[1] * (inertia[2] - inertia[0]) * s.w[2] * s.w[0];
  d.w[2] = inverse[2] * (inertia[0] - inertia[1]) * s.w[0] * s.w[1];
  return d;
}

inline State plus(const State& s, double h, const State& d) {
  State r;
  for (int i = 0; i < 3; ++i) {
    r.p[i] = s.p[i] + h * d.p[i];
    r.v[i] = s.v[i] + h * d.v[i];
    r.w[i] = s.w[i] + h * d.w[i];
  }
  for (int i = 0; i < 4; ++i) r.q[i] = s.q[i] + h * d.q[i];
  return r;
}

inline State explicit_euler(const State& s, double h) { return plus(s, h, rate(s)); }

inline State semi_implicit_euler(const State& s, double h) {
  State moved = s;
  const State a = rate(s);
  for (int i = 0; i < 3; ++i) {
    moved.v[i] = s.v[i] + h * a.v[i];
    moved.w[i] = s.w[i] + h * a.w[i];
  }
  const State k = rate(moved);
  State r = moved;
  for (int i = 0; i < 3; ++i) r.p[i] = s.p[i] + h * k.p[i];
  for (int i = 0; i < 4; ++i) r.q[i] = s.q[i] + h * k.q[i];
  return r;
}

inline State explicit_midpoint(const State& s, double h) { return plus(s, h, rate(plus(s, 0.5 * h, rate(s)))); }

inline State rk4(const State& s, double h) {
  const State k1 = rate(s), k2 = rate(plus(s, 0.5 * h, k1)), k3 = rate(plus(s, 0.5 * h, k2)), k4 = rate(plus(s, h, k3));
  State r = plus(s, h / 6, k1);
  r = plus(r, h / 3, k2);
  r = plus(r, h / 3, k3);
  return plus(r, h / 6, k4);
}

inline double energy(const State& s) {
  double e = 0;
  for (int i = 0; i < 3; ++i) {
    e += mass * s.v[i] * s.v[i] + stiffness * s.p[i] * s.p[i] + inertia[i] * s.w[i] * s.w[i];
  }
  return 0.5 * e;
}

template <auto step>
double worst_drift(double h, const double* w) {
  State s{{1, 0, 0}, {1, 0, 0, 0}, {0, 1, 0}, {w[0], w[1], w[2]}};
  const double e0 = energy(s);
  double worst = 0;
  const long n = std::lround(50 / h);
  for (long k = 0; k < n; ++k) {
    s = step(s, h);
    const double length = 1 / std::sqrt(s.q[0] * s.q[0] + s.q[1] * s.q[1] + s.q[2] * s.q[2] + s.q[3] * s.q[3]);
    for (double& x : s.q) x *= length;
    worst = std::fmax(worst, std::fabs(energy(s) - e0));
  }
  std::printf("%.17g,%.17g,", s.q[0], s.p[0]);
  return worst / e0;
}

}  // namespace

int main() {
  const double steps[] = {0.001, 0.0016, 0.0025, 0.004, 0.00625, 0.01, 0.016, 0.025, 0.04, 0.05};
  const double spins[][3] = {{0.01, 1, 0.01}, {1, 0.01, 0.01}, {0.01, 0.01, 1}, {0.5, 0.5, 0.5}, {0.3, 1, -0.5}};
  for (const double h : steps) {
    for (const double* w : spins) {
      std::printf("explicit_euler,%g,%.17g\n", h, worst_drift<explicit_euler>(h, w));
      std::printf("semi_implicit_euler,%g,%.17g\n", h, worst_drift<semi_implicit_euler>(h, w));
      std::printf("explicit_midpoint,%g,%.17g\n", h, worst_drift<explicit_midpoint>(h, w));
      std::printf("rk4,%g,%.17g\n", h, worst_drift<rk4>(h, w));
    }
  }
}
