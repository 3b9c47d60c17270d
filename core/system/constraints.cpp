// SPDX-License-Identifier: BSD-3-Clause
#include "core/system/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/joints/catalogue.hpp"
#include "core/system/constraint_solver.hpp"

namespace polhode::inline core::inline system {

/// The rows of all joints, and the bodies of each row.
template <class S>
struct JointRows {
  JointRows(const Problem& problem) {
    // A static body is as immovable as the world.
    const auto index_of = [&](std::size_t body) { return body < problem.moving() ? body : ConstraintSolver<S>::none; };
    for (const JointParameters& p : problem.joints) {
      joints.push_back(make_joint<S>(p, problem.starts));
      names.push_back(p.name);
      offsets.push_back(joint_of.size());
      const JointModel<S>& joint = *joints.back();
      for (std::size_t k = 0; k < joint.rows(); ++k) {
        joint_of.push_back(joints.size() - 1);
        one.push_back(index_of(joint.first()));
        two.push_back(joint.second() ? index_of(*joint.second()) : ConstraintSolver<S>::none);
      }
    }
  }

  std::vector<JointPointer<S>> joints;
  std::vector<std::string> names;
  std::vector<std::size_t> offsets;   ///< first row of each joint
  std::vector<std::size_t> joint_of;  ///< joint of each row
  std::vector<std::size_t> one, two;  ///< bodies of each row
};

/// The problem with bodies of mass 1 kg and of inertia 1 kg m² about every axis.
inline Problem with_unit_masses(Problem problem) {
  for (Body& body : problem.bodies) {
    body.mass = 1;
    body.inertia = Matrix3<double>::Identity();
  }
  return problem;
}

template <class S>
struct Constraints<S>::Parts : JointRows<S> {
  Parts(const Problem& problem, const Formulation& f)
      : JointRows<S>(problem), formulation(f), solver(problem, this->one, this->two), moving(problem.moving()) {
    for (std::size_t i = 0; i < moving; ++i) bodies.emplace_back(problem.bodies[i]);
    right = lambda = rates = VectorX<S>::Zero(Eigen::Index(this->joint_of.size()));
    free.resize(moving);
    if (formulation.joints.is_soft()) {
      double mass = 0;  // mass of all bodies, kg
      for (std::size_t i = 0; i < moving; ++i) mass += problem.bodies[i].mass;
      softness = S(double(moving) / (formulation.joints.penalty * mass));
    }
    if (formulation.joints.metric == ProjectionMetric::unit) {
      const Problem unit = with_unit_masses(problem);
      unit_solver.emplace(unit, this->one, this->two);
    }
  }

  void evaluate(Motions motions) {
    for (std::size_t j = 0; j < this->joints.size(); ++j) {
      this->joints[j]->evaluate(motions, {solver.rows().data() + this->offsets[j], this->joints[j]->rows()});
    }
  }
  void evaluate_and_divide(Motions motions) {
    evaluate(motions);
    solver.set(motions);
  }

  /// Product of row k with the velocities of its bodies.
  S rate(std::size_t k, Motions motions) const {
    return solver.product(k, [&](std::size_t i) {
      return std::pair<const Vector3<S>&, const Vector3<S>&>(motions[i].velocity, motions[i].angular_velocity);
    });
  }
  /// Product of row k with twists or accelerations.
  S product(std::size_t k, std::span<const Wrench<S>> twists) const {
    return solver.product(k, [&](std::size_t i) {
      return std::pair<const Vector3<S>&, const Vector3<S>&>(twists[i].force, twists[i].torque);
    });
  }

  /// γ − 2α G v − β² g of each row to `right`, G v to `rates`.
  void fill_right(Motions motions) {
    const S alpha = S(formulation.joints.alpha), beta = S(formulation.joints.beta);
    const bool stabilized = formulation.joints.has_baumgarte_terms();
    for (std::size_t k = 0; k < solver.rows().size(); ++k) {
      const Eigen::Index i = Eigen::Index(k);
      rates[i] = rate(k, motions);
      right[i] = solver.rows()[k].gamma;
      if (stabilized) right[i] -= S(2) * alpha * rates[i] + beta * beta * solver.rows()[k].residual;
    }
  }

  /// Accelerations of the bodies under the wrenches and, if the formulation has it, the gyroscopic torque.
  void fill_accelerations(Motions motions, std::span<const Wrench<S>> wrenches) {
    for (std::size_t i = 0; i < moving; ++i) {
      Wrench<S> w = wrenches[i];
      if (formulation.gyroscopic) {
        const Matrix3<S>& r = motions[i].rotation;
        const Vector3<S>& omega = motions[i].angular_velocity;
        w.torque -= omega.cross(r * bodies[i].momentum(r.transpose() * omega));
      }
      free[i] = solver.acceleration(i, w);
    }
  }
  void subtract_accelerations() {
    for (std::size_t k = 0; k < solver.rows().size(); ++k) right[Eigen::Index(k)] -= product(k, free);
  }

  /// λ of the index-1 form, or of a penalty.
  void solve_for_reactions() {
    if (!formulation.joints.is_soft()) return solver.solve(right, lambda);
    solver.soften(softness);
    solver.solve(right, lambda);
    if (formulation.joints.stabilization == Stabilization::augmented_lagrangian) {
      // (A + 1/a) δ = b − G v̇(λ), where b − G v̇(λ) = λ/a after the first solution and δ/a after each later one.
      VectorX<S> change = lambda;
      constexpr int most_iterations = 60;
      for (int k = 0; k < most_iterations && change.norm() > S(8) * std::numeric_limits<S>::epsilon() * lambda.norm();
           ++k) {
        const VectorX<S> rest = softness * change;
        solver.solve(rest, change);
        lambda += change;
      }
    }
    solver.soften(S(0));
  }

  /// The solver in whose metric projections are orthogonal, set to the motions.
  ConstraintSolver<S>& metric(Motions motions) {
    evaluate_and_divide(motions);
    if (!unit_solver) return solver;
    unit_solver->rows() = solver.rows();
    unit_solver->set(motions);
    return *unit_solver;
  }

  /// Solves G M⁻¹ Gᵀ λ = −value(row) in the metric of projections. Returns the largest |value|.
  template <class Value>
  S correct(Motions motions, const Value& value) {
    using std::abs;
    ConstraintSolver<S>& of_metric = metric(motions);
    S worst(0);
    for (std::size_t k = 0; k < solver.rows().size(); ++k) {
      const S size = value(k);
      right[Eigen::Index(k)] = -size;
      if (!(abs(size) <= worst)) worst = abs(size);
    }
    of_metric.solve(right, lambda);
    return worst;
  }

  const Formulation formulation;
  ConstraintSolver<S> solver;
  std::optional<ConstraintSolver<S>> unit_solver;  ///< solver for projections in the unit metric
  S softness{};                                    ///< softness 1/a of penalty methods, 1/kg or 1/(kg m²)
  const std::size_t moving;
  std::vector<BodyConstants<S>> bodies;
  const VectorX<S>* prescribed = nullptr;

  // Scratch storage of one evaluation.
  std::vector<Wrench<S>> free;  ///< acceleration of each body
  VectorX<S> right, lambda;
  VectorX<S> rates;  ///< G v
  S last_power{};
};

template <class S>
Constraints<S>::Constraints(const Problem& problem, const Formulation& formulation)
    : parts_(std::make_unique<Parts>(problem, formulation)) {
  std::vector<BodyMotion<S>> motions;
  for (const BodyStart& s : problem.starts) {
    const Matrix3<S> r = rotation_matrix<double>(s.orientation).template cast<S>();
    motions.push_back({s.position.cast<S>(), r, Vector3<S>::Zero(), Vector3<S>::Zero()});
  }
  Parts& p = *parts_;
  p.evaluate_and_divide(motions);
  if (p.solver.solve_independent(p.right, p.lambda)) return;  // the rank of many equations costs more than a run
  const auto at_start = p.solver.rank(motions);
  if (at_start.rank == p.joint_of.size()) return;
  p.solver.expect_dependent_rows();
  if (p.unit_solver) p.unit_solver->expect_dependent_rows();
}

template <class S>
Constraints<S>::~Constraints() = default;

template <class S>
std::size_t Constraints<S>::count() const {
  return parts_->joints.size();
}
template <class S>
bool Constraints<S>::dependent() const {
  return parts_->solver.dependent();
}
template <class S>
std::size_t Constraints<S>::rows() const {
  return parts_->joint_of.size();
}
template <class S>
const JointModel<S>& Constraints<S>::joint(std::size_t i) const {
  return *parts_->joints[i];
}
template <class S>
const std::string& Constraints<S>::name(std::size_t i) const {
  return parts_->names[i];
}

template <class S>
void Constraints<S>::add_reactions(Motions motions, Wrenches wrenches) const {
  Parts& p = *parts_;
  p.evaluate_and_divide(motions);
  p.fill_right(motions);
  if (p.prescribed) {
    p.lambda = *p.prescribed;
    p.solver.template spread<false>(p.lambda, wrenches);
    p.fill_accelerations(motions, wrenches);
    p.subtract_accelerations();
  } else {
    p.fill_accelerations(motions, wrenches);
    p.subtract_accelerations();
    p.solve_for_reactions();
    p.solver.template spread<false>(p.lambda, wrenches);
  }
  p.last_power = S(0);
  for (Eigen::Index k = 0; k < p.lambda.size(); ++k) p.last_power += p.lambda[k] * p.rates[k];
}

template <class S>
std::int64_t Constraints<S>::solved() const {
  return parts_->solver.solved() + (parts_->unit_solver ? parts_->unit_solver->solved() : 0);
}

template <class S>
const VectorX<S>& Constraints<S>::multipliers() const {
  return parts_->lambda;
}
template <class S>
const VectorX<S>& Constraints<S>::rates() const {
  return parts_->rates;
}
template <class S>
S Constraints<S>::power() const {
  return parts_->last_power;
}

template <class S>
S Constraints<S>::power_at(Motions motions) const {
  S sum(0);
  for (Eigen::Index k = 0; k < parts_->lambda.size(); ++k) {
    sum += parts_->lambda[k] * parts_->rate(std::size_t(k), motions);
  }
  return sum;
}

template <class S>
Wrench<S> Constraints<S>::reaction(std::size_t joint, Motions motions) const {
  const Parts& p = *parts_;
  Wrench<S> sum;
  for (std::size_t k = p.offsets[joint]; k < p.offsets[joint] + p.joints[joint]->rows(); ++k) {
    const Wrench<S>& row = p.solver.rows()[k].first;
    sum.force += p.lambda[Eigen::Index(k)] * row.force;
    sum.torque += p.lambda[Eigen::Index(k)] * row.torque;
  }
  const Vector3<S> arm = p.joints[joint]->anchor(motions) - motions[p.joints[joint]->first()].position;
  sum.torque -= arm.cross(sum.force);
  return sum;
}

template <class S>
bool Constraints<S>::has_angles(std::size_t joint) const {
  const auto row = parts_->solver.rows().begin() + std::ptrdiff_t(parts_->offsets[joint]);
  return std::any_of(row, row + std::ptrdiff_t(parts_->joints[joint]->rows()), [](const auto& r) { return r.angular; });
}

template <class S>
auto Constraints<S>::violation(std::size_t joint, Motions motions) const -> Violation {
  Parts& p = *parts_;
  p.evaluate(motions);
  Violation v;
  const auto raise = [](double& worst, S value) {
    const double size = std::abs(double(value));
    if (!(size <= worst)) worst = size;  // keeps a NaN
  };
  for (std::size_t k = p.offsets[joint]; k < p.offsets[joint] + p.joints[joint]->rows(); ++k) {
    const ConstraintRow<S>& row = p.solver.rows()[k];
    raise(row.angular ? v.angle : v.position, row.residual);
    raise(row.angular ? v.rate : v.velocity, p.rate(k, motions));
  }
  return v;
}

template <class S>
S Constraints<S>::position_correction(Motions motions, Wrenches displacements) const {
  Parts& p = *parts_;
  const S worst = p.correct(motions, [&](std::size_t k) { return p.solver.rows()[k].residual; });
  (p.unit_solver ? *p.unit_solver : p.solver).template spread<true>(p.lambda, displacements);
  return worst;
}

template <class S>
S Constraints<S>::velocity_correction(Motions motions, Wrenches impulses) const {
  Parts& p = *parts_;
  const S worst = p.correct(motions, [&](std::size_t k) { return p.rate(k, motions); });
  if (!p.unit_solver) {
    p.solver.template spread<false>(p.lambda, impulses);
    return worst;
  }
  p.unit_solver->template spread<true>(p.lambda, impulses);
  for (std::size_t i = 0; i < p.moving; ++i) impulses[i] = p.solver.momentum(i, impulses[i]);
  return worst;
}

template <class S>
ConstraintRank Constraints<S>::rank(Motions motions) const {
  Parts& p = *parts_;
  p.evaluate(motions);
  const auto of = p.solver.rank(motions);
  ConstraintRank found{.rows = p.joint_of.size(), .rank = of.rank, .condition = of.condition};
  for (const std::size_t row : of.dependent) {
    const std::string& name = p.names[p.joint_of[row]];
    if (std::find(found.dependent.begin(), found.dependent.end(), name) == found.dependent.end()) {
      found.dependent.push_back(name);
    }
  }
  return found;
}

template <class S>
void Constraints<S>::evaluate(Motions motions) const {
  parts_->evaluate_and_divide(motions);
}
template <class S>
const std::vector<ConstraintRow<S>>& Constraints<S>::equations() const {
  return parts_->solver.rows();
}
template <class S>
void Constraints<S>::multiply(std::span<const Wrench<S>> twists, VectorX<S>& product) const {
  product.resize(Eigen::Index(rows()));
  for (std::size_t k = 0; k < rows(); ++k) product[Eigen::Index(k)] = parts_->product(k, twists);
}
template <class S>
void Constraints<S>::add_transposed(const VectorX<S>& lambda, Wrenches wrenches) const {
  parts_->solver.template spread<false>(lambda, wrenches);
}
template <class S>
void Constraints<S>::divide_by_masses(Wrenches wrenches) const {
  for (std::size_t i = 0; i < parts_->moving; ++i) wrenches[i] = parts_->solver.acceleration(i, wrenches[i]);
}
template <class S>
void Constraints<S>::solve(const VectorX<S>& right, VectorX<S>& lambda) const {
  parts_->solver.solve(right, lambda);
}

template <class S>
ConstraintSolver<S>& Constraints<S>::solver() const {
  return parts_->solver;
}

template <class S>
VectorX<S> Constraints<S>::acceleration_defects() const {
  return -parts_->right;
}

template <class S>
PrescribedMultipliers<S>::PrescribedMultipliers(const Constraints<S>& constraints, const VectorX<S>& multipliers)
    : constraints_(constraints) {
  constraints.parts_->prescribed = &multipliers;
}
template <class S>
PrescribedMultipliers<S>::~PrescribedMultipliers() {
  constraints_.parts_->prescribed = nullptr;
}

#define POLHODE_INSTANTIATE(S) \
  template class Constraints<S>; \
  template class PrescribedMultipliers<S>
POLHODE_INSTANTIATE(float);
POLHODE_INSTANTIATE(double);
POLHODE_INSTANTIATE(long double);
#undef POLHODE_INSTANTIATE

}  // namespace polhode::core::system
