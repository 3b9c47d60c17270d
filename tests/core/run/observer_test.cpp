// SPDX-License-Identifier: BSD-3-Clause
// Observers side by side: each receives what it would receive alone, and a run has one explicit start.
#include "core/run/observer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/run/simulate.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::observer_test {
namespace {

/// Writes down what it receives; its next state is due every `interval` (s).
class Diary final : public Observer {
 public:
  explicit Diary(double interval) : interval_(interval) {}

  void on_start(const State<double>& state, const Sample&) override { note("start", state.t); }
  std::size_t on_samples(std::span<const Sample> samples) override {
    std::size_t accepted = 0;
    for (const Sample& sample : samples) {
      note("sample", sample.t);
      ++accepted;
      if (sample.t >= refuses_from) break;
    }
    return accepted;
  }
  void on_state(const State<double>& state, const Sample& sample) override {
    EXPECT_EQ(state.t, sample.t);
    note("state", state.t);
    next_ = state.t + interval_;
  }
  double next_state() const override { return next_; }
  void on_impacts(std::span<const Impact> impacts) override { note("impacts", double(impacts.size())); }
  void on_slides_end(std::span<const Transition> transitions) override { note("slides", double(transitions.size())); }
  void on_contact_energy(const ContactLosses& losses) override { note("losses", losses.total()); }

  double refuses_from = std::numeric_limits<double>::infinity();  ///< s
  std::vector<std::string> lines;

 private:
  void note(const std::string& what, double number) { lines.push_back(what + " " + std::to_string(number)); }

  double interval_, next_ = 0;
};

/// A free body from t0 (s) to 1 s in steps of 1/64 s.
RunOutcome run(Observer& observer, double t0) {
  Problem problem;
  problem.bodies.emplace_back();
  problem.starts.emplace_back();
  const auto system = make_system<double>(problem, {});
  const auto method = find_integrator("rk4")->maker<double>()(*system, {.dt = 1.0 / 64});
  State<double> state = system->start();
  state.t = t0;
  return simulate(*system, *system, *method, state, {.t_end = 1, .dt = 1.0 / 64, .samples = {}}, observer);
}

TEST(Observers, ReceiveSideBySideWhatTheyReceiveAlone) {
  for (const double t0 : {0.0, 0.25}) {
    Diary often(0), seldom(0.1), never(2);
    run(often, t0), run(seldom, t0), run(never, t0);
    Diary a(0), b(0.1), c(2);
    Observers all;
    for (Diary* one : {&b, &a, &c}) all.add(*one);
    EXPECT_EQ(run(all, t0).status, RunStatus::ok);
    EXPECT_EQ(a.lines.front(), "start " + std::to_string(t0));
    EXPECT_EQ(std::count(a.lines.begin(), a.lines.end(), a.lines.front()), 1);
    EXPECT_GT(a.lines.size(), b.lines.size());
    EXPECT_GT(b.lines.size(), c.lines.size());
    // Batches end where a state is due: the samples are the same, and so are the states.
    const auto only = [](const Diary& diary, const std::string& what) {
      std::vector<std::string> found;
      for (const std::string& line : diary.lines) {
        if (line.starts_with(what)) found.push_back(line);
      }
      return found;
    };
    for (const auto& [alone, together] : {std::pair(&often, &a), std::pair(&seldom, &b), std::pair(&never, &c)}) {
      for (const char* what : {"start", "sample", "state"}) EXPECT_EQ(only(*alone, what), only(*together, what));
    }
  }
}

TEST(Observers, PassOnEveryEvent) {
  Diary a(0), b(1);
  Observers all;
  all.add(a), all.add(b);
  all.on_impacts(std::vector<Impact>(2));
  all.on_slides_end(std::vector<Transition>(3));
  all.on_contact_energy({.impact = 4});
  const std::vector<std::string> expected = {"impacts 2.000000", "slides 3.000000", "losses 4.000000"};
  EXPECT_EQ(a.lines, expected);
  EXPECT_EQ(b.lines, expected);
}

TEST(Observers, TheStrictestEndsTheRun) {
  Diary patient(2), strict(2);
  strict.refuses_from = 0.5;
  Observers all;
  all.add(strict), all.add(patient);
  const RunOutcome outcome = run(all, 0);
  EXPECT_EQ(outcome.status, RunStatus::diverged);
  Diary alone(2);
  alone.refuses_from = 0.5;
  EXPECT_EQ(run(alone, 0).steps, outcome.steps);
}

}  // namespace
}  // namespace polhode::observer_test
