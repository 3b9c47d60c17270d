// SPDX-License-Identifier: BSD-3-Clause
#include "core/system/constraints.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/joints/catalogue.hpp"

namespace polhode {
namespace {

constexpr std::size_t most_small_rows = 6;   // up to it the size of the matrix is known at compile time
constexpr std::size_t most_dense_rows = 24;  // above it the sparse factorization is faster for a chain

template <class S>
using MatrixX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// Product of two wrenches or of a wrench with a velocity (v, ω).
template <class S>
S product(const Wrench<S>& a, const Wrench<S>& b) {
  return a.force.dot(b.force) + a.torque.dot(b.torque);
}

/// A pair of rows that act on a common body: one term of an entry of G M⁻¹ Gᵀ.
struct Term {
  std::size_t row, column;  ///< row ≥ column
  bool second_of_row, second_of_column;
  std::size_t entry;  ///< index in the values of the sparse matrix
};

}  // namespace

template <class S>
struct Constraints<S>::Parts {
  Parts(const Problem& problem, const Formulation& f) : formulation(f), moving(problem.moving()) {
    for (std::size_t i = 0; i < moving; ++i) bodies.emplace_back(problem.bodies[i]);
    for (const JointParameters& p : problem.joints) {
      joints.push_back(make_joint<S>(p, problem.starts));
      names.push_back(p.name);
      offsets.push_back(joint_of.size());
      for (std::size_t k = 0; k < joints.back()->rows(); ++k) joint_of.push_back(joints.size() - 1);
    }
    const std::size_t n = joint_of.size();
    rows.resize(n);
    first.resize(n);
    second.resize(n);
    right.resize(Eigen::Index(n));
    lambda = VectorX<S>::Zero(Eigen::Index(n));
    inverse_inertia.resize(moving);
    free.resize(moving);
    rates.resize(n);
    for (std::size_t r = 0; r < n; ++r) {
      const auto& joint = *joints[joint_of[r]];
      one.push_back(index_of(joint.first()));
      two.push_back(joint.second() ? index_of(*joint.second()) : none);
    }
    find_terms();
  }

  static constexpr std::size_t none = std::size_t(-1);
  /// A static body is as immovable as the world.
  std::size_t index_of(std::size_t body) const { return body < moving ? body : none; }

  /// Lists the pairs of rows with a common body, and the pattern of G M⁻¹ Gᵀ.
  void find_terms() {
    std::vector<std::vector<std::pair<std::size_t, bool>>> rows_of(moving);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (one[r] != none) rows_of[one[r]].emplace_back(r, false);
      if (two[r] != none) rows_of[two[r]].emplace_back(r, true);
    }
    for (const auto& list : rows_of) {
      for (const auto& [r, second_of_row] : list) {
        for (const auto& [c, second_of_column] : list) {
          if (r >= c) terms.push_back({r, c, second_of_row, second_of_column, 0});
        }
      }
    }
    if (rows.size() <= most_dense_rows) {
      dense.resize(Eigen::Index(rows.size()), Eigen::Index(rows.size()));
      return;
    }
    std::vector<Eigen::Triplet<S>> triplets;
    for (const Term& t : terms) triplets.emplace_back(int(t.row), int(t.column), S(1));
    sparse.resize(Eigen::Index(rows.size()), Eigen::Index(rows.size()));
    sparse.setFromTriplets(triplets.begin(), triplets.end());
    sparse.makeCompressed();
    for (Term& t : terms) {
      const int* begin = sparse.innerIndexPtr() + sparse.outerIndexPtr()[t.column];
      const int* end = sparse.innerIndexPtr() + sparse.outerIndexPtr()[t.column + 1];
      t.entry = std::size_t(std::lower_bound(begin, end, int(t.row)) - sparse.innerIndexPtr());
    }
    sparse_factor.analyzePattern(sparse);
  }

  void evaluate(Motions motions) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      joints[j]->evaluate(motions, {rows.data() + offsets[j], joints[j]->rows()});
    }
  }

  /// M⁻¹ Gᵀ of every row, for the rotations of the bodies.
  void divide_by_masses(Motions motions) {
    for (std::size_t i = 0; i < moving; ++i) {
      const BodyConstants<S>& b = bodies[i];
      const Matrix3<S>& r = motions[i].rotation;
      if (b.principal) inverse_inertia[i].noalias() = r * b.inverse_moments.asDiagonal() * r.transpose();
      else inverse_inertia[i].noalias() = r * b.inverse_inertia * r.transpose();
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (one[k] != none) first[k] = acceleration(one[k], rows[k].first);
      if (two[k] != none) second[k] = acceleration(two[k], rows[k].second);
    }
  }

  S inverse_mass(std::size_t i) const { return bodies[i].pinned ? S(0) : bodies[i].inverse_mass; }

  /// M⁻¹ w for the wrench on a body.
  Wrench<S> acceleration(std::size_t i, const Wrench<S>& w) const {
    return {Vector3<S>(inverse_mass(i) * w.force), Vector3<S>(inverse_inertia[i] * w.torque)};
  }

  const Wrench<S>& row_on(std::size_t r, bool of_second) const { return of_second ? rows[r].second : rows[r].first; }
  const Wrench<S>& divided(std::size_t r, bool of_second) const { return of_second ? second[r] : first[r]; }

  /// Factorizes G M⁻¹ Gᵀ of the last divide_by_masses(). False: the rows depend on each other to within round-off.
  bool factorize() {
    if (rows.size() <= most_dense_rows) {
      dense.setZero();
      for (const Term& t : terms) {
        dense(Eigen::Index(t.row), Eigen::Index(t.column)) +=
            product(row_on(t.row, t.second_of_row), divided(t.column, t.second_of_column));
      }
      diagonal = dense.diagonal();
      const Eigen::LLT<Eigen::Ref<MatrixX<S>>> factor(dense);  // in place
      if (factor.info() != Eigen::Success) return false;
      for (Eigen::Index i = 0; i < dense.rows(); ++i) {
        if (!(dense(i, i) * dense(i, i) > least_pivot() * diagonal[i])) return false;
      }
      return true;
    }
    S* values = sparse.valuePtr();
    std::fill(values, values + sparse.nonZeros(), S(0));
    for (const Term& t : terms) {
      values[t.entry] += product(row_on(t.row, t.second_of_row), divided(t.column, t.second_of_column));
    }
    sparse_factor.factorize(sparse);
    if (sparse_factor.info() != Eigen::Success) return false;
    diagonal = sparse.diagonal();
    const auto pivots = sparse_factor.vectorD();
    const auto& order = sparse_factor.permutationP().indices();
    for (Eigen::Index i = 0; i < pivots.size(); ++i) {
      if (!(pivots[order[i]] > least_pivot() * diagonal[i])) return false;
    }
    return true;
  }

  /// Calls f with the number of rows as a constant of the compiler, if they are few.
  template <class F>
  bool with_size(const F& f) {
    switch (rows.size()) {
      case 1: return f(std::integral_constant<int, 1>());
      case 2: return f(std::integral_constant<int, 2>());
      case 3: return f(std::integral_constant<int, 3>());
      case 4: return f(std::integral_constant<int, 4>());
      case 5: return f(std::integral_constant<int, 5>());
      default: return f(std::integral_constant<int, 6>());
    }
  }

  /// Cholesky's factorization and solution for few rows. False: the rows depend on each other to within round-off.
  template <int n>
  bool solve_small() {
    Eigen::Matrix<S, n, n> matrix = Eigen::Matrix<S, n, n>::Zero();
    for (const Term& t : terms) {
      matrix(Eigen::Index(t.row), Eigen::Index(t.column)) +=
          product(row_on(t.row, t.second_of_row), divided(t.column, t.second_of_column));
    }
    const Eigen::LLT<Eigen::Matrix<S, n, n>> factor(matrix);
    if (factor.info() != Eigen::Success) return false;
    for (int i = 0; i < n; ++i) {
      const S pivot = factor.matrixLLT()(i, i);
      if (!(pivot * pivot > least_pivot() * matrix(i, i))) return false;
    }
    Eigen::Map<Eigen::Matrix<S, n, 1>> solution(lambda.data());
    solution = factor.solve(Eigen::Map<const Eigen::Matrix<S, n, 1>>(right.data()));
    return true;
  }

  /// Least square of a pivot relative to its diagonal entry.
  static S least_pivot() {
    using std::sqrt;
    static const S least = sqrt(std::numeric_limits<S>::epsilon()) * S(1e-2);
    return least;
  }

  /// λ from G M⁻¹ Gᵀ λ = right by Cholesky. False: the rows depend on each other to within round-off.
  bool solve_independent() {
    if (rows.size() <= most_small_rows) return with_size([&](auto n) { return solve_small<n()>(); });
    if (!factorize()) return false;
    if (rows.size() <= most_dense_rows) {
      lambda = right;
      dense.template triangularView<Eigen::Lower>().solveInPlace(lambda);
      dense.transpose().template triangularView<Eigen::Upper>().solveInPlace(lambda);
    } else {
      lambda = sparse_factor.solve(right);
    }
    return true;
  }

  /// λ from G M⁻¹ Gᵀ λ = right.
  void solve() {
    if (dependent || !solve_independent()) solve_by_rank();
  }

  /// G M^(−1/2) with rows of unit length in that metric, and the inverse lengths.
  std::pair<MatrixX<S>, VectorX<S>> weighted_rows(Motions motions) const {
    using std::sqrt;
    const Eigen::Index n = Eigen::Index(rows.size());
    MatrixX<S> a = MatrixX<S>::Zero(n, 6 * Eigen::Index(moving));
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto place = [&](std::size_t i, const Wrench<S>& w) {
        const BodyConstants<S>& b = bodies[i];
        a.template block<1, 3>(k, 6 * Eigen::Index(i)) += sqrt(inverse_mass(i)) * w.force.transpose();
        const Vector3<S> torque = b.axes.transpose() * (motions[i].rotation.transpose() * w.torque);
        a.template block<1, 3>(k, 6 * Eigen::Index(i) + 3) +=
            b.inverse_moments.cwiseSqrt().cwiseProduct(torque).transpose();
      };
      const std::size_t r = std::size_t(k);
      if (one[r] != none) place(one[r], rows[r].first);
      if (two[r] != none) place(two[r], rows[r].second);
    }
    VectorX<S> scale(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const S length = a.row(k).norm();
      scale[k] = length > S(0) ? S(1) / length : S(1);
      a.row(k) *= scale[k];
    }
    return {std::move(a), std::move(scale)};
  }

  /// x = A⁺ right, the smallest correction of the accelerations, and λ of least norm with Aᵀ λ = x.
  void solve_by_rank() {
    const auto [a, scale] = weighted_rows(seen);
    Eigen::CompleteOrthogonalDecomposition<MatrixX<S>> of_rows;
    of_rows.setThreshold(threshold());
    of_rows.compute(a);
    const VectorX<S> x = of_rows.solve(scale.cwiseProduct(right));
    Eigen::CompleteOrthogonalDecomposition<MatrixX<S>> of_columns;
    of_columns.setThreshold(threshold());
    of_columns.compute(a.transpose());
    lambda = scale.cwiseProduct(of_columns.solve(x));
  }

  /// Relative size of a pivot below which a row counts as dependent. Drift of the positions perturbs the pivot of a row
  /// that depends on others everywhere, so that the threshold for such joints is wide.
  S threshold() const {
    using std::pow;
    return dependent ? pow(std::numeric_limits<S>::epsilon(), S(0.4)) : pow(std::numeric_limits<S>::epsilon(), S(0.7));
  }

  /// Product of row k with the velocities of its bodies.
  S rate(std::size_t k, Motions motions) const {
    S sum(0);
    const auto add = [&](std::size_t i, const Wrench<S>& w) {
      sum += w.force.dot(motions[i].velocity) + w.torque.dot(motions[i].angular_velocity);
    };
    if (one[k] != none) add(one[k], rows[k].first);
    if (two[k] != none) add(two[k], rows[k].second);
    return sum;
  }

  /// Adds Gᵀ λ of each row to its bodies.
  template <class RowOn>
  void spread(Wrenches wrenches, const RowOn& row_on_body, S sign) const {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const S l = sign * lambda[Eigen::Index(k)];
      const auto add = [&](std::size_t i, const Wrench<S>& w) {
        wrenches[i].force += l * w.force;
        wrenches[i].torque += l * w.torque;
      };
      if (one[k] != none) add(one[k], row_on_body(k, false));
      if (two[k] != none) add(two[k], row_on_body(k, true));
    }
  }

  const Formulation formulation;
  const std::size_t moving;
  std::vector<BodyConstants<S>> bodies;
  std::vector<JointPointer<S>> joints;
  std::vector<std::string> names;
  std::vector<std::size_t> offsets;   ///< of each joint in the rows
  std::vector<std::size_t> joint_of;  ///< of each row
  std::vector<std::size_t> one, two;  ///< bodies of each row; none: immovable
  std::vector<Term> terms;
  bool dependent = false;  ///< rows depend on each other at the start

  // Scratch storage of one evaluation.
  Motions seen;
  std::vector<ConstraintRow<S>> rows;
  std::vector<Wrench<S>> first, second;  ///< M⁻¹ Gᵀ of each row
  std::vector<Wrench<S>> free;           ///< acceleration of each body without joints
  std::vector<S> rates;                  ///< G v
  std::vector<Matrix3<S>> inverse_inertia;
  MatrixX<S> dense;
  Eigen::SparseMatrix<S> sparse;  ///< lower triangle
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<S>> sparse_factor;
  VectorX<S> diagonal, right, lambda;
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
  p.seen = motions;
  p.evaluate(motions);
  p.divide_by_masses(motions);
  p.right.setZero();
  if (p.solve_independent()) return;  // the rank of many equations costs more than a run
  const ConstraintRank at_start = rank(motions);
  p.dependent = at_start.rank < at_start.rows;
}

template <class S>
Constraints<S>::~Constraints() = default;

template <class S>
std::size_t Constraints<S>::count() const {
  return parts_->joints.size();
}
template <class S>
bool Constraints<S>::dependent() const {
  return parts_->dependent;
}
template <class S>
std::size_t Constraints<S>::rows() const {
  return parts_->rows.size();
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
  p.seen = motions;
  p.evaluate(motions);
  p.divide_by_masses(motions);
  const S alpha = S(p.formulation.joints.alpha), beta = S(p.formulation.joints.beta);
  const bool stabilized = p.formulation.joints.alpha != 0 || p.formulation.joints.beta != 0;
  std::vector<S>& rates = p.rates;
  for (std::size_t k = 0; k < p.rows.size(); ++k) {
    rates[k] = p.rate(k, motions);
    p.right[Eigen::Index(k)] = p.rows[k].gamma;
    if (stabilized) {
      p.right[Eigen::Index(k)] -= S(2) * alpha * rates[k] + beta * beta * p.rows[k].residual;
    }
  }
  // Free accelerations, with the gyroscopic torque of each body.
  for (std::size_t i = 0; i < p.moving; ++i) {
    Wrench<S> w = wrenches[i];
    if (p.formulation.gyroscopic) {
      const Matrix3<S>& r = motions[i].rotation;
      const Vector3<S>& omega = motions[i].angular_velocity;
      w.torque -= omega.cross(r * p.bodies[i].momentum(r.transpose() * omega));
    }
    p.free[i] = p.acceleration(i, w);
  }
  for (std::size_t k = 0; k < p.rows.size(); ++k) {
    S known(0);
    if (p.one[k] != Parts::none) known += product(p.rows[k].first, p.free[p.one[k]]);
    if (p.two[k] != Parts::none) known += product(p.rows[k].second, p.free[p.two[k]]);
    p.right[Eigen::Index(k)] -= known;
  }
  p.solve();
  p.spread(
      wrenches, [&](std::size_t k, bool of_second) -> const Wrench<S>& { return p.row_on(k, of_second); }, S(1));
  p.last_power = S(0);
  for (std::size_t k = 0; k < p.rows.size(); ++k) p.last_power += p.lambda[Eigen::Index(k)] * rates[k];
}

template <class S>
S Constraints<S>::power() const {
  return parts_->last_power;
}

template <class S>
Wrench<S> Constraints<S>::reaction(std::size_t joint, Motions motions) const {
  const Parts& p = *parts_;
  Wrench<S> sum;
  for (std::size_t k = p.offsets[joint]; k < p.offsets[joint] + p.joints[joint]->rows(); ++k) {
    sum.force += p.lambda[Eigen::Index(k)] * p.rows[k].first.force;
    sum.torque += p.lambda[Eigen::Index(k)] * p.rows[k].first.torque;
  }
  const Vector3<S> arm = p.joints[joint]->anchor(motions) - motions[p.joints[joint]->first()].position;
  sum.torque -= arm.cross(sum.force);
  return sum;
}

template <class S>
bool Constraints<S>::has_angles(std::size_t joint) const {
  const auto row = parts_->rows.begin() + std::ptrdiff_t(parts_->offsets[joint]);
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
    raise(p.rows[k].angular ? v.angle : v.position, p.rows[k].residual);
    raise(p.rows[k].angular ? v.rate : v.velocity, p.rate(k, motions));
  }
  return v;
}

template <class S>
S Constraints<S>::position_correction(Motions motions, Wrenches displacements) const {
  using std::abs;
  Parts& p = *parts_;
  p.seen = motions;
  p.evaluate(motions);
  p.divide_by_masses(motions);
  S worst(0);
  for (std::size_t k = 0; k < p.rows.size(); ++k) {
    const ConstraintRow<S>& row = p.rows[k];
    p.right[Eigen::Index(k)] = -row.residual;
    if (row.holonomic && !(abs(row.residual) <= worst)) worst = abs(row.residual);
  }
  p.solve();
  p.spread(
      displacements, [&](std::size_t k, bool of_second) -> const Wrench<S>& { return p.divided(k, of_second); }, S(1));
  return worst;
}

template <class S>
S Constraints<S>::velocity_correction(Motions motions, Wrenches impulses) const {
  using std::abs;
  Parts& p = *parts_;
  p.seen = motions;
  p.evaluate(motions);
  p.divide_by_masses(motions);
  S worst(0);
  for (std::size_t k = 0; k < p.rows.size(); ++k) {
    const S rate = p.rate(k, motions);
    p.right[Eigen::Index(k)] = -rate;
    if (!(abs(rate) <= worst)) worst = abs(rate);
  }
  p.solve();
  p.spread(
      impulses, [&](std::size_t k, bool of_second) -> const Wrench<S>& { return p.row_on(k, of_second); }, S(1));
  return worst;
}

template <class S>
ConstraintRank Constraints<S>::rank(Motions motions) const {
  Parts& p = *parts_;
  ConstraintRank found;
  found.rows = p.rows.size();
  if (p.rows.empty()) return found;
  p.evaluate(motions);
  const auto [a, scale] = p.weighted_rows(motions);
  // Pivots of the transpose: its columns are the rows of the joints.
  Eigen::ColPivHouseholderQR<MatrixX<S>> qr;
  qr.setThreshold(p.threshold());
  qr.compute(a.transpose());
  found.rank = std::size_t(qr.rank());
  const auto pivots = qr.matrixQR().diagonal().cwiseAbs();
  if (found.rank > 0) found.condition = double(pivots[0] / pivots[qr.rank() - 1]);
  for (Eigen::Index k = qr.rank(); k < Eigen::Index(p.rows.size()); ++k) {
    const std::string& name = p.names[p.joint_of[std::size_t(qr.colsPermutation().indices()[k])]];
    if (std::find(found.dependent.begin(), found.dependent.end(), name) == found.dependent.end()) {
      found.dependent.push_back(name);
    }
  }
  return found;
}

template class Constraints<float>;
template class Constraints<double>;
template class Constraints<long double>;

}  // namespace polhode
