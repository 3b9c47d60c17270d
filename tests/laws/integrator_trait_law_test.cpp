// SPDX-License-Identifier: BSD-3-Clause
// What a method declares of itself beyond its order, from both sides: what is declared holds in every formulation that
// the method accepts, what is not is seen to fail in one of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/laws/integrator_trials.hpp"

namespace polhode::laws {
namespace {

class IntegratorTrait : public OverTheCatalogue {
 protected:
  /// The worst of a deviation over a run of a free body that is not symmetric: `steps` steps of h, or an adaptive
  /// method's way over 10 s. It stops at a deviation of more than 1. deviation(system, state) is asked after every
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
    ASSERT_TRUE(integrator->step(state, -0.1).ok());
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

// Without projection the orientation stays on its manifold to round-off by group steps, to the tolerance of the
// iteration where quadratic invariants are conserved, and otherwise leaves it.
TEST_P(IntegratorTrait, OrientationsStayOnTheirManifold) {
  const bool stays = declared().lie_group || declared().normalises || declared().conserves_quadratics;
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

}  // namespace
}  // namespace polhode::laws
