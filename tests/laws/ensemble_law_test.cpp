// SPDX-License-Identifier: BSD-3-Clause
// The law of the ensemble: a run in a lane shows what it shows alone, to the bit, whoever its neighbours are and
// however they end.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/run/simulate_ensemble.hpp"
#include "integrators/catalogue.hpp"
#include "tests/laws/formulations.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::laws::ensemble_law_test {
namespace {

/// The n-th relative of a problem: another start, inertia and mass; other parameters of the forces where they may vary.
Problem relative(Problem p, int n, bool other_forces) {
  const double s = n;
  Body& body = p.bodies[0];
  body.inertia *= 1 + 0.125 * s;
  body.mass *= 1 + (other_forces ? 0.25 * s : 0);
  if (!other_forces) body.inertia = p.bodies[0].inertia / (1 + 0.125 * s);
  p.starts[0].position += Vector3<double>(0.1 * s, -0.2 * s, 0.05);
  p.starts[0].velocity *= 1 - 0.2 * s;
  p.starts[0].angular_velocity += Vector3<double>(0.3 * s, -0.4, 0.1 * s);
  p.starts[0].orientation = Quaternion<double>(1, 0.2 * s, -0.1, 0.3).normalized();
  if (other_forces) {
    for (ForceParameters& f : p.forces) {
      for (auto& [key, value] : f.values) {
        if (double* x = std::get_if<double>(&value)) *x *= 1 + 0.1 * s;
        if (Vector3<double>* v = std::get_if<Vector3<double>>(&value)) *v *= 1 - 0.05 * s;
      }
    }
  }
  return p;
}

struct Trial {
  std::string name;
  Problem problem;
};
std::vector<Trial> trials() {
  Problem pushed = projectile(true);
  pushed.forces.push_back(force("constant_force", {0},
                                {{"force", Vector3<double>(0.4, -0.3, 0.6)},
                                 {"frame", std::string("body")},
                                 {"anchor_body", Vector3<double>(0.2, 0.1, -0.3)}}));
  pushed.forces.push_back(force("damper", {0}, {{"damping", 0.4}, {"anchor_body", Vector3<double>(0.1, -0.3, 0.2)}}));
  pushed.forces.push_back(force("drag", {0}, {{"angular", 0.2}}));
  return {
      {"free", free_top()},         {"projectile", projectile(false)},
      {"in_air", projectile(true)}, {"pushed", pushed},
      {"spring", box_on_spring()},  {"turned", box_on_spring(turned_inertia({0.5, 0.8, 1.1}, {0.7, -0.4, 0.2, 0.5}))}};
}

/// Everything that a run shows; it looks at some states and calls a run off at `bound` energy.
struct Seen final : Observer {
  double bound = 1e300, look_every = 0.05;
  std::vector<Sample> samples{};
  std::vector<State<double>> states{};
  double next = 0;

  std::size_t on_samples(std::span<const Sample> part) override {
    for (std::size_t i = 0; i < part.size(); ++i) {
      samples.push_back(part[i]);
      if (!(std::abs(part[i].seen.energy()) < bound)) return i;
    }
    return part.size();
  }
  void on_state(const State<double>& state, const Sample&) override {
    states.push_back(state);
    next += look_every;
  }
  double next_state() const override { return next; }
};

void expect_same(const Seen& a, const Seen& b) {
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const Sample &x = a.samples[i], &y = b.samples[i];
    ASSERT_TRUE(x.t == y.t && x.work == y.work && x.projection == y.projection && x.seen.kinetic == y.seen.kinetic &&
                x.seen.potential == y.seen.potential && x.seen.orientation_defect == y.seen.orientation_defect &&
                x.seen.linear_momentum == y.seen.linear_momentum && x.seen.angular_momentum == y.seen.angular_momentum)
        << "sample " << i;
  }
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t i = 0; i < a.states.size(); ++i) {
    ASSERT_EQ(a.states[i].t, b.states[i].t);
    ASSERT_EQ(a.states[i].y, b.states[i].y) << "look " << i;
  }
}

/// Quantities of a body, as one run and as an ensemble measure them.
template <class S>
S spin(const BodySnapshot<S>& body) {
  return body.angular_momentum.norm();
}
template <class S>
S advance(const BodySnapshot<S>& body) {
  return body.velocity.dot(body.rotation * body.angular_velocity);
}

/// Measures them at every step of a run alone.
struct Watch final : Observer {
  const System<double>& system;
  Seen& seen;
  std::array<std::vector<double>, 2> values{};

  Watch(const System<double>& of, Seen& also) : system(of), seen(also) {}
  void on_start(const State<double>& state, const Sample& sample) override { seen.on_start(state, sample); }
  std::size_t on_samples(std::span<const Sample> part) override { return seen.on_samples(part); }
  void on_state(const State<double>& state, const Sample& sample) override {
    const BodySnapshot<double> body = system.snapshot(state.y, 0);
    values[0].push_back(spin(body));
    values[1].push_back(advance(body));
    if (sample.t >= seen.next_state()) seen.on_state(state, sample);
  }
  double next_state() const override { return 0; }
};

class EnsembleLaw : public testing::TestWithParam<std::string> {
 protected:
  /// Runs the problems alone and together, and compares.
  void expect_same_digits(const std::vector<Problem>& problems, const Formulation& f, const Schedule& schedule,
                          double bound = 1e300) const {
    const IntegratorEntry& entry = *find_integrator(GetParam());
    std::vector<std::unique_ptr<System<double>>> systems;
    std::vector<Seen> together(problems.size());
    std::vector<std::array<std::vector<double>, 2>> watched(problems.size());
    std::vector<LaneRun> runs;
    for (std::size_t i = 0; i < problems.size(); ++i) {
      systems.push_back(make_system<double>(problems[i], f));
      ASSERT_FALSE(lane_key(*systems[i]).empty());
      ASSERT_EQ(lane_key(*systems[i]), lane_key(*systems[0]));
      together[i].bound = bound;
      runs.push_back({*systems[i], together[i], [&watched, i](std::size_t which, std::span<const double> values) {
                        watched[i][which].insert(watched[i][which].end(), values.begin(), values.end());
                      }});
    }
    std::vector<Problem> padded = problems;
    padded.resize(std::size_t(lane_count), problems.back());
    const auto ensemble = make_ensemble(padded, f);
    const auto method = entry.make_lanes(*ensemble, {.dt = schedule.dt, .t_end = schedule.t_end});
    const LaneQuantity quantities[] = {spin<Lanes>, advance<Lanes>};
    const auto outcomes = simulate_ensemble(*ensemble, *method, runs, schedule, nullptr, quantities);
    ASSERT_EQ(outcomes.size(), problems.size());
    for (std::size_t i = 0; i < problems.size(); ++i) {
      SCOPED_TRACE("lane " + std::to_string(i));
      Seen alone;
      alone.bound = bound;
      const auto own = entry.make(*systems[i], {.dt = schedule.dt, .t_end = schedule.t_end});
      State<double> state = systems[i]->start();
      Watch watch(*systems[i], alone);
      const RunOutcome outcome = simulate(*systems[i], *systems[i], *own, state, schedule, watch);
      EXPECT_EQ(outcomes[i].status, outcome.status);
      EXPECT_EQ(outcomes[i].message, outcome.message);
      EXPECT_EQ(outcomes[i].t, outcome.t);
      EXPECT_EQ(outcomes[i].steps, outcome.steps);
      EXPECT_EQ(outcomes[i].evaluations, outcome.evaluations);
      expect_same(together[i], alone);
      EXPECT_EQ(watched[i], watch.values);
    }
  }
};

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const IntegratorEntry& e : integrator_catalogue()) {
    if (e.make_lanes) all.push_back(e.declaration.name);
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(Catalogue, EnsembleLaw, testing::ValuesIn(names()),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(EnsembleLaw, ShowsWhatARunAloneShows) {
  for (const Trial& trial : trials()) {
    for (const Formulation& f : all_formulations()) {
      for (const bool other_forces : {false, true}) {
        for (const bool normalize : {false, true}) {
          SCOPED_TRACE(trial.name + ", " + label(f) + (other_forces ? ", other forces" : "") +
                       (normalize ? ", step" : ""));
          std::vector<Problem> problems;
          for (int i = 0; i < std::min(lane_count, 3); ++i)
            problems.push_back(relative(trial.problem, i, other_forces));
          // A last step that is shortened, and one that is not.
          expect_same_digits(problems, f,
                             {.t_end = 0.5, .dt = normalize ? 0.007 : 0.005, .samples = {}, .normalize = normalize});
        }
      }
    }
  }
}

TEST_P(EnsembleLaw, ALaneMayEndBeforeItsNeighbours) {
  std::vector<Problem> problems;
  for (int i = 0; i < lane_count; ++i) problems.push_back(relative(box_on_spring(), i % 2, false));
  problems[0].starts[0].velocity = {1e3, 0, 0};                // beyond the bound at once
  problems[1].starts[0].angular_velocity = {1e200, 1e200, 1};  // overflows
  expect_same_digits(problems, {}, {.t_end = 1, .dt = 0.01, .samples = {}, .normalize = true}, 1e5);
}

TEST(Ensemble, ItsKeyTellsWhatFitsTogether) {
  const auto key = [](const Problem& p) { return lane_key(*make_system<double>(p, {})); };
  EXPECT_EQ(key(free_top()), key(relative(free_top(), 2, true)));
  EXPECT_NE(key(free_top()), key(box_on_spring()));
  EXPECT_NE(key(box_on_spring()), key(box_on_spring(turned_inertia({0.5, 0.8, 1.1}, {0.7, -0.4, 0.2, 0.5}))));
  EXPECT_EQ(key(heavy_top()), "") << "pinned";
  EXPECT_EQ(key(two_bodies()), "");
}

}  // namespace
}  // namespace polhode::laws::ensemble_law_test
