// SPDX-License-Identifier: BSD-3-Clause
// The cost of generality: n RK4 steps of one free body through `advance`, beside the same arithmetic written out by
// hand for that body alone. Both consume the whole state. The line: at most 1.25 times the hand-written loop.
#include <benchmark/benchmark.h>

#include <cmath>

#include "integrators/catalogue.hpp"

namespace {

using namespace polhode;

constexpr std::int64_t steps = 1000;
constexpr double h = 1e-3;

Problem free_box() {
  Problem problem;
  Body body;
  body.mass = 10;
  body.inertia = Vector3<double>(0.8, 0.7, 0.2).asDiagonal();
  BodyStart start;
  start.velocity = {-2, 2, 8};
  start.angular_velocity = {0.1, 5, 0.1};
  problem.bodies = {body};
  problem.starts = {start};
  return problem;
}

// ---- the hand-written loop: plain arrays, one formulation each -----------------------------------------------------

struct Flat {
  double y[14];  // p, q (w x y z), v, angular, work
};

struct Constants {
  double i1, i2, i3, j1, j2, j3;  // moments and their inverses
};

inline void kinematics(const Flat& s, double wx, double wy, double wz, bool world, Flat& d) {
  const auto& y = s.y;
  auto& r = d.y;
  for (int i = 0; i < 3; ++i) {
    r[i] = y[7 + i];
    r[7 + i] = 0;
  }
  const double a = 0.5 * wx, b = 0.5 * wy, c = 0.5 * wz;
  r[3] = -a * y[4] - b * y[5] - c * y[6];
  if (world) {
    r[4] = a * y[3] + b * y[6] - c * y[5];
    r[5] = b * y[3] + c * y[4] - a * y[6];
    r[6] = c * y[3] + a * y[5] - b * y[4];
  } else {
    r[4] = a * y[3] + c * y[5] - b * y[6];
    r[5] = b * y[3] + a * y[6] - c * y[4];
    r[6] = c * y[3] + b * y[4] - a * y[5];
  }
  r[13] = 0;
}

inline void rate_body(const Constants& k, const Flat& s, Flat& d) {
  const double wx = s.y[10], wy = s.y[11], wz = s.y[12];
  kinematics(s, wx, wy, wz, false, d);
  const double lx = k.i1 * wx, ly = k.i2 * wy, lz = k.i3 * wz;
  d.y[10] = -k.j1 * (wy * lz - wz * ly);
  d.y[11] = -k.j2 * (wz * lx - wx * lz);
  d.y[12] = -k.j3 * (wx * ly - wy * lx);
}

inline void rate_world(const Constants& k, const Flat& st, Flat& d) {
  const double ax = st.y[10], ay = st.y[11], az = st.y[12];
  kinematics(st, ax, ay, az, true, d);
  const double w = st.y[3], x = st.y[4], y = st.y[5], z = st.y[6];
  const double ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  const double s = 1 / ((ww + xx) + (yy + zz)), s2 = s + s;
  const double r00 = ((ww + xx) - (yy + zz)) * s, r01 = (x * y - w * z) * s2, r02 = (x * z + w * y) * s2;
  const double r10 = (x * y + w * z) * s2, r11 = ((ww + yy) - (xx + zz)) * s, r12 = (y * z - w * x) * s2;
  const double r20 = (x * z - w * y) * s2, r21 = (y * z + w * x) * s2, r22 = ((ww + zz) - (xx + yy)) * s;
  const double b0 = r00 * ax + r10 * ay + r20 * az;
  const double b1 = r01 * ax + r11 * ay + r21 * az;
  const double b2 = r02 * ax + r12 * ay + r22 * az;
  const double l0 = k.i1 * b0, l1 = k.i2 * b1, l2 = k.i3 * b2;
  const double c0 = -k.j1 * (b1 * l2 - b2 * l1), c1 = -k.j2 * (b2 * l0 - b0 * l2), c2 = -k.j3 * (b0 * l1 - b1 * l0);
  d.y[10] = r00 * c0 + r01 * c1 + r02 * c2;
  d.y[11] = r10 * c0 + r11 * c1 + r12 * c2;
  d.y[12] = r20 * c0 + r21 * c1 + r22 * c2;
}

template <auto rate>
void hand_rk4(const Constants& k, Flat& s) {
  Flat k1, k2, k3, k4, stage;
  for (std::int64_t n = 0; n < steps; ++n) {
    rate(k, s, k1);
    for (int i = 0; i < 14; ++i) stage.y[i] = s.y[i] + 0.5 * h * k1.y[i];
    rate(k, stage, k2);
    for (int i = 0; i < 14; ++i) stage.y[i] = s.y[i] + 0.5 * h * k2.y[i];
    rate(k, stage, k3);
    for (int i = 0; i < 14; ++i) stage.y[i] = s.y[i] + h * k3.y[i];
    rate(k, stage, k4);
    for (int i = 0; i < 14; ++i) s.y[i] += h / 6 * (k1.y[i] + 2 * (k2.y[i] + k3.y[i]) + k4.y[i]);
  }
}

template <auto rate>
void by_hand(benchmark::State& bench) {
  const Problem problem = free_box();
  const Vector3<double> m = problem.bodies[0].inertia.diagonal();
  const Constants k{m[0], m[1], m[2], 1 / m[0], 1 / m[1], 1 / m[2]};
  const auto system = make_system<double>(problem, {});
  const State<double> start = system->start();
  Flat s;
  for (int i = 0; i < 14; ++i) s.y[i] = start.y[i];
  for (auto _ : bench) {
    hand_rk4<rate>(k, s);
    benchmark::DoNotOptimize(s);
    benchmark::ClobberMemory();
  }
  bench.SetItemsProcessed(bench.iterations() * steps);
}

void polhode_advance(benchmark::State& bench, Orientation orientation, AngularState angular) {
  const Problem problem = free_box();
  const auto system = make_system<double>(problem, {.orientation = orientation, .angular_state = angular});
  const auto rk4 = find_integrator("rk4")->make(*system, {});
  State<double> state = system->start();
  rk4->begin(state);
  for (auto _ : bench) {
    rk4->advance(state, h, steps);
    benchmark::DoNotOptimize(state.y.data());
    benchmark::ClobberMemory();
  }
  bench.SetItemsProcessed(bench.iterations() * steps);
}

BENCHMARK(by_hand<rate_body>)->Name("velocity_body/quaternion/hand");
BENCHMARK_CAPTURE(polhode_advance, vb, Orientation::quaternion, AngularState::velocity_body)
    ->Name("velocity_body/quaternion/polhode");
BENCHMARK(by_hand<rate_world>)->Name("velocity_world/quaternion/hand");
BENCHMARK_CAPTURE(polhode_advance, vw, Orientation::quaternion, AngularState::velocity_world)
    ->Name("velocity_world/quaternion/polhode");
BENCHMARK_CAPTURE(polhode_advance, mw, Orientation::quaternion, AngularState::momentum_world)
    ->Name("momentum_world/quaternion/polhode");
BENCHMARK_CAPTURE(polhode_advance, vbm, Orientation::matrix, AngularState::velocity_body)
    ->Name("velocity_body/matrix/polhode");
BENCHMARK_CAPTURE(polhode_advance, vwm, Orientation::matrix, AngularState::velocity_world)
    ->Name("velocity_world/matrix/polhode");

}  // namespace

BENCHMARK_MAIN();
