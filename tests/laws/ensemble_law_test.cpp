// SPDX-License-Identifier: BSD-3-Clause
// The law of the ensemble: a run in a lane shows what it shows alone, to the bit, whoever its neighbours are, however
// they end and whoever had the lane before.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
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

/// Keeps everything that a run shows, and some states; it stops a run at `bound` energy.
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
S spin(const BodyMotion<S>&, const Vector3<S>& angular_momentum) {
  return angular_momentum.norm();
}
template <class S>
S advance(const BodyMotion<S>& body, const Vector3<S>&) {
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
    const BodyMotion<double> body = system.motion_of(state.y, 0);
    const Vector3<double> momentum = system.snapshot(state.y, 0).angular_momentum;
    values[0].push_back(spin(body, momentum));
    values[1].push_back(advance(body, momentum));
    if (sample.t >= seen.next_state()) seen.on_state(state, sample);
  }
  double next_state() const override { return 0; }
};

/// A run that is carried out alone and in a lane.
struct OneRun {
  Problem problem;
  Schedule schedule;
};

/// Shows each run of an ensemble to an observer of its own.
class Apart final : public EnsembleObserver {
 public:
  struct OfRun {
    Seen seen;
    std::array<std::vector<double>, 2> watched{};
    RunOutcome outcome{};
    double seconds = -1;
  };

  Apart(const std::vector<OneRun>& runs, const std::vector<std::unique_ptr<System<double>>>& systems, double bound)
      : runs_(runs), systems_(systems), all_(runs.size()) {
    for (OfRun& one : all_) one.seen.bound = bound;
  }

  std::optional<LaneRun> next(std::size_t lane) {
    if (begun_ == runs_.size()) return std::nullopt;
    run_in_[lane] = begun_++;
    return LaneRun{systems_[run_in_[lane]].get(), runs_[run_in_[lane]].schedule};
  }

  Observer& of_lane(std::size_t lane) override { return in(lane).seen; }
  void on_begin(std::size_t) override {}
  void on_samples(const LaneBlock& block, std::span<const bool> running, std::span<std::size_t> accepted) override {
    for (std::size_t lane = 0; lane < running.size(); ++lane) {
      if (!running[lane]) {
        EXPECT_EQ(accepted[lane], 0u);
        continue;
      }
      std::vector<Sample> samples;
      for (const LaneSample& all : block.samples.first(accepted[lane])) samples.push_back(sample_in(all, int(lane)));
      accepted[lane] = in(lane).seen.on_samples(samples);
      for (std::size_t which = 0; which < block.watched.size(); ++which) {
        for (const Lanes& value : block.watched[which].first(accepted[lane]))
          in(lane).watched[which].push_back(value[int(lane)]);
      }
    }
  }
  /// Takes the states of every second lane, so that the observers of the others receive theirs alone.
  void on_states(const LaneStates& states, std::span<bool> due) override {
    EXPECT_TRUE(std::any_of(due.begin(), due.end(), [](bool is) { return is; }));
    for (std::size_t lane = 0; lane < due.size(); lane += 2) {
      if (!due[lane]) continue;
      const auto in_lane = [&](const Lanes& x) { return x[int(lane)]; };
      in(lane).seen.on_state({in_lane(states.sample.t), states.y.unaryExpr(in_lane)},
                             sample_in(states.sample, int(lane)));
      due[lane] = false;
    }
  }
  void on_end(std::size_t lane, RunOutcome&& outcome, double seconds) override {
    EXPECT_LT(in(lane).seconds, 0) << "a run ends once";
    in(lane).outcome = std::move(outcome);
    in(lane).seconds = seconds;
  }

  const OfRun& of_run(std::size_t run) const { return all_[run]; }

 private:
  OfRun& in(std::size_t lane) { return all_[run_in_[lane]]; }

  const std::vector<OneRun>& runs_;
  const std::vector<std::unique_ptr<System<double>>>& systems_;
  std::vector<OfRun> all_;
  std::array<std::size_t, std::size_t(lane_count)> run_in_{};
  std::size_t begun_ = 0;
};

class EnsembleLaw : public testing::TestWithParam<std::string> {
 protected:
  /// Carries the runs out alone and together, and compares.
  void expect_same_digits(const std::vector<OneRun>& runs, const Formulation& f, double bound = 1e300) const {
    const IntegratorEntry& entry = *find_integrator(GetParam());
    std::vector<std::unique_ptr<System<double>>> systems;
    for (const OneRun& run : runs) {
      systems.push_back(make_system<double>(run.problem, f));
      ASSERT_FALSE(lane_key(run.problem).empty());
      ASSERT_EQ(lane_key(run.problem), lane_key(runs[0].problem));
    }
    Apart together(runs, systems, bound);
    const EnsembleParts parts = {.next = [&](std::size_t lane) { return together.next(lane); },
                                 .method = [&](const System<Lanes>& system) { return entry.make_lanes(system, {}); },
                                 .watched =
                                     [](std::span<const Problem>) {
                                       return std::vector<LaneQuantity>{spin<Lanes>, advance<Lanes>};
                                     }};
    simulate_ensemble(parts, together);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      SCOPED_TRACE("run " + std::to_string(i));
      const Schedule& schedule = runs[i].schedule;
      Seen alone;
      alone.bound = bound;
      const auto own = entry.make(*systems[i], {.dt = schedule.dt, .t_end = schedule.t_end});
      State<double> state = systems[i]->start();
      Watch watch(*systems[i], alone);
      const RunOutcome outcome = simulate(*systems[i], *systems[i], *own, state, schedule, watch);
      const Apart::OfRun& in_lane = together.of_run(i);
      EXPECT_EQ(in_lane.outcome.status, outcome.status);
      EXPECT_EQ(in_lane.outcome.message, outcome.message);
      EXPECT_EQ(in_lane.outcome.t, outcome.t);
      EXPECT_EQ(in_lane.outcome.steps, outcome.steps);
      EXPECT_EQ(in_lane.outcome.evaluations, outcome.evaluations);
      EXPECT_GE(in_lane.seconds, 0);
      expect_same(in_lane.seen, alone);
      EXPECT_EQ(in_lane.watched, watch.values);
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
          std::vector<OneRun> runs;
          // A last step that is shortened, and one that is not.
          const Schedule schedule{.t_end = 0.5, .dt = normalize ? 0.007 : 0.005, .samples = {}, .normalize = normalize};
          for (int i = 0; i < std::min(lane_count, 3); ++i)
            runs.push_back({relative(trial.problem, i, other_forces), schedule});
          expect_same_digits(runs, f);
        }
      }
    }
  }
}

TEST_P(EnsembleLaw, ALaneMayEndBeforeItsNeighbours) {
  std::vector<OneRun> runs;
  for (int i = 0; i < lane_count; ++i) {
    runs.push_back(
        {relative(box_on_spring(), i % 2, false), {.t_end = 1, .dt = 0.01, .samples = {}, .normalize = true}});
  }
  runs[0].problem.starts[0].velocity = {1e3, 0, 0};                // beyond the bound at once
  runs[1].problem.starts[0].angular_velocity = {1e200, 1e200, 1};  // overflows
  expect_same_digits(runs, {}, 1e5);
}

TEST_P(EnsembleLaw, ALanePassesFromOneRunToTheNext) {
  for (const Formulation& f : all_formulations()) {
    SCOPED_TRACE(label(f));
    std::vector<OneRun> runs;
    for (int i = 0; i < std::max(3 * lane_count, 12) + 1; ++i) {
      // Steps and durations of each run's own; the last step of most is shorter.
      const Schedule schedule{
          .t_end = 0.2 + 0.07 * (i % 5), .dt = 0.003 + 0.0011 * (i % 7), .samples = {}, .normalize = true};
      runs.push_back({relative(box_on_spring(), i, i % 3 == 0), schedule});
    }
    runs[2].problem.starts[0].velocity = {1e3, 0, 0};  // beyond the bound at once, before its lane has moved
    runs[5].schedule.dt = 1;                           // longer than the run
    runs[7].problem.starts[0].angular_velocity = {1e200, 1e200, 1};
    runs.back().problem.starts[0].angular_velocity = {40, 1e3, 30};  // beyond it later
    expect_same_digits(runs, f, 1e5);
  }
}

TEST_P(EnsembleLaw, StopsAllRunsWhenItIsTold) {
  const auto system = make_system<double>(box_on_spring(), {});
  std::vector<OneRun> runs(std::size_t(lane_count) + 3, {box_on_spring(), {.t_end = 1, .dt = 0.01, .samples = {}}});
  std::vector<std::unique_ptr<System<double>>> systems;
  for (const OneRun& run : runs) systems.push_back(make_system<double>(run.problem, {}));
  Apart together(runs, systems, 1e300);
  const std::atomic<bool> stop = true;
  simulate_ensemble(
      {.next = [&](std::size_t lane) { return together.next(lane); },
       .method = [&](const System<Lanes>& in_lanes) { return find_integrator(GetParam())->make_lanes(in_lanes, {}); }},
      together, &stop);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(together.of_run(i).seconds >= 0, i < std::size_t(lane_count)) << i << ": others do not begin";
    if (i < std::size_t(lane_count)) {
      EXPECT_EQ(together.of_run(i).outcome.status, RunStatus::interrupted);
    }
  }
}

TEST(Ensemble, ItsKeyTellsWhatFitsTogether) {
  EXPECT_EQ(lane_key(free_top()), lane_key(relative(free_top(), 2, true)));
  EXPECT_NE(lane_key(free_top()), lane_key(box_on_spring()));
  EXPECT_NE(lane_key(box_on_spring()), lane_key(box_on_spring(turned_inertia({0.5, 0.8, 1.1}, {0.7, -0.4, 0.2, 0.5}))));
  EXPECT_EQ(lane_key(heavy_top()), "") << "pinned";
  EXPECT_EQ(lane_key(two_bodies()), "");
}

}  // namespace
}  // namespace polhode::laws::ensemble_law_test
