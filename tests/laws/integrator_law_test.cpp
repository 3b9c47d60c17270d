// SPDX-License-Identifier: BSD-3-Clause
// The laws of an integrator: what every entry of the catalogue must keep, in every formulation, on a free problem, a
// forced one and one that depends on time. A new method needs nothing here. What it declares beyond its order is in
// integrator_trait_law_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "tests/laws/integrator_trials.hpp"
#include "tests/laws/reference_flow.hpp"

namespace polhode::laws {
namespace {

using Real = long double;
using Flat = VectorX<Real>;

class IntegratorLaw : public OverTheCatalogue {
 protected:
  template <class S>
  void expect_advance_is_single_steps() const;
  template <class S>
  void expect_precision(double round_off) const;
};

INSTANTIATE_TEST_SUITE_P(Catalogue, IntegratorLaw, testing::ValuesIn(method_names()),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(IntegratorLaw, DeclaresWhatItIs) {
  const Declaration& d = declared();
  EXPECT_FALSE(d.family.empty());
  EXPECT_FALSE(d.summary.empty());
  EXPECT_FALSE(refuses(trials().front().problem, {})) << "every method accepts a free body as it is by default";
  ASSERT_TRUE(entry().make) << "every method works in double";
  if (adaptive()) {
    EXPECT_EQ(d.evaluations_per_step, 0) << "an adaptive method counts its evaluations";
  } else {
    EXPECT_GT(d.order, 0) << "a fixed-step method has an order";
  }
}

// The declared order of a fixed-step method, from both sides: halving h divides the error by 2^p; free bodies may have
// an order of their own, or be exact.
TEST_P(IntegratorLaw, HasTheDeclaredOrder) {
  if (adaptive()) GTEST_SKIP() << "it takes a tolerance, not a step";
  const double floor = 4e-12;  // above the round-off of a run in double; multi-step methods reach their order late
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto exact = build<Real>(trial, f);
    const Flat end = reference_flow(*exact, system->start().y.cast<Real>(), 0, 1);
    const bool free = trial.problem.forces.empty() && !trial.shaken && declared().free_order > 0;
    const int expected = free ? declared().free_order : declared().order;
    if (expected == Declaration::exact_order) {
      for (const std::int64_t n : {1, 15, 240}) EXPECT_LT(difference(run(*system, 0, n).y, end), 2e-13) << n;
      return;
    }
    // Where few steps already come near the round-off of double, long double has room for the order to show.
    std::int64_t first = 15;
    double coarse = difference(run(*system, 0, first).y, end);
    const bool extended = entry().make_long_double && (expected > 4 || coarse < 1000 * floor);
    for (; !extended && coarse < 1000 * floor && first > 3; coarse = difference(run(*system, 0, first).y, end))
      first /= 2;
    double order = 0, error = 1;
    for (std::int64_t n = first; n <= 3840; n *= 2) {
      const double next = extended ? difference(run(*exact, 0, n).y, end) : difference(run(*system, 0, n).y, end);
      if (next < (extended ? 1e-15 : floor)) break;
      order = std::log2(error / next);
      error = next;
    }
    EXPECT_LT(error, 0.01) << "it does not come near the exact motion";
    EXPECT_NEAR(order, expected, 0.25) << "error " << error;
  });
}

// An adaptive method comes nearer as its tolerance falls, and stays within a factor of it.
TEST_P(IntegratorLaw, FollowsItsTolerance) {
  if (!adaptive()) GTEST_SKIP() << "it takes a step, not a tolerance";
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto exact = build<Real>(trial, f);
    const Flat end = reference_flow(*exact, system->start().y.cast<Real>(), 0, 1);
    // The slope of log error against log tolerance, by least squares.
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int k = 5; k <= 11; ++k) {  // at 1e-4 a method of order 8 takes four steps
      const double tolerance = std::pow(10, -k);
      const double error = difference(run(*system, tolerance).y, end);
      EXPECT_LT(error, 1000 * tolerance);
      const double x = -k, y = std::log10(error);
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    EXPECT_NEAR(slope, 1, 0.4) << "slope of log error against log tolerance";
  });
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

// Where the right-hand side ceases to be a number, a step fails and leaves the state as it was, or the driver sees that
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

// After a change from outside and discard_history, a run goes on as one that begins there.
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
    State<double> other = state;
    const Flat end = reference_flow(*exact, state.y.cast<Real>(), 0.25L, 0.5L);
    old->discard_history(state);
    fresh->begin(other);
    go(*old, state, 0.5, 16);
    go(*fresh, other, 0.5, 16);
    if (adaptive()) {
      EXPECT_LT(difference(state.y, end), 1000 * tolerance);
      EXPECT_LT(difference(other.y, end), 1000 * tolerance);
    } else if (declared().implicit) {
      EXPECT_LT(difference(state.y, other.y), 1e-12);
    } else {
      EXPECT_TRUE(same_bytes(state, other));
    }
  });
}

TEST_P(IntegratorLaw, DenseOutputIsTheMotion) {
  const double tolerance = 1e-8;
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto exact = build<Real>(trial, f);
    const auto integrator = make(*system, tolerance);
    State<double> state = system->start(), between = state;
    integrator->begin(state);
    if (!integrator->has_dense_output()) {
      ASSERT_TRUE(integrator->step(state, 1.0 / 64).ok());
      EXPECT_FALSE(integrator->interpolate(state.t / 2, between));
      return;
    }
    State<double> before = state;
    while (state.t < 0.6) {
      before = state;
      ASSERT_TRUE(integrator->step(state, 1 - state.t).ok());
    }
    const double length = state.t - before.t;
    for (const double part : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const double t = part == 1 ? state.t : before.t + part * length;
      ASSERT_TRUE(integrator->interpolate(t, between)) << part;
      EXPECT_EQ(between.t, t);
      const Flat truth = reference_flow(*exact, system->start().y.cast<Real>(), 0, Real(t));
      EXPECT_LT(difference(between.y, truth), 1000 * tolerance) << part;
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
        EXPECT_LT(difference(between.y, ending.y), 1000 * tolerance) << part;
      }
    }
    const State<double> kept = between;
    EXPECT_FALSE(integrator->interpolate(state.t + 0.01 * length, between)) << "the future is not known";
    EXPECT_FALSE(integrator->interpolate(before.t - 0.01 * length, between)) << "nor what was before the last step";
    EXPECT_TRUE(same_bytes(between, kept));
  });
}

// A step goes exactly as far as it was asked to, an adaptive one at most; the end of a run is hit to the bit.
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

template <class S>
void IntegratorLaw::expect_advance_is_single_steps() const {
  if (!entry().maker<S>()) return;
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<S>(trial, f);
    for (const double t0 : {0.0, 0.3}) {
      const double h = 0.007;
      State<S> at_once = system->start();
      at_once.t = t0;
      State<S> one_by_one = at_once;
      const auto a = make<S>(*system), b = make<S>(*system);
      a->begin(at_once);
      b->begin(one_by_one);
      ASSERT_TRUE(a->advance(at_once, h, 25).ok());
      for (int k = 1; k <= 25; ++k) {
        ASSERT_TRUE(b->step(one_by_one, h).ok());
        one_by_one.t = t0 + k * h;  // as the driver counts time
      }
      EXPECT_TRUE(same_bytes(at_once, one_by_one));
      EXPECT_EQ(a->evaluations(), b->evaluations());
    }
  });
}
TEST_P(IntegratorLaw, AdvanceIsSingleStepsToTheBit) {
  if (adaptive()) GTEST_SKIP() << "it chooses its steps";
  expect_advance_is_single_steps<float>();
  expect_advance_is_single_steps<double>();
  expect_advance_is_single_steps<Real>();
}

// A method that projects and measures within a stretch does it as the driver would, step by step.
TEST_P(IntegratorLaw, StretchesAreSingleStepsToTheBit) {
  if (adaptive()) GTEST_SKIP() << "it chooses its steps";
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    const auto whole = make(*system), single = make(*system);
    if (!whole->takes_stretches()) return;
    for (const bool project : {false, true}) {
      const Stretch stretch{.h = 0.007, .count = 20, .t0 = 0.25, .first = 3, .project = project};
      State<double> x = system->start();
      x.t = stretch.time(0);
      State<double> y = x;
      whole->begin(x);
      single->begin(y);
      std::vector<Sample> samples(20);
      Stretch seen = stretch;
      seen.samples = samples.data();
      ASSERT_TRUE(whole->advance(x, seen).ok());
      for (int k = 1; k <= 20; ++k) {
        ASSERT_TRUE(single->step(y, stretch.h).ok());
        y.t = 0.25 + (3 + k) * 0.007;
        double injected = 0;
        if (project) {
          const double before = system->measure(y.y).energy();
          system->project(y.y);
          single->discard_history(y);
          if (system->projection_changes_energy()) injected = system->measure(y.y).energy() - before;
        }
        EXPECT_TRUE(same_bytes(samples[std::size_t(k - 1)],
                               Sample{y.t, system->measure(y.y), y.y[system->layout().work()], injected}));
      }
      EXPECT_TRUE(same_bytes(x, y));
      EXPECT_EQ(whole->evaluations(), single->evaluations());
      State<double> unseen = system->start();
      unseen.t = stretch.time(0);
      whole->begin(unseen);
      ASSERT_TRUE(whole->advance(unseen, stretch).ok());
      EXPECT_TRUE(same_bytes(unseen, y)) << "whether anybody looks or not";
    }
  });
}

/// A method that hides that it takes stretches: the driver projects and measures for it.
class Stepwise final : public Integrator<double> {
 public:
  explicit Stepwise(IntegratorPointer<double> inner) : inner_(std::move(inner)) {}
  void begin(const State<double>& state) override { inner_->begin(state); }
  StepResult step(State<double>& state, double h) override { return inner_->step(state, h); }
  std::int64_t evaluations() const override { return inner_->evaluations(); }
  void discard_history(const State<double>& state) override { inner_->discard_history(state); }

 private:
  IntegratorPointer<double> inner_;
};

// A run shows the same digits whether the method takes its steps by stretches or one by one.
TEST_P(IntegratorLaw, TheDriverSeesTheSameWithAndWithoutStretches) {
  if (adaptive()) GTEST_SKIP() << "it chooses its steps";
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<double>(trial, f);
    for (const bool normalise : {false, true}) {
      for (const bool all_states : {false, true}) {
        const Schedule schedule{
            .t_end = 1, .dt = 0.0073, .samples = {}, .normalise = normalise};  // the last step is shortened
        const auto run = [&](Integrator<double>& integrator, Rows& rows, State<double>& state) {
          rows.all_states = all_states;
          return simulate(*system, *system, integrator, state, schedule, rows);
        };
        const auto whole = make(*system);
        Stepwise single(make(*system));
        Rows a, b;
        State<double> x = system->start(), y = x;
        const RunOutcome first = run(*whole, a, x), second = run(single, b, y);
        EXPECT_TRUE(first.status == RunStatus::ok && second.status == RunStatus::ok) << first.message << second.message;
        EXPECT_EQ(first.steps, second.steps);
        EXPECT_EQ(first.evaluations, second.evaluations);
        EXPECT_EQ(x.t, 1);
        EXPECT_TRUE(same_bytes(x, y));
        if (!normalise) {
          State<double> by_hand = system->start();
          const auto integrator = make(*system);
          integrator->begin(by_hand);
          ASSERT_TRUE(integrator->advance(by_hand, 0.0073, 136).ok());
          ASSERT_TRUE(integrator->step(by_hand, 1 - 136 * 0.0073).ok());
          EXPECT_EQ(x.y, by_hand.y);
        }
        ASSERT_EQ(a.samples.size(), b.samples.size());
        ASSERT_EQ(a.samples.size(), 138u);
        for (std::size_t k = 0; k < a.samples.size(); ++k) EXPECT_TRUE(same_bytes(a.samples[k], b.samples[k])) << k;
        ASSERT_EQ(a.states.size(), all_states ? 138u : 1u);
        for (std::size_t k = 0; k < a.states.size(); ++k) EXPECT_TRUE(same_bytes(a.states[k], b.states[k])) << k;
      }
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

// Two runs that take turns give the digits of each alone: a method keeps nothing where another could see it.
TEST_P(IntegratorLaw, RunsDoNotDisturbEachOther) {
  for (const Formulation& f : gyroscopic_formulations()) {
    SCOPED_TRACE(label(f));
    const std::vector<Trial> all = trials();
    if (refuses(all[1].problem, f) || refuses(all[4].problem, f)) continue;
    const auto first = build<double>(all[1], f), second = build<double>(all[4], f);
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

/// In S the same 60 steps, or those to a tolerance, differ from those in long double by the round-off of S, and not by
/// less.
template <class S>
void IntegratorLaw::expect_precision(double round_off) const {
  if (!entry().maker<S>() || !entry().make_long_double) return;
  double most = 0, tolerance = 1e-8;
  if (adaptive()) {
    // Steps that a method chooses differ too, each by about its tolerance.
    tolerance = 100 * double(std::numeric_limits<S>::epsilon());
    round_off = std::max(round_off, 1000 * tolerance);
  }
  everywhere([&](const Trial& trial, const Formulation& f) {
    const auto system = build<S>(trial, f);
    const auto exact = build<Real>(trial, f);
    State<S> state = system->start();
    State<Real> truth{0, state.y.template cast<Real>()};
    const auto a = make<S>(*system, tolerance);
    const auto b = make<Real>(*exact, tolerance);
    a->begin(state);
    b->begin(truth);
    go(*a, state, 1, 60, adaptive());
    go(*b, truth, 1, 60, adaptive());
    const double error = difference(state.y, truth.y);
    EXPECT_LT(error, round_off);
    most = std::max(most, error);
  });
  EXPECT_GT(most, adaptive() ? double(std::numeric_limits<S>::epsilon()) / 10 : round_off / 1e4);
}
TEST_P(IntegratorLaw, ScalarsWorkToTheirPrecision) {
  expect_precision<float>(2e-5);
  expect_precision<double>(4e-14);
  if (!entry().make_long_double || declared().order < 4 || adaptive()) return;
  // In long double the order is seen where double has long drowned in its round-off.
  const Trial trial = trials()[3];
  const auto system = build<Real>(trial, {});
  const Flat end = reference_flow(*system, system->start().y, 0, 1);
  double error = 1, order = 0;
  for (std::int64_t n = 64; n <= 16384 && error > 1e-14; n *= 2) {
    const double next = difference(run(*system, 0, n).y, end);
    order = std::log2(error / next);
    error = next;
  }
  EXPECT_LT(error, 1e-14);
  EXPECT_NEAR(order, declared().order, 0.25) << error;
}

TEST(IntegratorCatalogue, NamesAreUniqueAndFound) {
  for (const IntegratorEntry& e : integrator_catalogue()) EXPECT_EQ(find_integrator(e.declaration.name), &e);
  EXPECT_EQ(find_integrator("no such method"), nullptr);
}

// The judge of this file: twice as many steps do not change it.
TEST(ReferenceFlow, HasConverged) {
  for (const Trial& trial : trials()) {
    for (const Formulation& f : gyroscopic_formulations()) {
      const auto system = build<Real>(trial, f);
      const Flat y = system->start().y;
      EXPECT_LT(difference(reference_flow(*system, y, 0, 1), reference_flow(*system, y, 0, 1, 128)), 5e-17)
          << trial.name << ", " << label(f);
    }
  }
}

}  // namespace
}  // namespace polhode::laws
