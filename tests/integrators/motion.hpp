// SPDX-License-Identifier: BSD-3-Clause
// A run that a test steps by hand, and the problems of the papers.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "integrators/catalogue.hpp"
#include "tests/laws/formulations.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::by_hand {

using V3 = Vector3<double>;

class Motion {
 public:
  Motion(const std::string& method, const Problem& problem, const Formulation& formulation)
      : system_(make_system<double>(problem, formulation)),
        integrator_(find_integrator(method)->make(*system_, {})),
        state_(system_->start()) {
    integrator_->begin(state_);
  }

  /// n steps of h; the time is k h as the driver counts it.
  void steps(double h, std::int64_t n = 1, bool project = false) {
    const double t = state_.t;
    const StepResult result = integrator_->advance(state_, {.h = h, .count = n, .t0 = t, .project = project});
    if (!result.ok()) ADD_FAILURE() << result.failure;
    state_.t = t + double(n) * h;
  }

  State<double>& state() { return state_; }
  System<double>& system() { return *system_; }
  BodySnapshot<double> body() const { return system_->snapshot(state_.y, 0); }
  Measurement<double> measure() const { return system_->measure(state_.y); }
  double energy() const { return measure().energy(); }
  VectorX<double> rate() const {
    VectorX<double> dy(state_.y.size());
    system_->rate(state_.t, state_.y.data(), dy.data());
    return dy;
  }

  // The first body.

  const Layout::Slot& slot() const { return system_->layout().slots.front(); }
  V3 angular_state() const { return state_.y.segment<3>(slot().angular); }
  V3 position() const { return state_.y.segment<3>(slot().position); }
  V3 velocity() const { return state_.y.segment<3>(slot().velocity); }
  Quaternion<double> quaternion() const { return state_.y.segment<4>(slot().orientation); }
  Matrix3<double> matrix() const { return Eigen::Map<const Matrix3<double>>(state_.y.data() + slot().orientation); }
  /// The nearest rotation, as a unit quaternion.
  Quaternion<double> attitude() const {
    VectorX<double> y = state_.y;
    system_->project(y);
    return system_->snapshot(y, 0).orientation;
  }
  /// L in body axes.
  V3 body_momentum() const { return body().rotation.transpose() * body().angular_momentum; }

 private:
  std::unique_ptr<System<double>> system_;
  IntegratorPointer<double> integrator_;
  State<double> state_;
};

constexpr Formulation world_quaternion{};
constexpr Formulation body_quaternion{Orientation::quaternion, AngularState::velocity_body};
constexpr Formulation body_matrix{Orientation::matrix, AngularState::velocity_body};

/// Hairer & Vilmart 2006, asymmetric body, and where it is at t = 10.
inline Problem hairer_vilmart() {
  Problem p = laws::free_top();
  p.starts[0].velocity.setZero();
  return p;
}
inline const V3 hairer_vilmart_end(1.765962508518208, -0.695464197033089, 0.779554981481872);
inline const Quaternion<double> hairer_vilmart_turn(-0.736061364160794, -0.570786951240351, -0.299388571830790,
                                                    -0.206839086104673);

/// Simo & Wong 1991: a fast heavy symmetric top, J = (5, 5, 1) about its pivot, m g l = 20.
inline Problem simo_wong_top() {
  Problem p;
  p.bodies.push_back(
      {.name = "top", .mass = 1, .inertia = laws::diagonal(5, 5, 1), .pinned = true, .center_of_mass = {0, 0, 2}});
  p.starts.push_back({.orientation = quaternion_from_rotation_vector<double>(V3(0.05, 0, 0)),
                      .angular_velocity = {0, 0, 50},
                      .angular_velocity_in_body = true});
  p.forces.push_back(laws::force("uniform_gravity", {0}, {{"acceleration", V3(0, 0, -10)}}));
  return p;
}

/// Peters & Hsu, the free-floating box, complex case.
inline Problem peters_hsu() {
  Problem p;
  p.bodies.push_back({.name = "box", .mass = 10, .inertia = laws::diagonal(0.80833333, 0.68333333, 0.14166667)});
  p.starts.push_back({.velocity = {-2, 2, 8}, .angular_velocity = {0.1, 5, 0.1}});
  p.forces.push_back(laws::force("uniform_gravity", {0}, {{"acceleration", V3(0, 0, -9.8)}}));
  return p;
}

/// A mass on a spring of no rest length at its centre: k/m = rate².
inline Problem oscillator(double rate) {
  Problem p;
  p.bodies.push_back({.name = "mass", .mass = 0.5});
  p.starts.push_back({.position = {0.3, -0.4, 0.2}, .velocity = {0.5, 0.1, -0.7}});
  p.forces.push_back(laws::force("spring", {0}, {{"stiffness", 0.5 * rate * rate}}));
  return p;
}

/// The formulations that give the true motion and that the method accepts.
inline std::vector<Formulation> accepted(const IntegratorEntry& entry, const Problem& problem) {
  std::vector<Formulation> all = laws::gyroscopic_formulations();
  std::erase_if(all, [&](const Formulation& f) { return entry.refusal && !entry.refusal(problem, f).empty(); });
  return all;
}

}  // namespace polhode::by_hand
