// SPDX-License-Identifier: BSD-3-Clause
// A run of a jointed problem, with the results that its tests read: the end, the ledger and the gaps of the joints.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/run/simulate.hpp"
#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "core/system/joint_reactions.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::joints_tests {

using Vector = Vector3<double>;

struct End {
  std::unique_ptr<System<double>> system;
  State<double> state;
  Sample last;
  double largest_drift = 0;
  double largest_gap = 0;
  VectorX<double> multipliers{};  ///< multipliers of the method at the last state; empty: they follow from the state

  Vector point(std::size_t body, const Vector& in_body) const { return motion(body).point(in_body); }
  BodyMotion<double> motion(std::size_t body) const { return system->motion_of(state.y, body); }
};

/// Keeps the ledger and the gaps of the joints.
class Watch final : public Observer {
 public:
  explicit Watch(End& end) : end_(end) {}
  std::size_t on_samples(std::span<const Sample> samples) override {
    for (const Sample& s : samples) {
      if (s.t == 0) start_ = s.ledger(0);
      end_.largest_drift = std::max(end_.largest_drift, std::abs(s.ledger(0) - start_));
    }
    end_.last = samples.back();
    return samples.size();
  }
  void on_state(const State<double>& state, const Sample&) override {
    const auto motions = motions_of(*end_.system, state.y);
    for (std::size_t i = 0; i < end_.system->constraints()->count(); ++i) {
      const auto v = end_.system->constraints()->violation(i, motions);
      end_.largest_gap = std::max({end_.largest_gap, v.position, v.angle});
    }
  }
  void on_multipliers(std::span<const double> multipliers) override {
    end_.multipliers = Eigen::Map<const VectorX<double>>(multipliers.data(), Eigen::Index(multipliers.size()));
  }
  double next_state() const override { return 0; }

 private:
  End& end_;
  double start_ = 0;
};

/// A run. dt is the tolerance of adaptive methods.
inline End run(const Problem& problem, double dt, double t_end, Stabilization stabilization = Stabilization::both,
               AngularState angular = AngularState::velocity_world, const std::string& method = "rk4") {
  Formulation f{.angular_state = angular};
  f.joints.stabilization = stabilization;
  End end{make_system<double>(problem, f), {}, {}};
  end.state = end.system->start();
  const IntegratorEntry& entry = *find_integrator(method);
  const auto integrator = entry.make(*end.system, {.dt = dt, .tolerance = dt, .t_end = t_end});
  Schedule schedule;
  schedule.t_end = t_end;
  schedule.dt = dt;
  schedule.adaptive = entry.declaration.adaptive;
  Watch watch(end);
  const RunOutcome outcome = simulate<double>(*end.system, *end.system, *integrator, end.state, schedule, watch);
  EXPECT_EQ(outcome.status, RunStatus::ok) << outcome.message;
  return end;
}

/// Force (N) of a joint on its first body at the end, by the multipliers of the method or those of the index-1 form.
inline Vector reaction(const End& end, std::size_t joint) {
  return joint_reactions(*end.system, end.state.t, end.state.y, end.multipliers)[joint].force;
}

inline Problem problem_of(const std::string& scenario) { return ScenarioSource::open(scenario).resolve().problem; }

inline End run(const std::string& scenario, double dt, double t_end, Stabilization stabilization = Stabilization::both,
               AngularState angular = AngularState::velocity_world, const std::string& method = "rk4") {
  return run(problem_of(scenario), dt, t_end, stabilization, angular, method);
}

}  // namespace polhode::study::joints_tests
