// SPDX-License-Identifier: BSD-3-Clause
// The cost of joints: RK4 steps of a pendulum on a rod by index 1, beside the same equations written out by hand; and
// steps of a hanging chain of n bodies, whose time per step must grow linearly. Lines: at most 2 times the hand-written
// loop; exponent at most 1.1 from 10 to 1000 bodies. Every loop consumes the whole state.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/joints/catalogue.hpp"
#include "integrators/catalogue.hpp"

namespace {

using namespace polhode;

constexpr double h = 1e-3;

JointParameters joint(const std::string& kind, std::vector<std::size_t> bodies, const Vector3<double>& near,
                      const Vector3<double>& far) {
  JointParameters p{kind, {kind, bodies, {}}};
  for (const Parameter& key : find_joint(kind)->kind.parameters) p.of.values[key.key] = key.value;
  p.of.values["anchor_body"] = near;
  p.of.values[bodies.size() == 1 ? "anchor_world" : "anchor_body_2"] = far;
  return p;
}

void add_gravity(Problem& problem, const Vector3<double>& g) {
  ForceParameters gravity{"uniform_gravity", {}, {{"acceleration", g}}};
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) gravity.bodies.push_back(i);
  problem.forces.push_back(gravity);
}

// ---- a pendulum: one body on a ball joint, ω in world axes
// -----------------------------------------------------------

constexpr double moments[3] = {0.8, 0.7, 0.2}, mass = 1.5, gravity[3] = {0.5, 0, -9.81}, anchor[3] = {0.1, -0.2, 0.9};

Problem pendulum() {
  Problem problem;
  Body body;
  body.mass = mass;
  body.inertia = Vector3<double>(moments[0], moments[1], moments[2]).asDiagonal();
  BodyStart start;
  const Vector3<double> arm(anchor[0], anchor[1], anchor[2]);
  start.position = -arm;
  start.angular_velocity = {0.1, 0.5, 0.1};
  start.velocity = -start.angular_velocity.cross(arm);
  problem.bodies = {body};
  problem.starts = {start};
  add_gravity(problem, {gravity[0], gravity[1], gravity[2]});
  problem.joints = {joint("ball", {0}, arm, {0, 0, 0})};
  return problem;
}

struct Flat {
  double y[15];  // p, q (w x y z), v, ω, work of the joint, work
};

inline void cross(const double* a, const double* b, double* c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}
inline double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The index-1 equations, written for this body and this joint: R, R I⁻¹ Rᵀ, the three rows of G, G M⁻¹ Gᵀ by Cholesky,
/// the reaction, and the accelerations under it.
inline void rate(const Flat& state, Flat& d) {
  const double* y = state.y;
  double* out = d.y;
  const double *q = y + 3, *v = y + 7, *w = y + 10;
  const double s = 2 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double r[3][3] = {
      {1 - s * (q[2] * q[2] + q[3] * q[3]), s * (q[1] * q[2] - q[0] * q[3]), s * (q[1] * q[3] + q[0] * q[2])},
      {s * (q[1] * q[2] + q[0] * q[3]), 1 - s * (q[1] * q[1] + q[3] * q[3]), s * (q[2] * q[3] - q[0] * q[1])},
      {s * (q[1] * q[3] - q[0] * q[2]), s * (q[2] * q[3] + q[0] * q[1]), 1 - s * (q[1] * q[1] + q[2] * q[2])}};
  for (int i = 0; i < 3; ++i) out[i] = v[i];
  out[3] = -0.5 * (w[0] * q[1] + w[1] * q[2] + w[2] * q[3]);
  out[4] = 0.5 * (w[0] * q[0] + w[1] * q[3] - w[2] * q[2]);
  out[5] = 0.5 * (w[1] * q[0] + w[2] * q[1] - w[0] * q[3]);
  out[6] = 0.5 * (w[2] * q[0] + w[0] * q[2] - w[1] * q[1]);
  double inverse[3][3], arm[3], body[3], momentum[3], gyroscopic[3];
  for (int i = 0; i < 3; ++i) {
    arm[i] = dot(r[i], anchor);
    body[i] = (r[0][i] * w[0] + r[1][i] * w[1] + r[2][i] * w[2]) * moments[i];
    for (int j = 0; j < 3; ++j) {
      inverse[i][j] = 0;
      for (int k = 0; k < 3; ++k) inverse[i][j] += r[i][k] * r[j][k] / moments[k];
    }
  }
  for (int i = 0; i < 3; ++i) momentum[i] = dot(r[i], body);
  cross(momentum, w, gyroscopic);
  double turned[3], centripetal[3], free[3];
  cross(w, arm, turned);
  cross(w, turned, centripetal);
  for (int i = 0; i < 3; ++i) free[i] = dot(inverse[i], gyroscopic);
  double torque[3][3], spin[3][3], m[3][3], l[3];  // rows of G: (e, arm × e)
  for (int k = 0; k < 3; ++k) {
    const double e[3] = {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    cross(arm, e, torque[k]);
    for (int i = 0; i < 3; ++i) spin[k][i] = dot(inverse[i], torque[k]);
    l[k] = -centripetal[k] - gravity[k] - dot(torque[k], free);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) m[i][j] = dot(torque[i], spin[j]) + (i == j ? 1 / mass : 0);
  }
  m[0][0] = std::sqrt(m[0][0]);
  m[1][0] /= m[0][0];
  m[2][0] /= m[0][0];
  m[1][1] = std::sqrt(m[1][1] - m[1][0] * m[1][0]);
  m[2][1] = (m[2][1] - m[2][0] * m[1][0]) / m[1][1];
  m[2][2] = std::sqrt(m[2][2] - m[2][0] * m[2][0] - m[2][1] * m[2][1]);
  l[0] /= m[0][0];
  l[1] = (l[1] - m[1][0] * l[0]) / m[1][1];
  l[2] = (l[2] - m[2][0] * l[0] - m[2][1] * l[1]) / m[2][2];
  l[2] /= m[2][2];
  l[1] = (l[1] - m[2][1] * l[2]) / m[1][1];
  l[0] = (l[0] - m[1][0] * l[1] - m[2][0] * l[2]) / m[0][0];
  out[13] = 0;
  double whole[3] = {gyroscopic[0], gyroscopic[1], gyroscopic[2]};
  for (int k = 0; k < 3; ++k) {
    out[7 + k] = gravity[k] + l[k] / mass;
    for (int i = 0; i < 3; ++i) whole[i] += l[k] * torque[k][i];
    out[13] += l[k] * (v[k] + turned[k]);
  }
  for (int i = 0; i < 3; ++i) out[10 + i] = dot(inverse[i], whole);
  out[14] = 0;
}

void by_hand(benchmark::State& state) {
  const Problem problem = pendulum();
  const BodyStart& start = problem.starts[0];
  Flat y{{start.position[0], start.position[1], start.position[2], 1, 0, 0, 0, start.velocity[0], start.velocity[1],
          start.velocity[2], start.angular_velocity[0], start.angular_velocity[1], start.angular_velocity[2], 0, 0}};
  std::int64_t steps = 0;
  for (auto _ : state) {
    Flat k1, k2, k3, k4, middle;
    rate(y, k1);
    for (int i = 0; i < 15; ++i) middle.y[i] = y.y[i] + h / 2 * k1.y[i];
    rate(middle, k2);
    for (int i = 0; i < 15; ++i) middle.y[i] = y.y[i] + h / 2 * k2.y[i];
    rate(middle, k3);
    for (int i = 0; i < 15; ++i) middle.y[i] = y.y[i] + h * k3.y[i];
    rate(middle, k4);
    for (int i = 0; i < 15; ++i) y.y[i] += h / 6 * (k1.y[i] + 2 * (k2.y[i] + k3.y[i]) + k4.y[i]);
    benchmark::DoNotOptimize(y);
    if (++steps == 1000) state.counters["z_m"] = y.y[2];
  }
}
BENCHMARK(by_hand);

void index_1(benchmark::State& state) {
  const auto system = make_system<double>(pendulum(), {});
  const auto method = find_integrator("rk4")->make(*system, {.dt = h});
  State<double> y = system->start();
  method->begin(y);
  std::int64_t steps = 0;
  for (auto _ : state) {
    method->step(y, h);
    benchmark::DoNotOptimize(y.y.data());
    benchmark::ClobberMemory();
    if (++steps == 1000) state.counters["z_m"] = y.y[2];
  }
}
BENCHMARK(index_1);

// ---- a hanging chain
// -------------------------------------------------------------------------------------------------

Problem chain(std::size_t n) {
  Problem problem;
  for (std::size_t i = 0; i < n; ++i) {
    Body link;
    link.inertia = Vector3<double>(1.0 / 12, 1.0 / 12, 1.0 / 1200).asDiagonal();
    BodyStart start;
    start.position = {0, 0, -0.5 - static_cast<double>(i)};
    problem.bodies.push_back(link);
    problem.starts.push_back(start);
    const Vector3<double> up(0, 0, 0.5), down(0, 0, -0.5);
    problem.joints.push_back(i == 0 ? joint("ball", {0}, up, {0, 0, 0}) : joint("ball", {i, i - 1}, up, down));
  }
  problem.starts.back().angular_velocity = {0, 0, 1};
  add_gravity(problem, {0.5, 0, -9.81});
  return problem;
}

void chain_step(benchmark::State& state) {
  const auto system = make_system<double>(chain(static_cast<std::size_t>(state.range(0))), {});
  const auto method = find_integrator("rk4")->make(*system, {.dt = h});
  State<double> y = system->start();
  method->begin(y);
  for (auto _ : state) {
    method->step(y, h);
    benchmark::DoNotOptimize(y.y.data());
    benchmark::ClobberMemory();
  }
  state.SetComplexityN(state.range(0));
  state.counters["per_body_us"] =
      benchmark::Counter(static_cast<double>(state.range(0)) * 1e-6,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(chain_step)->Arg(1)->Arg(3)->Arg(10)->Arg(30)->Arg(100)->Arg(300)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
