// SPDX-License-Identifier: BSD-3-Clause
// The overhead of polhode on a library's method: the same stepper, settings and right-hand side called directly and
// through the port of integrators, on a free body in the quaternion chart with the body angular velocity as the state.
// An item is a second of motion; `evaluations` must agree.
#include <benchmark/benchmark.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "integrators/catalogue.hpp"

namespace {

using namespace polhode;
namespace odeint = boost::numeric::odeint;
using Vector = std::vector<double>;

constexpr double t_end = 10, h = 1e-3, tolerance = 1e-8;

Problem free_box() {
  Problem p;
  p.bodies.push_back({.name = "box", .mass = 10, .inertia = Vector3<double>(0.6, 0.8, 1.0).asDiagonal()});
  p.starts.push_back({.velocity = {0.3, -0.2, 0.1}, .angular_velocity = {3, 0.5, -0.9}});
  return p;
}
std::unique_ptr<System<double>> body() {
  return make_system<double>(free_box(), {.angular_state = AngularState::velocity_body});
}

void report(benchmark::State& bench, std::int64_t evaluations) {
  bench.SetItemsProcessed(std::int64_t(double(bench.iterations()) * t_end));
  bench.counters["evaluations"] = double(evaluations);
}

void polhode_fixed(benchmark::State& bench, const char* name) {
  const auto system = body();
  const auto integrator = find_integrator(name)->make(*system, {.dt = h});
  for (auto _ : bench) {
    State<double> state = system->start();
    integrator->begin(state);
    for (int k = 0; k < int(t_end / h); ++k) integrator->step(state, h);  // the steps of the driver
    benchmark::DoNotOptimize(state.y.data());
  }
  report(bench, integrator->evaluations());
}

void polhode_adaptive(benchmark::State& bench, const char* name) {
  const auto system = body();
  const auto integrator = find_integrator(name)->make(*system, {.tolerance = tolerance, .t_end = t_end});
  for (auto _ : bench) {
    State<double> state = system->start();
    integrator->begin(state);
    while (state.t < t_end) integrator->step(state, t_end - state.t);
    benchmark::DoNotOptimize(state.y.data());
  }
  report(bench, integrator->evaluations());
}

void direct_rk4(benchmark::State& bench) {
  const auto system = body();
  std::int64_t evaluations = 0;
  const auto rate = [&](const Vector& y, Vector& dy, double t) {
    ++evaluations;
    system->rate(t, y.data(), dy.data());
  };
  for (auto _ : bench) {
    evaluations = 0;
    const State<double> start = system->start();
    Vector y(start.y.begin(), start.y.end());
    odeint::runge_kutta4<Vector> stepper;
    for (int k = 0; k < int(t_end / h); ++k) stepper.do_step(rate, y, k * h, h);
    benchmark::DoNotOptimize(y.data());
  }
  report(bench, evaluations);
}

double first_step(const System<double>& system) {
  const auto integrator = find_integrator("odeint_dopri5")->make(system, {.tolerance = tolerance, .t_end = t_end});
  State<double> state = system.start();
  integrator->begin(state);
  integrator->step(state, t_end);
  return state.t;
}

void direct_dopri5(benchmark::State& bench) {
  const auto system = body();
  // Odeint keeps a step whose error is between half the tolerance and all of it, so the first one decides how many
  // there are: it is polhode's here too.
  const double first = first_step(*system);
  std::int64_t evaluations = 0;
  const auto rate = [&](const Vector& y, Vector& dy, double t) {
    ++evaluations;
    system->rate(t, y.data(), dy.data());
  };
  for (auto _ : bench) {
    evaluations = 0;
    const State<double> start = system->start();
    Vector y(start.y.begin(), start.y.end());
    auto stepper = odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<Vector>());
    double t = 0, step = first;
    while (t < t_end) {
      if (t + step > t_end) step = t_end - t;
      while (stepper.try_step(rate, y, t, step) == odeint::fail) {
      }
    }
    benchmark::DoNotOptimize(y.data());
  }
  report(bench, evaluations);
}

int right_hand_side(double t, N_Vector y, N_Vector dy, void* system) {
  static_cast<const System<double>*>(system)->rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
  return 0;
}

void require(bool done) {
  if (!done) throw std::runtime_error("CVODE");
}

void direct_cvode(benchmark::State& bench, int method) {
  const auto system = body();
  SUNContext context = nullptr;
  require(SUNContext_Create(nullptr, &context) == 0);
  long evaluations = 0, jacobian = 0;
  for (auto _ : bench) {
    const State<double> start = system->start();
    const sunindextype n = start.y.size();
    N_Vector y = N_VNew_Serial(n, context);
    for (sunindextype i = 0; i < n; ++i) NV_Ith_S(y, i) = start.y[i];
    void* memory = CVodeCreate(method, context);
    require(memory && CVodeInit(memory, right_hand_side, 0, y) == 0);
    CVodeSetUserData(memory, system.get());
    CVodeSStolerances(memory, tolerance, tolerance);
    SUNMatrix matrix = nullptr;
    SUNLinearSolver linear = nullptr;
    SUNNonlinearSolver nonlinear = nullptr;
    if (method == CV_BDF) {
      matrix = SUNDenseMatrix(n, n, context);
      linear = SUNLinSol_Dense(y, matrix, context);
      require(CVodeSetLinearSolver(memory, linear, matrix) == 0);
    } else {
      nonlinear = SUNNonlinSol_FixedPoint(y, 0, context);
      require(CVodeSetNonlinearSolver(memory, nonlinear) == 0);
    }
    CVodeSetStopTime(memory, t_end);
    double t = 0;
    while (t < t_end) require(CVode(memory, t_end, y, &t, CV_ONE_STEP) >= 0);
    benchmark::DoNotOptimize(N_VGetArrayPointer(y));
    CVodeGetNumRhsEvals(memory, &evaluations);
    if (method == CV_BDF) CVodeGetNumLinRhsEvals(memory, &jacobian);
    CVodeFree(&memory);
    if (linear) SUNLinSolFree(linear);
    if (matrix) SUNMatDestroy(matrix);
    if (nonlinear) SUNNonlinSolFree(nonlinear);
    N_VDestroy(y);
  }
  SUNContext_Free(&context);
  report(bench, evaluations + jacobian);
}

BENCHMARK(direct_rk4)->Name("odeint_rk4/direct");
BENCHMARK_CAPTURE(polhode_fixed, rk4, "odeint_rk4")->Name("odeint_rk4/polhode");
BENCHMARK(direct_dopri5)->Name("odeint_dopri5/direct");
BENCHMARK_CAPTURE(polhode_adaptive, dopri5, "odeint_dopri5")->Name("odeint_dopri5/polhode");
BENCHMARK_CAPTURE(direct_cvode, adams, CV_ADAMS)->Name("cvode_adams/direct");
BENCHMARK_CAPTURE(polhode_adaptive, adams, "cvode_adams")->Name("cvode_adams/polhode");
BENCHMARK_CAPTURE(direct_cvode, bdf, CV_BDF)->Name("cvode_bdf/direct");
BENCHMARK_CAPTURE(polhode_adaptive, bdf, "cvode_bdf")->Name("cvode_bdf/polhode");

}  // namespace

BENCHMARK_MAIN();
