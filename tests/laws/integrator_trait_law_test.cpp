// SPDX-License-Identifier: BSD-3-Clause
// The traits that a method declares beyond its order, from both sides: what is declared holds in every formulation that
// the method accepts, what is not fails visibly in one of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "integrators/compensated.hpp"
#include "tests/laws/integrator_trials.hpp"

namespace polhode::laws::integrator_trait_law_test {
namespace {

class IntegratorTrait : public OverTheCatalogue {
 protected:
  /// The worst of a deviation over a run of a free body that is not symmetric: `steps` steps of h, or an adaptive
  /// method's way over 10 s. It stops at a deviation of more than 1. deviation(system, state) is evaluated after every
  /// `stride` steps.
  template <class Deviation>
  double worst(const Formulation& f, int steps, const Deviation& deviation, double h = 0.05) const {
    const double t_end = adaptive() ? 10 : steps * h;
    const int stride = 10;
    const auto system = make_system<double>(free_top(), f);
    const auto integrator = make(*system, 1e-8, t_end);
    State<double> state = system->start();
    integrator->begin(state);
    double most = 0;
    for (int k = 0; state.t < t_end - h / 2; ++k) {
      if (adaptive()) {
        const StepResult result = integrator->step(state, t_end - state.t);
        EXPECT_TRUE(result.ok()) << result.failure;
        if (!result.ok()) return most;
      } else {
        EXPECT_TRUE(integrator->advance(state, h, stride).ok());
        state.t = (k + 1) * stride * h;
      }
      const double now = deviation(*system, state);
      if (!(now <= 1)) return 1;  // or no number
      most = std::max(most, now);
    }
    return most;
  }

  /// Declared: below `limit` in every formulation. Not declared: above `seen` in one at least.
  template <class Deviation>
  void expect_kept(bool is_declared, int steps, double limit, double seen, const Deviation& deviation) const {
    if (declared().solves_joints()) GTEST_SKIP() << "it needs joints, and this is about a free body";
    int accepted = 0;
    double most = 0;
    for (const Formulation& f : gyroscopic_formulations()) {
      if (refuses(free_top(), f)) continue;
      SCOPED_TRACE(label(f));
      ++accepted;
      // Steps that are not small show what a method of high order does not keep.
      const double now = worst(f, steps, deviation, is_declared ? 0.05 : 0.1);
      if (is_declared) {
        EXPECT_LT(now, limit);
      }
      most = std::max(most, now);
      if (!is_declared && most > seen) return;
    }
    EXPECT_GT(accepted, 0) << "every formulation is refused";
    if (!is_declared) {
      EXPECT_GT(most, seen) << "it keeps what it does not declare";
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Catalogue, IntegratorTrait, testing::ValuesIn(method_names()),
                         [](const auto& param_info) { return param_info.param; });

// A step of −h undoes one of h, on every trial, whatever the forces.
TEST_P(IntegratorTrait, SymmetricMethodsReturn) {
  if (adaptive()) {
    EXPECT_FALSE(declared().symmetric) << "steps that depend on where they start do not return";
    return;
  }
  double most = 0;
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto integrator = make(*system);
    State<double> state = system->start();
    integrator->begin(state);
    ASSERT_TRUE(integrator->advance(state, 0.03, 10).ok());
    const State<double> before = state;
    ASSERT_TRUE(integrator->step(state, 0.1).ok());
    const StepResult back = integrator->step(state, -0.1);
    ASSERT_TRUE(back.ok()) << back.failure;
    const double away = difference(state.y, before.y);
    if (declared().symmetric) {
      EXPECT_LT(away, 1e-12);
    }
    most = std::max(most, away);
  });
  if (!declared().symmetric) {
    EXPECT_GT(most, 1e-10) << "it is symmetric and does not say so";
  }
}

// A step with compensated sums is the step itself to round-off, whatever the forces; a method whose step is no sum has
// none.
TEST_P(IntegratorTrait, AdditiveMethodsTakeCompensatedSteps) {
  if (!declared().additive) {
    const auto system = build<double>(own_trials().front(), {});
    EXPECT_THROW(make_compensated<double>(entry(), *system, {}), std::invalid_argument);
    return;
  }
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto plain = make(*system);
    const auto compensated = make_compensated<double>(entry(), *system, {});
    State<double> a = system->start(), b = a;
    plain->begin(a);
    compensated->begin(b);
    for (int k = 1; k <= 20; ++k) {
      ASSERT_TRUE(plain->step(a, 1.0 / 64).ok());
      ASSERT_TRUE(compensated->step(b, 1.0 / 64).ok());
      ASSERT_LT(difference(a.y, b.y), 4e-15 * k);
      ASSERT_EQ(a.t, b.t);
    }
    EXPECT_EQ(plain->evaluations() > 0, compensated->evaluations() > 0);
  });
}

// Over many small steps in float the sums round far more than the increments do: in the same steps in long double
// neither.
TEST_P(IntegratorTrait, CompensatedSumsLoseLess) {
  if (!declared().additive) GTEST_SKIP() << "its step is not a sum";
  constexpr std::int64_t steps = 8192;
  constexpr double h = 1.0 / 4096;
  for (const Orientation o : {Orientation::quaternion, Orientation::matrix}) {
    const Formulation f{o, AngularState::velocity_body};
    const auto system = make_system<float>(free_top(), f);
    const auto exact = make_system<long double>(free_top(), f);
    const auto after = [&](auto& integrator, auto state) {
      integrator.begin(state);
      EXPECT_TRUE(integrator.advance(state, h, steps).ok());
      return state.y;
    };
    const State<float> start = system->start();
    const auto truth = after(*make<long double>(*exact), State<long double>{0, start.y.cast<long double>()});
    const double plain = difference(after(*make<float>(*system), start), truth);
    const double compensated = difference(after(*make_compensated<float>(entry(), *system, {}), start), truth);
    EXPECT_LT(compensated, plain / 5);
    EXPECT_LT(compensated, 1e-6);
    EXPECT_GT(plain, 1e-6);
  }
}

// Without projection the orientation stays on its manifold to round-off by group steps, to the tolerance of the
// iteration where quadratic invariants are conserved, and otherwise leaves it.
TEST_P(IntegratorTrait, OrientationsStayOnTheirManifold) {
  const bool stays = declared().lie_group || declared().normalizes || declared().conserves_quadratics;
  expect_kept(stays, 1000, declared().conserves_quadratics ? 1e-11 : 1e-12, 1e-10,
              [](const System<double>& system, const State<double>& state) {
                return system.measure(state.y).orientation_defect;
              });
}

TEST_P(IntegratorTrait, EnergyIsKept) {
  const auto energy = [](const System<double>& system, const State<double>& state) {
    return system.measure(state.y).energy();
  };
  expect_kept(declared().conserves_energy, 2000, 1e-11, 1e-10,
              [&](const System<double>& system, const State<double>& state) {
                const double start = energy(system, system.start());
                return std::abs(energy(system, state) - start) / start;
              });
}

// In body axes the energy of a free body is ½ Ω·IΩ + ½ m v².
TEST_P(IntegratorTrait, QuadraticMethodsKeepTheEnergyInBodyAxes) {
  if (!declared().conserves_quadratics) GTEST_SKIP() << "it does not";
  for (const Orientation o : {Orientation::quaternion, Orientation::matrix}) {
    const Formulation f{o, AngularState::velocity_body};
    if (refuses(free_top(), f)) continue;
    EXPECT_LT(worst(f, 2000,
                    [](const System<double>& system, const State<double>& state) {
                      const double start = system.measure(system.start().y).energy();
                      return std::abs(system.measure(state.y).energy() - start) / start;
                    }),
              1e-11);
  }
}

TEST_P(IntegratorTrait, MomentumIsKept) {
  const auto momentum = [](const System<double>& system, const State<double>& state) {
    return system.measure(state.y).angular_momentum;
  };
  expect_kept(declared().conserves_momentum, 2000, 1e-11, 1e-10,
              [&](const System<double>& system, const State<double>& state) {
                const Vector3<double> start = momentum(system, system.start());
                return (momentum(system, state) - start).norm() / start.norm();
              });
}

TEST_P(IntegratorTrait, CasimirIsKept) {
  const auto casimir = [](const System<double>& system, const State<double>& state) {
    const BodySnapshot<double> body = system.snapshot(state.y, 0);
    const Vector3<double> spin = body.rotation.transpose() * body.angular_velocity;
    return (system.problem().bodies[0].inertia * spin).norm();
  };
  expect_kept(declared().conserves_casimir, 2000, 1e-11, 1e-10,
              [&](const System<double>& system, const State<double>& state) {
                const double start = casimir(system, system.start());
                return std::abs(casimir(system, state) - start) / start;
              });
}

// The equations of the joints that the states of a method satisfy: a fixed step keeps those that it declares, to
// round-off, and no others; an adaptive one keeps those that it declares, to a hundred times its tolerance.
TEST_P(IntegratorTrait, EquationsOfJointsAreKept) {
  const JointEquations kept = declared().joints;
  if (!declared().solves_joints()) GTEST_SKIP() << "it leaves them to the formulation";
  const auto system = build<double>(own_trials().front(), {});
  const State<double> end = run(*system, 1e-8);
  const auto motions = motions_of(*system, end.y);
  double gap = 0, rate = 0;
  for (std::size_t i = 0; i < system->constraints()->count(); ++i) {
    const auto v = system->constraints()->violation(i, motions);
    gap = std::max({gap, v.position, v.angle});
    rate = std::max({rate, v.velocity, v.rate});
  }
  const auto expect = [&](bool is_declared, double size) {
    if (is_declared) {
      EXPECT_LT(size, adaptive() ? 1e-6 : 1e-11);
    } else if (!adaptive()) {
      EXPECT_GT(size, 1e-9);
    }
  };
  const bool both = kept == JointEquations::position_and_velocity;
  expect(both || kept == JointEquations::position, gap);
  expect(both || kept == JointEquations::velocity, rate);
}

}  // namespace
}  // namespace polhode::laws::integrator_trait_law_test
