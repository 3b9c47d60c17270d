// SPDX-License-Identifier: BSD-3-Clause
// Particulars of the methods of SUNDIALS: their own root finding, their own projection, the choice of an order,
// and how they say that they cannot go on.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/run/simulate.hpp"
#include "integrators/catalogue.hpp"
#include "tests/laws/probe_forces.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::sundials_test {
namespace {

using V3 = Vector3<double>;
const std::vector<std::string> all = {"cvode_adams", "cvode_bdf", "arkode_erk", "arkode_dirk"};

IntegratorPointer<double> make(const std::string& name, const System<double>& system,
                               const IntegratorSettings& settings) {
  return find_integrator(name)->make(system, settings);
}

struct Root {
  double t;
  int sign;
};

/// The roots of the events on the way to t_end, in order; all steps must do.
std::vector<Root> roots(Integrator<double>& integrator, State<double>& state, double t_end,
                        std::vector<EventFunction<double>> events) {
  std::vector<Root> found;
  NativeRoots<double>& native = *integrator.native_roots();
  native.set_events(std::move(events));
  for (integrator.begin(state); state.t < t_end;) {
    const StepResult result = integrator.step(state, t_end - state.t);
    EXPECT_TRUE(result.ok()) << result.failure;
    if (!result.ok()) break;
    for (const int sign : native.events()) {
      if (sign != 0) found.push_back({state.t, sign});
    }
  }
  return found;
}

// The apex of a throw: v_z = 0 at v_z(0)/g, falling, at the height v_z(0)²/2g.
TEST(NativeRoots, ApexOfAProjectile) {
  const double g = 9.81, v = 7.3;
  Problem p;
  p.bodies.push_back({.name = "ball", .inertia = laws::diagonal(0.6, 0.8, 1)});
  p.starts.push_back({.velocity = {1.5, 0, v}, .angular_velocity = {1, 2, -1}});
  p.forces.push_back(laws::force("uniform_gravity", {0}, {{"acceleration", V3(0, 0, -g)}}));
  const auto system = make_system<double>(p, {});
  const Layout::Slot slot = system->layout().slots[0];
  for (const std::string& name : all) {
    SCOPED_TRACE(name);
    const auto integrator = make(name, *system, {.tolerance = 1e-11, .t_end = 2});
    NativeRoots<double>* native = integrator->native_roots();
    ASSERT_TRUE(native);
    ASSERT_TRUE(integrator->dense_output());
    State<double> state = system->start(), apex = state;
    const auto vertical = [&](const State<double>& s) { return s.y[slot.velocity + 2]; };
    native->set_events({vertical});
    integrator->begin(state);
    while (state.t < 2) {
      ASSERT_TRUE(integrator->step(state, 2 - state.t).ok());
      if (native->events()[0] != 0) {
        apex = state;
        EXPECT_EQ(native->events()[0], -1);
        State<double> beyond = state;
        EXPECT_FALSE(integrator->dense_output()->interpolate(state.t + 1e-6, beyond)) << "the step ended at the root";
      }
    }
    EXPECT_EQ(state.t, 2);
    EXPECT_NEAR(apex.t, v / g, 1e-9);
    EXPECT_NEAR(apex.y[slot.position + 2], v * v / (2 * g), 1e-9);
  }
}

// An oscillator of ω = 3 from x = 1 at rest: x vanishes at (k + ½) π/ω, falling and rising in turn, and v at k π/ω.
TEST(NativeRoots, ZerosOfAnOscillator) {
  const double omega = 3;
  Problem p;
  p.bodies.push_back({.name = "ball", .mass = 2, .inertia = laws::diagonal(1, 1, 1)});
  p.starts.push_back({.position = {1, 0, 0}, .velocity = {0, 0, 0}});
  p.forces.push_back(laws::force("spring", {0}, {{"stiffness", 2 * omega * omega}}));
  const auto system = make_system<double>(p, {});
  const Layout::Slot slot = system->layout().slots[0];
  for (const std::string& name : all) {
    SCOPED_TRACE(name);
    const auto integrator = make(name, *system, {.tolerance = 1e-12, .t_end = 5});
    State<double> state = system->start();
    const auto x = [&](const State<double>& s) { return s.y[slot.position]; };
    const auto found = roots(*integrator, state, 5, {x});
    ASSERT_EQ(found.size(), 5u);
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].t, (double(k) + 0.5) * std::numbers::pi / omega, 1e-9);
      EXPECT_EQ(found[k].sign, k % 2 == 0 ? -1 : 1);
    }
    // With a second event, which is zero at the start: that one is no root.
    state = system->start();
    const auto v = [&](const State<double>& s) { return s.y[slot.velocity]; };
    const auto both = roots(*integrator, state, 5, {x, v});
    ASSERT_EQ(both.size(), 9u);
    for (std::size_t k = 0; k < both.size(); ++k) {
      EXPECT_NEAR(both[k].t, (double(k) + 1) / 2 * std::numbers::pi / omega, 1e-9);
    }
  }
}

// Projection within the steps keeps the manifold and the history; outside them each step is the first of a new run.
TEST(NativeProjection, KeepsTheManifoldAndTheHistory) {
  struct Watch final : Observer {
    double defect = 0, projection = 0;
    std::size_t on_samples(std::span<const Sample> seen) override {
      for (const Sample& s : seen) {
        defect = std::max(defect, s.seen.orientation_defect);
        projection = s.projection;
      }
      return seen.size();
    }
  };
  for (const Orientation orientation : {Orientation::quaternion, Orientation::matrix}) {
    const auto system = make_system<double>(laws::free_top(), {.orientation = orientation});
    const auto run = [&](bool natively, Watch& watch, State<double>& state) {
      const auto integrator = make("cvode_bdf", *system, {.tolerance = 1e-6, .t_end = 1, .project = natively});
      EXPECT_EQ(integrator->native_projection() != nullptr, natively);
      state = system->start();
      const Schedule schedule{.t_end = 1, .adaptive = true, .samples = {}, .normalize = true};
      const RunOutcome outcome = simulate(*system, *system, *integrator, state, schedule, watch);
      EXPECT_EQ(outcome.status, RunStatus::ok) << outcome.message;
      return outcome.evaluations;
    };
    Watch native, outside;
    State<double> a, b;
    EXPECT_LT(4 * run(true, native, a), run(false, outside, b));
    EXPECT_LT(native.defect, 2e-15);
    EXPECT_LT(outside.defect, 2e-15);
    State<double> exact = system->start();
    const auto judge = find_integrator("rk4")->make(*system, {});
    judge->begin(exact);
    ASSERT_TRUE(judge->advance(exact, 1e-3, 1000).ok());
    EXPECT_LT((a.y - exact.y).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT((b.y - exact.y).cwiseAbs().maxCoeff(), 1e-2);
    if (orientation == Orientation::quaternion) {
      EXPECT_EQ(native.projection, 0) << "the equations read q/|q| only";
    } else {
      EXPECT_NE(native.projection, 0);
      EXPECT_LT(std::abs(native.projection), 1e-3);
    }
  }
}

// A body that hardly moves, with a quaternion off the sphere whose formula is taken as stored: all of the change of the
// energy is by the first projection.
TEST(NativeProjection, CountsTheEnergyThatItInjects) {
  Problem p;
  p.bodies.push_back({.name = "ball", .inertia = laws::diagonal(1, 1, 1)});
  p.starts.push_back({.orientation = {0.6, 0, 0.8, 0}, .angular_velocity = {2e-7, 0, 1e-7}});
  const auto system = make_system<double>(p, {.rotation_from = RotationFrom::stored});
  State<double> state = system->start();
  state.y.segment<4>(system->layout().slots[0].orientation) *= 1 + 1e-6;
  const double before = system->measure(state.y).energy();
  const auto integrator = make("cvode_bdf", *system, {.tolerance = 1e-6, .t_end = 1, .project = true});
  integrator->begin(state);
  while (state.t < 1) ASSERT_TRUE(integrator->step(state, 1 - state.t).ok());
  const double change = system->measure(state.y).energy() - before;
  EXPECT_GT(std::abs(change), 1e-7 * before);
  EXPECT_NEAR(integrator->native_projection()->projection_energy() / change, 1, 1e-5);
}

// Only backward differentiation projects by itself.
TEST(NativeProjection, IsBackwardDifferentiationsAlone) {
  const auto system = make_system<double>(laws::free_top(), {});
  for (const std::string& name : all) {
    EXPECT_EQ(make(name, *system, {.project = true})->native_projection() != nullptr, name == "cvode_bdf") << name;
    EXPECT_FALSE(make(name, *system, {.project = false})->native_projection()) << name;
  }
}

// DETEST B5 (see odeint_test.cpp) at t = 20.
TEST(Sundials, DetestB5) {
  Problem p;
  p.bodies.push_back({.name = "top", .inertia = laws::diagonal(2, 3, 1)});
  p.starts.push_back({.angular_velocity = {0, std::sqrt(0.51), std::sqrt(3.0)}, .angular_velocity_in_body = true});
  const auto system = make_system<double>(p, {.angular_state = AngularState::velocity_body});
  const V3 scale(1 / std::sqrt(1.53), 1 / std::sqrt(0.51), 1 / std::sqrt(3.0));
  const V3 exact(-0.939657079872920, -0.342117775400075, 0.741412659619995);
  for (const auto& [name, chosen] :
       {std::pair("cvode_adams", SettingValues{}), std::pair("arkode_erk", SettingValues{{"order", 8}})}) {
    State<double> state = system->start();
    const auto integrator = make(name, *system, {.tolerance = 1e-14, .t_end = 20, .chosen = chosen});
    integrator->begin(state);
    while (state.t < 20) ASSERT_TRUE(integrator->step(state, 20 - state.t).ok());
    const V3 y = state.y.segment<3>(system->layout().slots[0].angular).cwiseProduct(scale);
    EXPECT_LT((y - exact).cwiseAbs().maxCoeff(), 1e-10) << name;
  }
}

// A higher order takes fewer right-hand sides to a tight tolerance; an order that does not exist is reported.
TEST(Arkode, TakesTheOrderThatIsAskedFor) {
  const auto system = make_system<double>(laws::free_top(), {});
  const auto evaluations = [&](const std::string& name, std::optional<int> order, double tolerance) {
    IntegratorSettings settings{.tolerance = tolerance, .t_end = 1};
    if (order) settings.chosen["order"] = *order;
    const auto integrator = make(name, *system, settings);
    State<double> state = system->start();
    integrator->begin(state);
    while (state.t < 1) {
      if (!integrator->step(state, 1 - state.t).ok()) return std::int64_t(0);
    }
    return integrator->evaluations();
  };
  EXPECT_EQ(evaluations("arkode_erk", std::nullopt, 1e-8), evaluations("arkode_erk", 4, 1e-8));
  EXPECT_EQ(evaluations("arkode_dirk", std::nullopt, 1e-6), evaluations("arkode_dirk", 4, 1e-6));
  std::int64_t more = evaluations("arkode_erk", 2, 1e-10);
  for (const int order : {3, 4, 5}) {
    const std::int64_t fewer = evaluations("arkode_erk", order, 1e-10);
    EXPECT_LT(fewer, more) << order;
    more = fewer;
  }
  for (const int order : {6, 7, 8}) {
    EXPECT_GT(evaluations("arkode_erk", order, 1e-10), 0) << order;
    EXPECT_LT(evaluations("arkode_erk", order, 1e-10), evaluations("arkode_erk", 4, 1e-10)) << order;
  }
  EXPECT_LT(evaluations("arkode_dirk", 4, 1e-8), evaluations("arkode_dirk", 2, 1e-8));
  EXPECT_GT(evaluations("arkode_dirk", 3, 1e-6), 0);
  EXPECT_GT(evaluations("arkode_dirk", 5, 1e-6), 0);
  for (const int order : {1, 9})
    EXPECT_THROW(make("arkode_erk", *system, {.chosen = {{"order", order}}}), std::invalid_argument);
  for (const int order : {1, 6})
    EXPECT_THROW(make("arkode_dirk", *system, {.chosen = {{"order", order}}}), std::invalid_argument);
}

// A right-hand side that is no number ends a run with the library's name and its reason.
TEST(Sundials, SaysWhyItGaveUp) {
  const auto system = make_system<double>(laws::box_on_spring(), {});
  system->add_force(std::make_unique<laws::Breaking<double>>(1, 0.3));
  for (const std::string& name : all) {
    const auto integrator = make(name, *system, {.tolerance = 1e-6, .t_end = 1});
    State<double> state = system->start();
    integrator->begin(state);
    StepResult result;
    for (int steps = 0; steps < 10000 && result.ok(); ++steps) result = integrator->step(state, 1 - state.t);
    const std::string library = name.starts_with("cvode") ? "CVODE" : "ARKODE";
    EXPECT_TRUE(result.failure == library + "'s step size fell to nothing" ||
                result.failure.starts_with(library + " gave up ("))
        << name << ": " << result.failure;
    EXPECT_TRUE(state.y.allFinite());
    EXPECT_NEAR(state.t, 0.3, 0.01);
    EXPECT_LE(state.t, 0.3 + 1e-15);
  }
}

}  // namespace
}  // namespace polhode::sundials_test
