// SPDX-License-Identifier: BSD-3-Clause
// The laws of an integrator: what every entry of the catalogue must keep, in every formulation, on a free problem, a
// forced one and one that depends on time. A new method needs nothing here. Its accuracy is in
// integrator_accuracy_law_test.cpp, several steps in one call in integrator_batch_law_test.cpp, what it declares beyond
// its order in integrator_trait_law_test.cpp.
#include "tests/laws/integrator_law.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/system/joint_projection.hpp"
#include "tests/laws/reference_flow.hpp"

namespace polhode::laws::integrator_law_test {
namespace {

using Real = long double;
using Flat = VectorX<Real>;

INSTANTIATE_TEST_SUITE_P(Catalogue, IntegratorLaw, testing::ValuesIn(method_names()),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(IntegratorLaw, DeclaresWhatItIs) {
  const Declaration& d = declared();
  EXPECT_FALSE(d.family.empty());
  EXPECT_FALSE(d.summary.empty());
  EXPECT_FALSE(refuses(own_trials().front().problem, {})) << "every method accepts a body as it is by default";
  EXPECT_EQ(refuses(free_top(), {}), d.solves_joints()) << "a method of joints needs some";
  EXPECT_EQ(refuses(jointed_rods(), {}), d.refuses_joints);
  ASSERT_TRUE(entry().make) << "every method works in double";
  if (adaptive()) {
    EXPECT_EQ(d.evaluations_per_step, 0) << "an adaptive method counts its evaluations";
  } else {
    EXPECT_GT(d.order, 0) << "a fixed-step method has an order";
  }
}

// A method reads each of its settings: it takes the ends of the range and every choice, and refuses other values.
TEST_P(IntegratorLaw, ReadsItsSettings) {
  const auto system = build<double>(own_trials().front(), {});
  const auto made = [&](const Setting& setting, const SettingValue& value) {
    return entry().make(*system, {.chosen = {{setting.key, value}}}) != nullptr;
  };
  for (const Setting& setting : declared().settings) {
    SCOPED_TRACE(setting.key);
    EXPECT_FALSE(setting.meaning.empty());
    EXPECT_EQ(setting.fault(setting.usual), "");
    EXPECT_EQ(setting.choices.empty(), !std::holds_alternative<std::string>(setting.usual));
    for (const std::string& choice : setting.choices) EXPECT_TRUE(made(setting, choice));
    if (!setting.choices.empty()) {
      EXPECT_THROW(made(setting, "no such choice"), std::invalid_argument);
      continue;
    }
    EXPECT_GT(setting.lowest, 0);
    const bool whole = std::holds_alternative<std::int64_t>(setting.usual);
    const auto value = [&](double x) { return whole ? SettingValue(static_cast<std::int64_t>(x)) : SettingValue(x); };
    EXPECT_TRUE(made(setting, value(setting.lowest)));
    EXPECT_TRUE(made(setting, value(setting.highest)));
    EXPECT_THROW(made(setting, value(setting.lowest - 1)), std::invalid_argument);
    EXPECT_THROW(made(setting, value(setting.highest + 1)), std::invalid_argument);
  }
}

// evaluations() is the number of right-hand sides since begin(), those of the start and of a discarded history too.
TEST_P(IntegratorLaw, CountsItsEvaluations) {
  everywhere([&](const Trial& trial, const Formulation& f) {
    std::int64_t count = 0;
    const auto system = build<double>(trial, f);
    system->add_force(std::make_unique<Counting<double>>(count));
    const auto integrator = make(*system);
    for (int again = 0; again < 2; ++again) {
      State<double> state = system->start();
      count = 0;
      integrator->begin(state);
      EXPECT_EQ(integrator->evaluations(), count);
      go(*integrator, state, 0.25, 16);
      EXPECT_EQ(integrator->evaluations(), count);
      if (declared().evaluations_per_step > 0) {
        EXPECT_EQ(count, 16 * declared().evaluations_per_step);
      }
      system->project(state.y);
      integrator->discard_history(state);
      EXPECT_EQ(integrator->evaluations(), count);
      go(*integrator, state, 0.5, 16);
      EXPECT_EQ(integrator->evaluations(), count);
      EXPECT_GT(count, 0);
    }
  });
}

// A step fails and leaves the state as it was where the right-hand side ceases to be a number, or the driver finds that
// the state is no number; no row of the run is garbage.
TEST_P(IntegratorLaw, StopsWhereTheForceBreaks) {
  const double after = 0.3;
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    system->add_force(std::make_unique<Breaking<double>>(trial.problem.moving(), after));
    const auto integrator = make(*system);
    State<double> state = system->start();
    integrator->begin(state);
    for (int steps = 0; steps < 10000; ++steps) {
      const State<double> before = state;
      const StepResult result = integrator->step(state, adaptive() ? 1 - state.t : 1.0 / 64);
      if (!result.ok()) {
        EXPECT_TRUE(same_bytes(state, before)) << "a failed step leaves the state as it was";
        EXPECT_LE(state.t, after + 1e-15) << "the last stage is there to round-off";
        break;
      }
      if (!state.y.allFinite()) break;
      ASSERT_GT(state.t, before.t) << "a step that goes nowhere is no success";
      ASSERT_LE(state.t, after + 1.0 / 64) << "the state stays finite although the force is no number";
    }

    for (const std::optional<std::int64_t> samples : {std::optional<std::int64_t>(), std::optional<std::int64_t>(32)}) {
      for (const bool all_states : {true, false}) {
        Schedule schedule{.t_end = 1, .dt = 1.0 / 64, .adaptive = adaptive(), .samples = samples};
        Rows seen;
        seen.all_states = all_states;
        state = system->start();
        const RunOutcome outcome = simulate(*system, *system, *integrator, state, schedule, seen);
        EXPECT_TRUE(outcome.status == RunStatus::diverged || outcome.status == RunStatus::failed);
        EXPECT_FALSE(outcome.message.empty());
        EXPECT_GT(outcome.t, after - 0.1);
        EXPECT_LE(outcome.t, adaptive() ? 1 : after + 2.0 / 64);
        EXPECT_FALSE(seen.samples.empty());
        for (const Sample& s : seen.samples) {
          EXPECT_TRUE(is_finite(s));
          EXPECT_LE(s.t, after + 1.0 / 64);
        }
        for (const State<double>& s : seen.states) EXPECT_TRUE(s.y.allFinite());
      }
    }
  });
}

// A run goes on as one that begins there after a change from outside and discard_history.
TEST_P(IntegratorLaw, DiscardedHistoryIsForgotten) {
  const double tolerance = 1e-9;
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto exact = build<Real>(trial, f);
    State<double> state = system->start();
    const auto old = make(*system, tolerance), fresh = make(*system, tolerance);
    old->begin(state);
    go(*old, state, 0.25, 16);
    const Layout::Slot& slot = system->layout().slots.front();
    state.y.segment<3>(slot.angular) += Vector3<double>(0.4, -0.3, 0.2);
    state.y.segment<2>(slot.orientation) += Eigen::Vector2d(0.02, -0.03);
    if (system->has_joints()) {  // their equations hold for rotations only
      system->project(state.y);
      project_joint_positions(*system, state.y);
      project_joint_velocities(*system, state.y);
    }
    State<double> other = state;
    const Flat end = reference_flow(*exact, state.y.cast<Real>(), 0.25L, 0.5L);
    old->discard_history(state);
    fresh->begin(other);
    go(*old, state, 0.5, 16);
    go(*fresh, other, 0.5, 16);
    if (adaptive()) {
      EXPECT_LT(difference(state.y, end), error_limit(tolerance));
      EXPECT_LT(difference(other.y, end), error_limit(tolerance));
    } else if (declared().implicit) {
      EXPECT_LT(difference(state.y, other.y), 1e-12);
    } else {
      EXPECT_TRUE(same_bytes(state, other));
    }
  });
}

TEST_P(IntegratorLaw, DenseOutputIsTheMotion) {
  const double tolerance = 1e-8;
  const auto any = build<double>(own_trials().front(), {});
  if (!make(*any, tolerance)->dense_output()) {
    EXPECT_NE(GetParam(), "odeint_dopri5") << "which has dense output";
    GTEST_SKIP() << "it has no dense output";
  }
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto exact = build<Real>(trial, f);
    const auto integrator = make(*system, tolerance);
    State<double> state = system->start(), between = state;
    integrator->begin(state);
    const DenseOutput<double>* dense = integrator->dense_output();
    ASSERT_TRUE(dense);
    State<double> before = state;
    while (state.t < 0.6) {
      before = state;
      ASSERT_TRUE(integrator->step(state, 1 - state.t).ok());
    }
    const double length = state.t - before.t;
    for (const double part : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const double t = part == 1 ? state.t : before.t + part * length;
      ASSERT_TRUE(dense->interpolate(t, between)) << part;
      EXPECT_EQ(between.t, t);
      const Flat truth = reference_flow(*exact, system->start().y.cast<Real>(), 0, Real(t));
      EXPECT_LT(difference(between.y, truth), error_limit(tolerance)) << part;
      if (part == 1) {
        EXPECT_LT(difference(between.y, state.y), 1e-14);
      } else if (part == 0) {
        EXPECT_LT(difference(between.y, before.y), 10 * tolerance);
      } else {
        // A step that ends there.
        State<double> ending = system->start();
        const auto other = make(*system, tolerance);
        other->begin(ending);
        go(*other, ending, t);
        EXPECT_LT(difference(between.y, ending.y), error_limit(tolerance)) << part;
      }
    }
    const State<double> kept = between;
    EXPECT_FALSE(dense->interpolate(state.t + 0.01 * length, between)) << "the future is not known";
    EXPECT_FALSE(dense->interpolate(before.t - 0.01 * length, between)) << "nor what was before the last step";
    EXPECT_TRUE(same_bytes(between, kept));
  });
}

// Iterations are counted from begin(), through restarts; a method that solves no equations counts none.
TEST_P(IntegratorLaw, CountsItsIterations) {
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto integrator = make(*system);
    State<double> state = system->start();
    integrator->begin(state);
    if (!integrator->iterations()) {
      EXPECT_TRUE(!declared().implicit || GetParam() == "odeint_rosenbrock4" || GetParam().starts_with("dmv"))
          << "its equations are neither linear nor those of one body";
      return;
    }
    EXPECT_TRUE(declared().implicit || declared().solves_joints());
    EXPECT_EQ(*integrator->iterations(), 0);
    go(*integrator, state, 0.25, 4);
    const std::int64_t first = *integrator->iterations();
    EXPECT_GE(first, adaptive() ? 1 : 4);
    integrator->discard_history(state);
    EXPECT_EQ(*integrator->iterations(), first) << "a restart forgets no cost";
    go(*integrator, state, 0.5, 4);
    EXPECT_GT(*integrator->iterations(), first);
    integrator->begin(state);
    EXPECT_EQ(*integrator->iterations(), 0);
  });
}

// A step goes exactly as far as required, an adaptive one at most; the end of a run is hit to the bit.
TEST_P(IntegratorLaw, TimeGoesAsAsked) {
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto integrator = make(*system);
    State<double> state = system->start();
    integrator->begin(state);
    if (!adaptive()) {
      ASSERT_TRUE(integrator->step(state, 0.1).ok());
      EXPECT_EQ(state.t, 0.1);
      ASSERT_TRUE(integrator->advance(state, 0.05, 3).ok());
      EXPECT_EQ(state.t, 0.1 + 3 * 0.05);
      return;
    }
    for (const double end : {0.1, 0.1000001, 0.3, 1.0 / 3, 0.7}) {
      go(*integrator, state, end);
      EXPECT_EQ(state.t, end);
    }
  });
}

TEST_P(IntegratorLaw, BeginMakesItNew) {
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto integrator = make(*system);
    State<double> first = system->start();
    integrator->begin(first);
    go(*integrator, first, 0.5);
    const std::int64_t evaluations = integrator->evaluations();
    State<double> second = system->start();
    integrator->begin(second);
    go(*integrator, second, 0.5);
    EXPECT_TRUE(same_bytes(first, second));
    EXPECT_EQ(integrator->evaluations(), evaluations);
  });
}

// Two runs that take turns give the digits of each alone: a method keeps nothing where another could read it.
TEST_P(IntegratorLaw, RunsDoNotDisturbEachOther) {
  for (const Formulation& f : gyroscopic_formulations()) {
    SCOPED_TRACE(label(f));
    const std::vector<Trial> all = own_trials();
    const Trial &one = all[1], &other = all.back();
    if (refuses(one.problem, f) || refuses(other.problem, f)) continue;
    const auto first = build<double>(one, f), second = build<double>(other, f);
    const auto a = make(*first), b = make(*second);
    State<double> x = first->start(), y = second->start();
    a->begin(x);
    b->begin(y);
    for (int k = 1; k <= 8; ++k) {
      go(*a, x, k / 8.0, 8);
      go(*b, y, k / 8.0, 8);
    }
    const auto alone = [&](const System<double>& system) {
      const auto integrator = make(system);
      State<double> state = system.start();
      integrator->begin(state);
      for (int k = 1; k <= 8; ++k) go(*integrator, state, k / 8.0, 8);
      return state;
    };
    EXPECT_TRUE(same_bytes(x, alone(*first)));
    EXPECT_TRUE(same_bytes(y, alone(*second)));
  }
}

TEST(IntegratorCatalogue, NamesAreUniqueAndFound) {
  for (const IntegratorEntry& e : integrator_catalogue()) EXPECT_EQ(find_integrator(e.declaration.name), &e);
  EXPECT_EQ(find_integrator("no such method"), nullptr);
}

// Settings with the same key are one option of a run.
TEST(IntegratorCatalogue, SettingsWithTheSameKeyMeanTheSame) {
  std::map<std::string, Setting> known;
  for (const IntegratorEntry& e : integrator_catalogue()) {
    for (const Setting& setting : e.declaration.settings) {
      const Setting& first = known.emplace(setting.key, setting).first->second;
      EXPECT_EQ(setting.usual.index(), first.usual.index()) << e.declaration.name << ": " << setting.key;
      EXPECT_EQ(setting.meaning, first.meaning) << e.declaration.name << ": " << setting.key;
      EXPECT_EQ(setting.unit, first.unit) << e.declaration.name << ": " << setting.key;
    }
  }
}

}  // namespace
}  // namespace polhode::laws::integrator_law_test
