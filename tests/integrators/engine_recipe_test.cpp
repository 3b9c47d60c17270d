// SPDX-License-Identifier: BSD-3-Clause
// The engine recipes against the figures that Peters & Hsu publish for the engines, "Comparison of Rigid Body Dynamic
// Simulators for Robotic Simulation in Gazebo", complex case.
#include <algorithm>

#include "tests/integrators/motion.hpp"

namespace polhode::by_hand::engine_recipe_test {
namespace {

constexpr Formulation engine{};  // a quaternion and the angular velocity in the world

struct Figures {
  double energy = 0, momentum = 0, position = 0;
};

/// max |(E − E0)/E0|, max |H − H0|/|H0| about the mass centre, max position error in m, over ten seconds.
Figures figures(const char* method, double h, const Formulation& formulation = engine) {
  Motion run(method, peters_hsu(), formulation);
  const double e0 = run.energy();
  const V3 h0 = run.body().angular_momentum, v0 = run.body().velocity, g(0, 0, -9.8);
  Figures most;
  const auto n = std::int64_t(std::round(10 / h));
  for (std::int64_t k = 1; k <= n; ++k) {
    run.steps(h);
    const double t = double(k) * h;
    const BodySnapshot<double> now = run.body();
    most.energy = std::max(most.energy, std::abs((run.energy() - e0) / e0));
    most.momentum = std::max(most.momentum, (now.angular_momentum - h0).norm() / h0.norm());
    most.position = std::max(most.position, (now.position - (t * v0 + t * t / 2 * g)).norm());
  }
  return most;
}

TEST(PetersHsu, StartsWithThePublishedEnergy) {
  EXPECT_NEAR(Motion("rk4", peters_hsu(), engine).energy(), 368.546416625, 1e-9);
}

TEST(PetersHsu, AllNineColumns) {
  struct Row {
    const char* method;
    double h;
    Figures published;
  };
  for (const Row& row :
       {Row{"recipe_ode", 1e-4, {0.00124711, 0.0012715, 0.0049}}, Row{"recipe_ode", 1e-3, {0.012462, 0.0130708, 0.049}},
        Row{"recipe_bullet", 1e-4, {0.0013586, 0.00125827, 0.0049}},
        Row{"recipe_bullet", 1e-3, {0.0135771, 0.0124501, 0.049}},
        Row{"recipe_simbody", 1e-4, {0.00062358, 0.000634808, 0.00245}},
        Row{"recipe_simbody", 1e-3, {0.00623355, 0.00643471, 0.0245}}}) {
    SCOPED_TRACE(std::string(row.method) + ", h = " + std::to_string(row.h));
    const Figures ours = figures(row.method, row.h);
    EXPECT_NEAR(ours.energy / row.published.energy, 1, 1e-4);
    EXPECT_NEAR(ours.momentum / row.published.momentum, 1, 1e-4);
    EXPECT_NEAR(ours.position / row.published.position, 1, 1e-4);
  }
}

// The position error is ½ g h T exactly, half of it in two half steps.
TEST(PetersHsu, PositionErrorIsThatOfSemiImplicitEuler) {
  for (const double h : {2e-3, 5e-3}) {
    EXPECT_NEAR(figures("recipe_ode", h).position, 0.5 * 9.8 * h * 10, 1e-10);
    EXPECT_NEAR(figures("recipe_bullet", h).position, 0.5 * 9.8 * h * 10, 1e-10);
    EXPECT_NEAR(figures("recipe_simbody", h).position, 0.25 * 9.8 * h * 10, 1e-10);
  }
}

// Without the gyroscopic term ω is constant in the world, to the bit; the energy does not show its absence.
TEST(PetersHsu, TheGyroscopicTermCanBeLeftOut) {
  Formulation without = engine;
  without.gyroscopic = false;
  for (const char* method : {"recipe_ode", "recipe_bullet", "recipe_simbody"}) {
    Motion run(method, peters_hsu(), without);
    const V3 w = run.body().angular_velocity;
    run.steps(1e-3, 100);
    EXPECT_EQ(run.body().angular_velocity, w) << method;
  }
}

TEST(EngineRecipes, KeepTheQuaternionNormalized) {
  for (const char* method : {"recipe_ode", "recipe_bullet", "recipe_simbody"}) {
    Motion run(method, peters_hsu(), engine);
    run.steps(1e-3, 10000);
    EXPECT_LT(run.measure().orientation_defect, 4e-16);
  }
}

TEST(EngineRecipes, RefuseWhatNoEngineKeeps) {
  for (const char* method : {"recipe_ode", "recipe_bullet", "recipe_simbody"}) {
    for (const Formulation& f : laws::all_formulations()) {
      const bool fits = f.orientation == Orientation::quaternion && f.angular_state == AngularState::velocity_world;
      EXPECT_EQ(find_integrator(method)->refusal(peters_hsu(), f).empty(), fits) << method << ", " << laws::label(f);
    }
  }
}

// One Newton step: what Bullet's update leaves of the implicit equation is of the second order in the change.
TEST(RecipeBullet, SolvesTheImplicitEquationToSecondOrder) {
  const V3 moments(0.5, 0.8, 1.1);
  Problem p = peters_hsu();
  p.bodies[0].inertia = moments.asDiagonal();
  p.starts[0].angular_velocity = {1, 2, -1.5};
  p.forces.clear();
  double last = 0;
  for (const double h : {0.04, 0.02, 0.01}) {
    Motion run("recipe_bullet", p, engine);
    run.steps(h);
    const V3 w = run.body().angular_velocity;  // the first body axes are the world's
    const V3 left = moments.cwiseProduct(w - p.starts[0].angular_velocity) + h * w.cross(moments.cwiseProduct(w));
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / left.norm()), 3, 0.1);
    }
    last = left.norm();
  }
}

}  // namespace
}  // namespace polhode::by_hand::engine_recipe_test
