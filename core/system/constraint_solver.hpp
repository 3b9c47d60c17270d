// SPDX-License-Identifier: BSD-3-Clause
// The linear systems of joints: G M⁻¹ Gᵀ λ = r for the rows G of all joints at one state.
//
// The matrix is factorized by Cholesky: dense for few rows, sparse for many, so that a chain of n bodies costs O(n). If
// rows depend on each other, a rank-revealing factorization of G M^(−1/2) takes its place: M⁻¹ Gᵀ λ is then the
// smallest correction that satisfies the independent rows, and λ has the least norm.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/problem/joint.hpp"
#include "core/problem/problem.hpp"
#include "core/system/body_constants.hpp"

namespace polhode::inline core::inline system {

template <class S>
class ConstraintSolver {
 public:
  using Motions = std::span<const BodyMotion<S>>;
  using MatrixX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  /// The moving bodies of the problem, and the bodies of each row: first and second, or `none` for one that does not
  /// move.
  ConstraintSolver(const Problem& problem, std::vector<std::size_t> one, std::vector<std::size_t> two);
  ~ConstraintSolver();

  static constexpr std::size_t none = std::size_t(-1);

  /// The rows, which the joints fill before set().
  std::vector<ConstraintRow<S>>& rows() { return rows_; }
  const std::vector<ConstraintRow<S>>& rows() const { return rows_; }
  /// Sets the rotations of the bodies, and divides the rows by the masses. The motions must live as long as solve() is
  /// called.
  void set(Motions motions);

  /// Number of systems solved since construction.
  std::int64_t solved() const { return solved_; }

  /// λ from G M⁻¹ Gᵀ λ = right.
  void solve(const VectorX<S>& right, VectorX<S>& lambda);
  /// The same by Cholesky. False: rows depend on each other to within round-off.
  bool solve_independent(const VectorX<S>& right, VectorX<S>& lambda);
  /// Rows that depend on each other everywhere: every solution is by rank.
  void expect_dependent_rows() { dependent_ = true; }
  bool dependent() const { return dependent_; }
  /// Adds `softness` (1/kg, 1/(kg m²)) and `share` times itself to each diagonal entry of G M⁻¹ Gᵀ from now on. A soft
  /// matrix is regular where rows depend on each other.
  void soften(S softness, S share = S(0)) {
    softness_ = softness;
    share_ = share;
  }

  /// The rank of the rows, the condition of the independent ones, and the indices of the others.
  struct Rank {
    std::size_t rank = 0;
    double condition = 1;
    std::vector<std::size_t> dependent{};
  };
  Rank rank(Motions motions) const;

  /// M⁻¹ w for the wrench on a body.
  Wrench<S> acceleration(std::size_t body, const Wrench<S>& w) const {
    return {Vector3<S>(inverse_mass(body) * w.force), Vector3<S>(inverse_inertia_[body] * w.torque)};
  }

  /// M u for a twist of the body.
  Wrench<S> momentum(std::size_t body, const Wrench<S>& u) const {
    const BodyConstants<S>& b = bodies_[body];
    const Matrix3<S>& r = motions_[body].rotation;
    const S mass = b.pinned ? S(0) : S(1) / b.inverse_mass;
    return {Vector3<S>(mass * u.force), Vector3<S>(r * b.momentum(r.transpose() * u.torque))};
  }

  /// G u for a twist u(i) = (v, ω) of each moving body, in world axes.
  template <class TwistOf>
  S product(std::size_t row, const TwistOf& u) const {
    S sum(0);
    const auto add = [&](std::size_t i, const Wrench<S>& w) {
      const auto& [linear, angular] = u(i);
      sum += w.force.dot(linear) + w.torque.dot(angular);
    };
    if (one_[row] != none) add(one_[row], rows_[row].first);
    if (two_[row] != none) add(two_[row], rows_[row].second);
    return sum;
  }

  /// G_i M⁻¹ G_jᵀ of two rows of one joint, without softness.
  S coupling(std::size_t i, std::size_t j) const {
    S sum(0);
    if (one_[i] != none) sum += rows_[i].first.force.dot(first_[j].force) + rows_[i].first.torque.dot(first_[j].torque);
    if (two_[i] != none)
      sum += rows_[i].second.force.dot(second_[j].force) + rows_[i].second.torque.dot(second_[j].torque);
    return sum;
  }

  /// Adds M⁻¹ G_kᵀ p of one row to the twists of its bodies.
  void add_impulse(std::size_t k, S p, std::span<Wrench<S>> twists) const {
    const auto add = [&](std::size_t i, const Wrench<S>& w) {
      twists[i].force += p * w.force;
      twists[i].torque += p * w.torque;
    };
    if (one_[k] != none) add(one_[k], first_[k]);
    if (two_[k] != none) add(two_[k], second_[k]);
  }

  /// Adds Gᵀ λ, or M⁻¹ Gᵀ λ if `divided`, to the wrenches of the bodies.
  template <bool divided>
  void spread(const VectorX<S>& lambda, std::span<Wrench<S>> wrenches) const {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const S l = lambda[Eigen::Index(k)];
      const auto add = [&](std::size_t i, const Wrench<S>& w) {
        wrenches[i].force += l * w.force;
        wrenches[i].torque += l * w.torque;
      };
      if (one_[k] != none) add(one_[k], divided ? first_[k] : rows_[k].first);
      if (two_[k] != none) add(two_[k], divided ? second_[k] : rows_[k].second);
    }
  }

 private:
  /// A pair of rows that act on a common body: one term of an entry of G M⁻¹ Gᵀ.
  struct Term {
    std::size_t row, column;  ///< row ≥ column
    bool second_of_row, second_of_column;
    std::size_t entry;  ///< index in the values of the sparse matrix
  };

  void find_terms();
  void find_pattern();
  template <class Put>
  void add_terms(const Put& put) const;
  template <int n>
  bool solve_small(const VectorX<S>& right, VectorX<S>& lambda) const;
  bool solve_dense(const VectorX<S>& right, VectorX<S>& lambda);
  bool solve_sparse(const VectorX<S>& right, VectorX<S>& lambda);
  void solve_by_rank(const VectorX<S>& right, VectorX<S>& lambda) const;
  std::pair<MatrixX, VectorX<S>> weighted_rows(Motions motions) const;
  S threshold() const;
  S soft(S entry) const { return entry + softness_ + share_ * entry; }
  S inverse_mass(std::size_t i) const { return bodies_[i].pinned ? S(0) : bodies_[i].inverse_mass; }

  std::vector<BodyConstants<S>> bodies_;
  std::vector<std::size_t> one_, two_;
  std::vector<Term> terms_;
  bool dependent_ = false;
  S softness_{0}, share_{0};
  std::int64_t solved_ = 0;

  // Results of the last set().
  Motions motions_;
  std::vector<ConstraintRow<S>> rows_;
  std::vector<Wrench<S>> first_, second_;  ///< M⁻¹ Gᵀ of each row
  std::vector<Matrix3<S>> inverse_inertia_;

  MatrixX dense_;
  struct Sparse;
  std::unique_ptr<Sparse> sparse_;  ///< the matrix and its factors, if it has many rows
  VectorX<S> diagonal_;
};

}  // namespace polhode::core::system
