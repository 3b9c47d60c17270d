// SPDX-License-Identifier: BSD-3-Clause
// The cost of a step of the conserving family: n steps of the asymmetric body of Hairer & Vilmart 2006 with h = 0.05
// through `advance`. The line: a step of dmv6 at most 1.7 times one of dmv (the paper: about 1.5).
#include <benchmark/benchmark.h>

#include "integrators/catalogue.hpp"

namespace {

using namespace polhode;

constexpr std::int64_t steps = 1000;
constexpr double h = 0.05;

void free_body(benchmark::State& run, const std::string& method, const Formulation& formulation) {
  Problem problem;
  Body body;
  body.inertia = Vector3<double>(0.6, 0.8, 1.0).asDiagonal();
  BodyStart start;
  start.angular_velocity = {3, 0.5, -0.9};
  problem.bodies = {body};
  problem.starts = {start};
  const auto system = make_system<double>(problem, formulation);
  const auto integrator = find_integrator(method)->make(*system, {});
  State<double> state = system->start();
  integrator->begin(state);
  for (auto _ : run) {
    if (!integrator->advance(state, h, steps).ok()) run.SkipWithError("a step failed");
    benchmark::DoNotOptimize(state.y.data());
  }
  run.SetItemsProcessed(run.iterations() * steps);
}

}  // namespace

int main(int argc, char** argv) {
  for (const IntegratorEntry& entry : integrator_catalogue()) {
    const std::string& name = entry.declaration.name;
    if (entry.declaration.family != "conserving") continue;
    for (const Orientation chart : {Orientation::quaternion, Orientation::matrix}) {
      const Formulation formulation{chart, AngularState::velocity_body};
      benchmark::RegisterBenchmark((name + "/" + std::string(polhode::name(chart))).c_str(),
                                   [=](benchmark::State& run) { free_body(run, name, formulation); });
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
