// SPDX-License-Identifier: BSD-3-Clause
// Many free bodies at once: n RK4 steps of 64 of them in the lanes of ensembles, beside the same arithmetic written out
// by hand for body angular velocity, once on plain doubles, body after body, and once on packs of doubles. All consume
// the whole state. The lines of the issue: the ensemble at least 4 (AVX-512) or 2.5 (AVX2) times as fast as the plain
// loop, and at most 1.25 times the loop on packs; and a step of one body costs the same whether there are 1 or 1000.
#include <benchmark/benchmark.h>

#include <vector>

#include "integrators/catalogue.hpp"

namespace {

using namespace polhode;

constexpr std::int64_t steps = 1000;
constexpr double h = 1e-3;
constexpr int bodies = 64;

using Pack [[gnu::vector_size(lane_count * sizeof(double))]] = double;

Problem body_number(int i) {
  Problem problem;
  Body body;
  body.mass = 10;
  body.inertia = Vector3<double>(0.8 + 0.001 * i, 0.7, 0.2).asDiagonal();
  BodyStart start;
  start.velocity = {-2, 2, 8};
  start.angular_velocity = {0.1, 5 - 0.01 * i, 0.1};
  problem.bodies = {body};
  problem.starts = {start};
  return problem;
}

constexpr Formulation formulation{.angular_state = AngularState::velocity_body};

template <class T>
struct ByHand {
  T y[14];  // p, q (w x y z), v, ω, work
  T i1, i2, i3, j1, j2, j3;

  static void rate(const ByHand& s, T* d) {
    const T* y = s.y;
    const T zero = y[0] * 0.0;
    for (int i = 0; i < 3; ++i) {
      d[i] = y[7 + i];
      d[7 + i] = zero;
    }
    const T a = 0.5 * y[10], b = 0.5 * y[11], c = 0.5 * y[12];
    d[3] = -a * y[4] - b * y[5] - c * y[6];
    d[4] = a * y[3] + c * y[5] - b * y[6];
    d[5] = b * y[3] + a * y[6] - c * y[4];
    d[6] = c * y[3] + b * y[4] - a * y[5];
    const T lx = s.i1 * y[10], ly = s.i2 * y[11], lz = s.i3 * y[12];
    d[10] = -s.j1 * (y[11] * lz - y[12] * ly);
    d[11] = -s.j2 * (y[12] * lx - y[10] * lz);
    d[12] = -s.j3 * (y[10] * ly - y[11] * lx);
    d[13] = zero;
  }

  void step() {
    T k1[14], k2[14], k3[14], k4[14];
    ByHand stage = *this;
    rate(*this, k1);
    for (int i = 0; i < 14; ++i) stage.y[i] = y[i] + 0.5 * h * k1[i];
    rate(stage, k2);
    for (int i = 0; i < 14; ++i) stage.y[i] = y[i] + 0.5 * h * k2[i];
    rate(stage, k3);
    for (int i = 0; i < 14; ++i) stage.y[i] = y[i] + h * k3[i];
    rate(stage, k4);
    for (int i = 0; i < 14; ++i) y[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
  }
};

/// Lane l of a pack, or the double itself.
double& lane(double& x, int) { return x; }
double& lane(Pack& x, int l) { return reinterpret_cast<double*>(&x)[l]; }

template <class T>
void by_hand(benchmark::State& bench) {
  constexpr int width = int(sizeof(T) / sizeof(double));
  std::vector<ByHand<T>> all(bodies / width);
  for (int i = 0; i < bodies; ++i) {
    const Problem problem = body_number(i);
    const State<double> start = make_system<double>(problem, formulation)->start();
    const Vector3<double> m = problem.bodies[0].inertia.diagonal();
    ByHand<T>& s = all[std::size_t(i / width)];
    const int l = i % width;
    for (int k = 0; k < 14; ++k) lane(s.y[k], l) = start.y[k];
    lane(s.i1, l) = m[0], lane(s.i2, l) = m[1], lane(s.i3, l) = m[2];
    lane(s.j1, l) = 1 / m[0], lane(s.j2, l) = 1 / m[1], lane(s.j3, l) = 1 / m[2];
  }
  for (auto _ : bench) {
    for (ByHand<T>& s : all) {
      ByHand<T> local = s;
      for (std::int64_t n = 0; n < steps; ++n) local.step();
      s = local;
    }
    benchmark::DoNotOptimize(all.data());
    benchmark::ClobberMemory();
  }
  bench.SetItemsProcessed(bench.iterations() * steps * bodies);
}

template <class S, AngularState angular_state>
void through_polhode(benchmark::State& bench) {
  constexpr int width = is_lanes<S> ? lane_count : 1;
  std::vector<std::unique_ptr<System<S>>> systems;
  std::vector<std::unique_ptr<Integrator<S>>> methods;
  std::vector<State<S>> states;
  const Formulation f{.angular_state = angular_state};
  for (int i = 0; i < bodies; i += width) {
    std::vector<Problem> problems;
    for (int k = 0; k < width; ++k) problems.push_back(body_number(i + k));
    if constexpr (is_lanes<S>) systems.push_back(make_ensemble(problems, f));
    else systems.push_back(make_system<S>(problems[0], f));
    methods.push_back(find_integrator("rk4")->maker<S>()(*systems.back(), {}));
    states.push_back(systems.back()->start());
    methods.back()->begin(states.back());
  }
  for (auto _ : bench) {
    for (std::size_t i = 0; i < systems.size(); ++i) {
      methods[i]->advance(states[i], h, steps);
      benchmark::DoNotOptimize(states[i].y.data());
    }
    benchmark::ClobberMemory();
  }
  bench.SetItemsProcessed(bench.iterations() * steps * bodies);
}

/// One system of many bodies.
void many(benchmark::State& bench) {
  Problem problem = body_number(0);
  for (int i = 1; i < bench.range(0); ++i) {
    const Problem next = body_number(i % 300);
    problem.bodies.push_back(next.bodies[0]);
    problem.starts.push_back(next.starts[0]);
  }
  const auto system = make_system<double>(problem, formulation);
  const auto rk4 = find_integrator("rk4")->make(*system, {});
  State<double> state = system->start();
  rk4->begin(state);
  for (auto _ : bench) {
    rk4->advance(state, h, 10);
    benchmark::DoNotOptimize(state.y.data());
    benchmark::ClobberMemory();
  }
  bench.SetItemsProcessed(bench.iterations() * 10 * bench.range(0));
}

BENCHMARK(by_hand<double>)->Name("velocity_body/hand");
BENCHMARK(by_hand<Pack>)->Name("velocity_body/hand_on_packs");
BENCHMARK((through_polhode<double, AngularState::velocity_body>))->Name("velocity_body/one_by_one");
BENCHMARK((through_polhode<Lanes, AngularState::velocity_body>))->Name("velocity_body/ensemble");
BENCHMARK((through_polhode<double, AngularState::velocity_world>))->Name("velocity_world/one_by_one");
BENCHMARK((through_polhode<Lanes, AngularState::velocity_world>))->Name("velocity_world/ensemble");
BENCHMARK(many)->Name("one_system_of")->Arg(1)->Arg(10)->Arg(1000);

}  // namespace

BENCHMARK_MAIN();
