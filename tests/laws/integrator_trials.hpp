// SPDX-License-Identifier: BSD-3-Clause
// The common parts of the laws of integrators: the problems on which a method is tried, in every formulation that it
// accepts, and how it is run there.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/run/simulate.hpp"
#include "integrators/catalogue.hpp"
#include "tests/laws/formulations.hpp"
#include "tests/laws/probe_forces.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::laws {

/// A problem of the trials, each over one second.
struct Trial {
  std::string name;
  Problem problem;
  bool shaken = false;  ///< a force that depends on time acts
};
inline std::vector<Trial> trials() {
  return {{"free", free_top()},
          {"forced", box_on_spring()},
          {"forced_many", five_bodies()},
          {"shaken", box_on_spring(turned_inertia({0.5, 0.8, 1.1}, {0.7, -0.4, 0.2, 0.5})), true},
          {"shaken_pinned", heavy_top(), true}};
}

/// The problems of a method that solves the equations of joints itself.
inline std::vector<Trial> jointed_trials() {
  return {{"jointed", jointed_rods()}, {"jointed_shaken", jointed_rods(), true}};
}

template <class S>
std::unique_ptr<System<S>> build(const Trial& trial, const Formulation& formulation) {
  auto system = make_system<S>(trial.problem, formulation);
  if (trial.shaken) system->add_force(std::make_unique<Shaking<S>>(trial.problem.moving()));
  return system;
}

/// The largest difference of two states, relative to 1 + the largest number of the second.
template <class A, class B>
double difference(const A& a, const B& b) {
  const VectorX<long double> x = a.template cast<long double>(), y = b.template cast<long double>();
  return double((x - y).cwiseAbs().maxCoeff() / (1 + y.cwiseAbs().maxCoeff()));
}

template <class S>
bool same_bytes(const State<S>& a, const State<S>& b) {
  return a.t == b.t && a.y.size() == b.y.size() && (a.y.array() == b.y.array()).all();
}

inline bool same_bytes(const Sample& a, const Sample& b) {
  return a.t == b.t && a.work == b.work && a.projection == b.projection && a.seen.kinetic == b.seen.kinetic &&
         a.seen.potential == b.seen.potential && a.seen.orientation_defect == b.seen.orientation_defect &&
         a.seen.linear_momentum == b.seen.linear_momentum && a.seen.angular_momentum == b.seen.angular_momentum;
}

/// Keeps what a run shows: every sample, and the states.
struct Rows final : Observer {
  bool all_states = true;  ///< all states are kept; false: the first alone
  std::vector<Sample> samples{};
  std::vector<State<double>> states{};
  std::size_t on_samples(std::span<const Sample> seen) override {
    samples.insert(samples.end(), seen.begin(), seen.end());
    return seen.size();
  }
  void on_state(const State<double>& state, const Sample&) override { states.push_back(state); }
  double next_state() const override { return all_states ? 0 : std::numeric_limits<double>::infinity(); }
};

inline bool is_finite(const Sample& s) {
  return std::isfinite(s.t + s.seen.kinetic + s.seen.potential + s.seen.orientation_defect + s.work + s.projection) &&
         s.seen.linear_momentum.allFinite() && s.seen.angular_momentum.allFinite();
}

/// A law over all entries of the catalogue: its parameter is the name of a method.
class OverTheCatalogue : public testing::TestWithParam<std::string> {
 protected:
  const IntegratorEntry& entry() const { return *find_integrator(GetParam()); }
  const Declaration& declared() const { return entry().declaration; }
  bool adaptive() const { return declared().adaptive; }

  /// True where the method says that it makes no sense.
  bool refuses(const Problem& problem, const Formulation& f) const {
    return entry().refusal && !entry().refusal(problem, f).empty();
  }

  std::vector<Trial> own_trials() const { return declared().solves_joints() ? jointed_trials() : trials(); }

  /// The largest error after a second of an adaptive method. Index 3 leaves the velocities out of its error test.
  double error_limit(double tolerance) const {
    if (declared().joints == JointEquations::position) return 1e6 * tolerance;
    return (declared().solves_joints() ? 4000 : 1000) * tolerance;
  }

  /// check(trial, formulation), in every formulation that is true to the body and that the method accepts.
  template <class Check>
  void everywhere(const Check& check) const {
    for (const Trial& trial : own_trials()) {
      for (const Formulation& f : gyroscopic_formulations()) {
        if (refuses(trial.problem, f)) continue;
        // Joints are about rotations, which a quaternion that is not of unit length is not if it is taken as stored.
        if (declared().solves_joints() && f.rotation_from == RotationFrom::stored) continue;
        SCOPED_TRACE(GetParam() + ", " + trial.name + ", " + label(f));
        check(trial, f);
      }
    }
  }

  template <class S = double>
  IntegratorPointer<S> make(const System<S>& system, double tolerance = 1e-8, double t_end = 1) const {
    return entry().maker<S>()(system, {.dt = 1.0 / 64, .tolerance = tolerance, .t_end = t_end});
  }

  /// Advances to t_end as the driver does: whole steps of h, or the steps of the method.
  template <class S>
  static void go(Integrator<S>& integrator, State<S>& state, double t_end, std::int64_t fixed_steps, bool adaptive) {
    if (!adaptive) {
      const double h = (t_end - state.t) / double(fixed_steps);
      ASSERT_TRUE(integrator.advance(state, h, fixed_steps).ok());
      state.t = t_end;
      return;
    }
    for (int steps = 0; state.t < t_end; ++steps) {
      const double before = state.t;
      const StepResult result = integrator.step(state, t_end - state.t);
      ASSERT_TRUE(result.ok()) << result.failure;
      ASSERT_GT(state.t, before);
      ASSERT_LE(state.t, t_end);
      ASSERT_LT(steps, 1000000);
    }
  }
  void go(Integrator<double>& integrator, State<double>& state, double t_end, std::int64_t fixed_steps = 60) const {
    go(integrator, state, t_end, fixed_steps, adaptive());
  }

  /// The state of a run of one second from the start of the trial.
  template <class S>
  State<S> run(const System<S>& system, double tolerance, std::int64_t fixed_steps = 60) const {
    State<S> state = system.start();
    const auto integrator = make<S>(system, tolerance);
    integrator->begin(state);
    go(*integrator, state, 1, fixed_steps, adaptive());
    return state;
  }
};

inline std::vector<std::string> method_names() {
  std::vector<std::string> all;
  for (const IntegratorEntry& e : integrator_catalogue()) all.push_back(e.declaration.name);
  return all;
}

}  // namespace polhode::laws
