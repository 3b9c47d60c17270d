// SPDX-License-Identifier: BSD-3-Clause
// Common base of the fixed-step methods that solve the equations of joints themselves.
#pragma once

#include <limits>
#include <vector>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "core/system/many_bodies.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::inline integrators {

class JointMethod : public Integrator<double> {
 public:
  using Flat = VectorX<double>;

  StepResult step(State<double>& state, double h) final {
    next_ = state.y;
    if (const char* why = take(state.t, h, next_)) return {why};
    state.y.swap(next_);
    state.t += h;
    return {};
  }
  std::int64_t evaluations() const final { return evaluations_; }
  std::span<const double> multipliers() const final { return {lambda_.data(), std::size_t(lambda_.size())}; }

 protected:
  explicit JointMethod(const System<double>& system)
      : bodies_(dynamic_cast<const ManyBodies<double>&>(system)), joints_(*system.constraints()) {
    double mass = 0;
    for (std::size_t i = 0; i < system.moving(); ++i) mass += system.problem().bodies[i].mass;
    mean_mass_ = mass / double(system.moving());
  }

  /// Advances y from t by h. Returns null, or the reason of a failure.
  virtual const char* take(double t, double h, Flat& y) = 0;

  /// Evaluates the joints at y.
  void evaluate(const Flat& y) {
    motions_ = motions_of(bodies_, y);
    joints_.evaluate(motions_);
  }

  /// Length to which the round-off of a step is proportional, m.
  double scale() const {
    double scale = 1;
    for (const auto& m : motions_) scale = std::max(scale, m.position.cwiseAbs().maxCoeff());
    return scale;
  }

  Eigen::Index rows() const { return Eigen::Index(joints_.rows()); }

  const ManyBodies<double>& bodies_;
  const Constraints<double>& joints_;
  double mean_mass_ = 1;                     ///< kg
  std::vector<BodyMotion<double>> motions_;  ///< motions at the last evaluate()
  VectorX<double> lambda_;                   ///< multipliers at the end of the last step
  std::int64_t evaluations_ = 0;

 private:
  Flat next_;
};

/// The catalogue entry of such a method: joint_method<Rattle>({.name = "rattle", …}, Rows::may_depend, …).
template <class Method, class... Arguments>
IntegratorEntry joint_method(Declaration declaration, std::string (*refusal)(const Problem&, const Formulation&),
                             Arguments... arguments) {
  return {.declaration = std::move(declaration),
          .make = [arguments...](const System<double>& system, const IntegratorSettings& settings)
              -> IntegratorPointer<double> { return std::make_unique<Method>(system, settings, arguments...); },
          .refusal = refusal};
}

}  // namespace polhode::integrators
