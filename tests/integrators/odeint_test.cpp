// SPDX-License-Identifier: BSD-3-Clause
// Particulars of the methods of Boost.Odeint: starts and restarts of the multi-step method against its formulas,
// trials that are no number, stiffness, and a problem whose end is known to 15 digits.
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <vector>

#include "integrators/catalogue.hpp"
#include "tests/laws/probe_forces.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::odeint_test {
namespace {

using V3 = Vector3<double>;
using Flat = VectorX<double>;
const std::vector<std::string> controlled = {"odeint_cash_karp54", "odeint_dopri5", "odeint_fehlberg78",
                                             "odeint_bulirsch_stoer", "odeint_rosenbrock4"};

const IntegratorEntry& method(const std::string& name) {
  const IntegratorEntry* entry = find_integrator(name);
  if (!entry) throw std::runtime_error("no method " + name);
  return *entry;
}

/// Advances to t_end in steps of the method's choice; returns their number.
int run(Integrator<double>& integrator, State<double>& state, double t_end) {
  int steps = 0;
  for (integrator.begin(state); state.t < t_end; ++steps) {
    const StepResult result = integrator.step(state, t_end - state.t);
    EXPECT_TRUE(result.ok()) << result.failure;
    if (!result.ok()) break;
  }
  return steps;
}

// DETEST B5 (Hull et al. 1972): y' = (y2 y3, −y1 y3, −0.51 y1 y2), y(0) = (0, 1, 1), as the body I = (2, 3, 1) with
// Ω(0) = (0, √0.51, √3), y = Ω · (1/√1.53, 1/√0.51, 1/√3): y(20) = (sn, cn, dn)(20 | 0.51).
TEST(OdeintControlled, DetestB5) {
  Problem p;
  p.bodies.push_back({.name = "top", .inertia = laws::diagonal(2, 3, 1)});
  p.starts.push_back({.angular_velocity = {0, std::sqrt(0.51), std::sqrt(3.0)}, .angular_velocity_in_body = true});
  const auto system = make_system<double>(p, {.angular_state = AngularState::velocity_body});
  const V3 scale(1 / std::sqrt(1.53), 1 / std::sqrt(0.51), 1 / std::sqrt(3.0));
  const V3 exact(-0.939657079872920, -0.342117775400075, 0.741412659619995);
  for (const std::string& name : controlled) {
    if (name == "odeint_rosenbrock4") continue;  // a method of order 4 takes too many steps for ten digits
    State<double> state = system->start();
    const auto integrator = method(name).make(*system, {.tolerance = 1e-13, .t_end = 20});
    run(*integrator, state, 20);
    const V3 y = state.y.segment<3>(system->layout().slots[0].angular).cwiseProduct(scale);
    EXPECT_LT((y - exact).cwiseAbs().maxCoeff(), 1e-10) << name;
  }
}

// The steps, rejected ones too, and the digits are those of the library called directly from the same first step.
TEST(OdeintControlled, IsTheLibraryItself) {
  namespace odeint = boost::numeric::odeint;
  using Vector = std::vector<double>;
  const auto system = make_system<double>(laws::free_top(), {.angular_state = AngularState::velocity_body});
  State<double> state = system->start();
  const auto integrator = method("odeint_dopri5").make(*system, {.tolerance = 1e-8, .t_end = 10});
  integrator->begin(state);
  Vector y(state.y.begin(), state.y.end());
  const auto rate = [&](const Vector& at, Vector& dy, double t) { system->rate(t, at.data(), dy.data()); };
  auto stepper = odeint::make_controlled(1e-8, 1e-8, odeint::runge_kutta_dopri5<Vector>());
  double t = 0, h = 0;
  int rejected = 0;
  while (state.t < 10) {
    ASSERT_TRUE(integrator->step(state, 10 - state.t).ok());
    if (t == 0) h = state.t;
    h = std::min(h, 10 - t);
    while (stepper.try_step(rate, y, t, h) == odeint::fail) ++rejected;
    ASSERT_NEAR(state.t, t, 1e-14);
    ASSERT_LT((state.y - Eigen::Map<const Flat>(y.data(), state.y.size())).cwiseAbs().maxCoeff(), 1e-13);
  }
  EXPECT_GT(rejected, 2);
}

// No trial passes where the right-hand side ceases to be a number: the steps shrink towards that time, then one fails.
TEST(OdeintControlled, NoTrialThatIsNoNumberPasses) {
  for (const std::string& name : controlled) {
    SCOPED_TRACE(name);
    const auto system = make_system<double>(laws::box_on_spring(), {});
    system->add_force(std::make_unique<laws::Breaking<double>>(1, 0.3));
    const auto integrator = method(name).make(*system, {.tolerance = 1e-6, .t_end = 1});
    State<double> state = system->start();
    integrator->begin(state);
    StepResult result;
    for (int steps = 0; steps < 1000 && result.ok(); ++steps) {
      result = integrator->step(state, 1 - state.t);
      EXPECT_TRUE(state.y.allFinite());
    }
    EXPECT_EQ(result.failure, "Odeint's step size fell to nothing");
    // Rosenbrock's ∂f/∂t is a difference with a time 6e-6 s ahead.
    EXPECT_NEAR(state.t, 0.3, 1e-5);
  }
}

// A stiff damper, Re hλ = −10⁴: the L-stable method steps over it, an explicit one must not.
TEST(OdeintRosenbrock4, StepsOverAStiffDamper) {
  Problem p;
  p.bodies.push_back({.name = "ball", .mass = 1, .inertia = laws::diagonal(1, 1, 1)});
  p.starts.push_back({.position = {1, 0, 0}, .velocity = {0, 2, 0}});
  p.forces.push_back(laws::force("drag", {0}, {{"linear", 1e4}}));
  p.forces.push_back(laws::force("uniform_gravity", {0}, {{"acceleration", V3(0, 0, -9.81)}}));
  const auto system = make_system<double>(p, {});
  const auto steps = [&](const std::string& name) {
    State<double> state = system->start();
    const auto integrator = method(name).make(*system, {.tolerance = 1e-6, .t_end = 1});
    const int taken = run(*integrator, state, 1);
    const V3 v = state.y.segment<3>(system->layout().slots[0].velocity);
    EXPECT_NEAR(v[2], -9.81e-4, 1e-6) << name;
    EXPECT_NEAR(v[1], 0, 1e-6) << name;
    return taken;
  };
  EXPECT_LT(steps("odeint_rosenbrock4"), 200);
  EXPECT_GT(steps("odeint_cash_karp54"), 2000);
}

// y' = f: three steps by Runge–Kutta, then
//   predictor  y⁎ = y + h/24 (55 f0 − 59 f1 + 37 f2 − 9 f3),  corrector  y' = y + h/24 (9 f(y⁎) + 19 f0 − 5 f1 + f2).
TEST(OdeintAdamsBashforthMoulton, IsItsFormulas) {
  const auto system = make_system<double>(laws::box_on_spring(), {});
  const double h = 0.02;
  const auto adams = method("odeint_adams_bashforth_moulton").make(*system, {});
  const auto rk4 = method("odeint_rk4").make(*system, {});
  State<double> state = system->start(), by_rk4 = state;
  adams->begin(state);
  rk4->begin(by_rk4);
  const auto rate = [&](double t, const Flat& y) {
    Flat dy(y.size());
    system->rate(t, y.data(), dy.data());
    return dy;
  };
  std::array<Flat, 4> f;  // rates at the present state and the three states before it
  for (int n = 0; n < 12; ++n) {
    for (int k = 3; k > 0; --k) f[std::size_t(k)] = f[std::size_t(k - 1)];
    f[0] = rate(state.t, state.y);
    Flat expected;
    if (n < 3) {
      ASSERT_TRUE(rk4->step(by_rk4, h).ok());
      expected = by_rk4.y;
    } else {
      const Flat predicted = state.y + h / 24 * (55 * f[0] - 59 * f[1] + 37 * f[2] - 9 * f[3]);
      expected = state.y + h / 24 * (9 * rate(state.t + h, predicted) + 19 * f[0] - 5 * f[1] + f[2]);
    }
    ASSERT_TRUE(adams->step(state, h).ok());
    EXPECT_LT((state.y - expected).cwiseAbs().maxCoeff(), 1e-14) << "step " << n;
  }
  EXPECT_EQ(adams->evaluations(), 3 * 4 + 9 * 2);
}

// Another step, or a change from outside, makes the history worthless: the next step is a Runge–Kutta one.
TEST(OdeintAdamsBashforthMoulton, StartsAgainWhereItsHistoryIsWorthless) {
  const auto system = make_system<double>(laws::box_on_spring(), {});
  for (const bool other_step : {true, false}) {
    const auto adams = method("odeint_adams_bashforth_moulton").make(*system, {});
    State<double> state = system->start();
    adams->begin(state);
    ASSERT_TRUE(adams->advance(state, 0.02, 6).ok());
    const std::int64_t before = adams->evaluations();
    const double h = other_step ? 0.015 : 0.02;
    if (!other_step) adams->discard_history(state);
    const auto rk4 = method("odeint_rk4").make(*system, {});
    State<double> by_rk4 = state;
    rk4->begin(by_rk4);
    ASSERT_TRUE(rk4->step(by_rk4, h).ok());
    ASSERT_TRUE(adams->step(state, h).ok());
    EXPECT_EQ(state.y, by_rk4.y);
    EXPECT_EQ(adams->evaluations() - before, 4);
  }
}

// The library's Runge–Kutta method and ours are one method: they differ by how they sum.
TEST(OdeintRk4, IsTheClassicalMethod) {
  const auto system = make_system<double>(laws::five_bodies(), {});
  State<double> a = system->start(), b = a;
  const auto library = method("odeint_rk4").make(*system, {}), ours = method("rk4").make(*system, {});
  library->begin(a);
  ours->begin(b);
  ASSERT_TRUE(library->advance(a, 0.01, 100).ok());
  ASSERT_TRUE(ours->advance(b, 0.01, 100).ok());
  EXPECT_LT((a.y - b.y).cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace polhode::odeint_test
