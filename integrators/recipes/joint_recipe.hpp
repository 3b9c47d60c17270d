// SPDX-License-Identifier: BSD-3-Clause
// Common part of the recipes of engines for joints. Engines keep every body in maximal coordinates, a quaternion and
// the angular velocity in the world. A step of h is cut into substeps; each changes the velocities by the forces, then
// by impulses of the joints that are found row by row or together, and moves the bodies with the new velocities.
#pragma once

#include <cmath>
#include <string>

#include "core/system/constraint_solver.hpp"
#include "integrators/joints/joint_method.hpp"
#include "integrators/joints/joint_refusal.hpp"
#include "integrators/recipes/engine_recipe.hpp"

namespace polhode::inline integrators {

/// Number of substeps of a step; an engine has its own usual value.
inline Setting substeps_of_engine(std::int64_t usual) {
  return {.key = "substeps",
          .usual = usual,
          .meaning = "into which an engine recipe cuts a step",
          .lowest = 1,
          .highest = 1000};
}

/// Number of sweeps over the joints in a substep; an engine has its own usual value.
inline Setting iterations_of_engine(std::int64_t usual) {
  return {.key = "iterations",
          .usual = usual,
          .meaning = "over the joints in each substep of an engine recipe",
          .lowest = 1,
          .highest = 100000};
}

class JointRecipe : public JointMethod {
 protected:
  using Twists = std::vector<Wrench<double>>;  ///< (v, ω) of the moving bodies in world axes: m/s, rad/s

  JointRecipe(const System<double>& system, std::int64_t substeps)
      : JointMethod(system),
        substeps_(substeps),
        none_(VectorX<double>::Zero(Eigen::Index(joints_.rows()))),
        rate_(bodies_.zero()),
        step_(bodies_.zero_tangent()) {
    impulses_.resize(system.problem().bodies.size());
  }

  void begin(const State<double>& state) override {
    evaluations_ = 0;
    discard_history(state);
  }
  /// The multipliers at the start are those of the index-1 form.
  void discard_history(const State<double>& state) override {
    bodies_.rate(state.t, state.y, rate_);
    ++evaluations_;
    lambda_ = joints_.multipliers();
  }

  /// Advances y by a substep of h, and sets lambda_ to the impulses of the joints divided by h.
  virtual void substep(double t, double h, Flat& y) = 0;

  /// Adds h M⁻¹ f, and nothing of the joints, to the velocities.
  void add_forces(double t, double h, Flat& y) {
    const PrescribedMultipliers<double> free(joints_, none_);
    bodies_.kick(t, h, y);
    ++evaluations_;
  }

  /// Adds to the velocities of y the change over h that `spin(constants, h, m)` makes to the angular momentum m
  /// (kg m²/s, principal axes) of each body at the state `at`. The bodies do not move.
  template <class Spin>
  void add_spin(double h, Flat& at, Flat& y, const Spin& spin) {
    spun_ = at;
    bodies_.free_flow(h, spun_, [&](const BodyConstants<double>& body, double over, Vector3<double>& m) {
      spin(body, over, m);
      return identity_quaternion<double>();
    });
    bodies_.velocity_part(y) += bodies_.velocity_part(spun_) - bodies_.velocity_part(at);
  }

  /// Evaluates the joints at y, and the twists of its bodies.
  void look_at(const Flat& y) {
    evaluate(y);
    twists_.resize(bodies_.moving());
    for (std::size_t i = 0; i < twists_.size(); ++i) twists_[i] = {motions_[i].velocity, motions_[i].angular_velocity};
  }

  /// Applies impulses of the rows (N s, N m s) to the state y of the last look_at(), and counts their work.
  void apply(const VectorX<double>& p, Flat& y) {
    std::fill(impulses_.begin(), impulses_.end(), Wrench<double>{});
    joints_.add_transposed(p, impulses_);
    joints_.multiply(twists_, before_);
    for (std::size_t i = 0; i < bodies_.moving(); ++i) {
      bodies_.apply_impulse(y, i, impulses_[i].force, impulses_[i].torque);
      const BodyMotion<double> now = bodies_.motion_of(y, i);
      twists_[i] = {now.velocity, now.angular_velocity};
    }
    joints_.multiply(twists_, after_);
    y[bodies_.layout().joint_work()] += 0.5 * p.dot(before_ + after_);
  }

  /// x' = x + h v, and q' = exp(h ω) q or, of `first_order`, q' = q + h/2 ω q, normalized. The latter is the rotation
  /// about ω by 2 atan(h |ω|/2).
  void move(double h, bool first_order, Flat& y) {
    bodies_.twist(y, step_);
    step_ *= h;
    for (Eigen::Index i = 0; first_order && i < step_.size(); i += 6) {
      auto turn = step_.template segment<3>(i + 3);
      if (const double angle = turn.norm(); angle > 0) turn *= 2 * std::atan(angle / 2) / angle;
    }
    bodies_.retract(y, step_);
    bodies_.project_flat(y.data());
  }

  /// g of a row of the last look_at(), m or rad.
  double gap(Eigen::Index row) const { return joints_.equations()[std::size_t(row)].residual; }

  Twists twists_;

 private:
  const char* take(double t, double h, Flat& y) final {
    const double part = h / double(substeps_);
    for (std::int64_t k = 0; k < substeps_; ++k) substep(t + double(k) * part, part, y);
    return nullptr;
  }

  const std::int64_t substeps_;
  const VectorX<double> none_;
  Flat rate_, spun_;
  typename ManyBodies<double>::Tangent step_;
  std::vector<Wrench<double>> impulses_;
  VectorX<double> before_, after_;
};

/// The reason why a recipe for joints does not apply; empty if it does.
inline std::string joint_recipe_refusal(const Problem& problem, const Formulation& formulation) {
  const std::string why = joint_refusal(problem, formulation, Rows::may_depend);
  return why.empty() ? needs_an_engine_state(problem, formulation) : why;
}

}  // namespace polhode::integrators
