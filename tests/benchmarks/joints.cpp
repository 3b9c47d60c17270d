// SPDX-License-Identifier: BSD-3-Clause
// What joints cost: RK4 steps of a pendulum on a rod by index 1, beside the same equations written out by hand; and
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

// ---- a pendulum on a rod
// ---------------------------------------------------------------------------------------------

Problem pendulum() {
  Problem problem;
  Body body;
  body.inertia = Vector3<double>(0.8, 0.7, 0.2).asDiagonal();
  BodyStart start;
  start.position = {-1, 0, 0};
  start.angular_velocity = {0.1, 0.5, 0.1};
  problem.bodies = {body};
  problem.starts = {start};
  add_gravity(problem, {0, -9.81, 0});
  problem.joints = {joint("distance", {0}, {0, 0, 0}, {0, 0, 0})};
  return problem;
}

struct Flat {
  double y[15];  // p, q (w x y z), v, Ω, work of the joint, work
};

constexpr double moments[3] = {0.8, 0.7, 0.2}, length = 1, mass = 1, gravity[3] = {0, -9.81, 0};

inline void rate(const Flat& s, Flat& d) {
  const auto& y = s.y;
  auto& r = d.y;
  for (int i = 0; i < 3; ++i) r[i] = y[7 + i];
  const double a = 0.5 * y[10], b = 0.5 * y[11], c = 0.5 * y[12];
  r[3] = -a * y[4] - b * y[5] - c * y[6];
  r[4] = a * y[3] + c * y[5] - b * y[6];
  r[5] = b * y[3] + a * y[6] - c * y[4];
  r[6] = c * y[3] + b * y[4] - a * y[5];
  const double lx = moments[0] * y[10], ly = moments[1] * y[11], lz = moments[2] * y[12];
  r[10] = -(y[11] * lz - y[12] * ly) / moments[0];
  r[11] = -(y[12] * lx - y[10] * lz) / moments[1];
  r[12] = -(y[10] * ly - y[11] * lx) / moments[2];
  // g = |p| − l: λ/m = −(v² − (n·v)²)/|p| − n·g
  const double l = std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
  const double n[3] = {y[0] / l, y[1] / l, y[2] / l};
  const double radial = n[0] * y[7] + n[1] * y[8] + n[2] * y[9];
  const double v2 = y[7] * y[7] + y[8] * y[8] + y[9] * y[9];
  const double gamma = -(v2 - radial * radial) / l;
  const double lambda = mass * (gamma - (n[0] * gravity[0] + n[1] * gravity[1] + n[2] * gravity[2]));
  for (int i = 0; i < 3; ++i) r[7 + i] = gravity[i] + lambda / mass * n[i];
  r[13] = lambda * radial;
  r[14] = 0;
}

void by_hand(benchmark::State& state) {
  Flat y{{-1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0.1, 0.5, 0.1, 0, 0}};
  for (auto _ : state) {
    Flat k1, k2, k3, k4, m;
    rate(y, k1);
    for (int i = 0; i < 15; ++i) m.y[i] = y.y[i] + h / 2 * k1.y[i];
    rate(m, k2);
    for (int i = 0; i < 15; ++i) m.y[i] = y.y[i] + h / 2 * k2.y[i];
    rate(m, k3);
    for (int i = 0; i < 15; ++i) m.y[i] = y.y[i] + h * k3.y[i];
    rate(m, k4);
    for (int i = 0; i < 15; ++i) y.y[i] += h / 6 * (k1.y[i] + 2 * (k2.y[i] + k3.y[i]) + k4.y[i]);
    benchmark::DoNotOptimize(y);
  }
  state.counters["x_m"] = y.y[0];
}
BENCHMARK(by_hand);

void index_1(benchmark::State& state) {
  const auto system = make_system<double>(pendulum(), {.angular_state = AngularState::velocity_body});
  const auto method = find_integrator("rk4")->make(*system, {.dt = h});
  State<double> y = system->start();
  method->begin(y);
  for (auto _ : state) {
    method->step(y, h);
    benchmark::DoNotOptimize(y.y.data());
    benchmark::ClobberMemory();
  }
  state.counters["x_m"] = y.y[0];
}
BENCHMARK(index_1);

/// The same system without the joint, for what the system of several bodies costs by itself.
void without_joint(benchmark::State& state) {
  Problem problem = pendulum();
  problem.joints.clear();
  Body still;
  still.fixed = true;
  problem.bodies.push_back(still);
  problem.starts.emplace_back();
  const auto system = make_system<double>(problem, {.angular_state = AngularState::velocity_body});
  const auto method = find_integrator("rk4")->make(*system, {.dt = h});
  State<double> y = system->start();
  method->begin(y);
  for (auto _ : state) {
    method->step(y, h);
    benchmark::DoNotOptimize(y.y.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(without_joint);

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
