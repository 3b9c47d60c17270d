// SPDX-License-Identifier: BSD-3-Clause
#include "core/system/constraint_solver.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace polhode::inline core::inline system {
namespace {

constexpr std::size_t most_small_rows = 6;   // limit up to which the size of the matrix is fixed at compile time
constexpr std::size_t most_dense_rows = 24;  // limit above which the sparse factorization is faster for a chain

/// Least square of a pivot relative to its diagonal entry.
template <class S>
S least_pivot() {
  using std::sqrt;
  static const S least = sqrt(std::numeric_limits<S>::epsilon()) * S(1e-2);
  return least;
}

/// Solves L Lᵀ x = right in place, for the lower triangle L.
template <class S>
void solve_by_factor(const Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>& lower, VectorX<S>& x) {
  lower.template triangularView<Eigen::Lower>().solveInPlace(x);
  lower.transpose().template triangularView<Eigen::Upper>().solveInPlace(x);
}

/// Applies Householder's reflections 0 … n−1 of a factorization to x, the first one first, or the last one first.
template <class S>
void reflect(const Eigen::ColPivHouseholderQR<Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>>& qr, Eigen::Index n,
             bool first_one_first, VectorX<S>& x) {
  const auto& columns = qr.matrixQR();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index k = first_one_first ? i : n - 1 - i;
    S product = x[k];  // the reflection's vector is 1 at k
    for (Eigen::Index j = k + 1; j < x.size(); ++j) product += columns(j, k) * x[j];
    product *= qr.hCoeffs()[k];
    x[k] -= product;
    for (Eigen::Index j = k + 1; j < x.size(); ++j) x[j] -= product * columns(j, k);
  }
}

}  // namespace

/// The matrix of many rows and its factorization.
template <class S>
struct ConstraintSolver<S>::Sparse {
  Eigen::SparseMatrix<S> matrix;  ///< lower triangle
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<S>> factor;
};

template <class S>
ConstraintSolver<S>::ConstraintSolver(const Problem& problem, std::vector<std::size_t> one,
                                      std::vector<std::size_t> two)
    : one_(std::move(one)), two_(std::move(two)) {
  for (std::size_t i = 0; i < problem.moving(); ++i) bodies_.emplace_back(problem.bodies[i]);
  rows_.resize(one_.size());
  first_.resize(one_.size());
  second_.resize(one_.size());
  inverse_inertia_.resize(bodies_.size());
  find_terms();
  if (rows_.size() <= most_dense_rows) dense_.resize(Eigen::Index(rows_.size()), Eigen::Index(rows_.size()));
  else find_pattern();
}

template <class S>
ConstraintSolver<S>::~ConstraintSolver() = default;

/// Lists the pairs of rows with a common body.
template <class S>
void ConstraintSolver<S>::find_terms() {
  std::vector<std::vector<std::pair<std::size_t, bool>>> rows_of(bodies_.size());
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (one_[r] != none) rows_of[one_[r]].emplace_back(r, false);
    if (two_[r] != none) rows_of[two_[r]].emplace_back(r, true);
  }
  for (const auto& list : rows_of) {
    for (const auto& [r, second_of_row] : list) {
      for (const auto& [c, second_of_column] : list) {
        if (r >= c) terms_.push_back({r, c, second_of_row, second_of_column, 0});
      }
    }
  }
}

template <class S>
void ConstraintSolver<S>::find_pattern() {
  std::vector<Eigen::Triplet<S>> triplets;
  for (const Term& t : terms_) triplets.emplace_back(int(t.row), int(t.column), S(1));
  sparse_ = std::make_unique<Sparse>();
  Eigen::SparseMatrix<S>& matrix = sparse_->matrix;
  matrix.resize(Eigen::Index(rows_.size()), Eigen::Index(rows_.size()));
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  matrix.makeCompressed();
  for (Term& t : terms_) {
    const int* begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[t.column];
    const int* end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[t.column + 1];
    t.entry = std::size_t(std::lower_bound(begin, end, int(t.row)) - matrix.innerIndexPtr());
  }
  sparse_->factor.analyzePattern(matrix);
}

template <class S>
void ConstraintSolver<S>::set(Motions motions) {
  motions_ = motions;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyConstants<S>& b = bodies_[i];
    const Matrix3<S>& r = motions[i].rotation;
    if (b.principal) inverse_inertia_[i].noalias() = r * b.inverse_moments.asDiagonal() * r.transpose();
    else inverse_inertia_[i].noalias() = r * b.inverse_inertia * r.transpose();
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (one_[k] != none) first_[k] = acceleration(one_[k], rows_[k].first);
    if (two_[k] != none) second_[k] = acceleration(two_[k], rows_[k].second);
  }
}

/// Calls put(term, value) for every term of G M⁻¹ Gᵀ.
template <class S>
template <class Put>
void ConstraintSolver<S>::add_terms(const Put& put) const {
  for (const Term& t : terms_) {
    const Wrench<S>& row = t.second_of_row ? rows_[t.row].second : rows_[t.row].first;
    const Wrench<S>& column = t.second_of_column ? second_[t.column] : first_[t.column];
    put(t, row.force.dot(column.force) + row.torque.dot(column.torque));
  }
}

/// Cholesky's factorization, written out: as Eigen's for six sizes and three scalars it compiles in a minute.
template <class S>
template <int n>
bool ConstraintSolver<S>::solve_small(const VectorX<S>& right, VectorX<S>& lambda) const {
  using std::sqrt;
  std::array<std::array<S, n>, n> factor{};  // the lower triangle
  add_terms([&](const Term& t, S value) { factor[t.row][t.column] += value; });
  for (std::size_t k = 0; k < n; ++k) {
    const S diagonal = soft(factor[k][k]);
    S sum(0);
    for (std::size_t j = 0; j < k; ++j) sum += factor[k][j] * factor[k][j];
    const S pivot = diagonal - sum;
    if (!(pivot > least_pivot<S>() * diagonal)) return false;
    factor[k][k] = sqrt(pivot);
    for (std::size_t i = k + 1; i < n; ++i) {
      S product(0);
      for (std::size_t j = 0; j < k; ++j) product += factor[i][j] * factor[k][j];
      factor[i][k] = (factor[i][k] - product) / factor[k][k];
    }
  }
  std::array<S, n> x;
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = right[Eigen::Index(i)];
    for (std::size_t j = 0; j < i; ++j) x[i] -= factor[i][j] * x[j];
    x[i] /= factor[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) x[i] -= factor[j][i] * x[j];
    x[i] /= factor[i][i];
    lambda[Eigen::Index(i)] = x[i];
  }
  return true;
}

template <class S>
bool ConstraintSolver<S>::solve_dense(const VectorX<S>& right, VectorX<S>& lambda) {
  dense_.setZero();
  add_terms([&](const Term& t, S value) { dense_(Eigen::Index(t.row), Eigen::Index(t.column)) += value; });
  for (Eigen::Index i = 0; i < dense_.rows(); ++i) dense_(i, i) = soft(dense_(i, i));
  diagonal_ = dense_.diagonal();
  const Eigen::LLT<Eigen::Ref<MatrixX>> factor(dense_);  // in place
  if (factor.info() != Eigen::Success) return false;
  for (Eigen::Index i = 0; i < dense_.rows(); ++i) {
    if (!(dense_(i, i) * dense_(i, i) > least_pivot<S>() * diagonal_[i])) return false;
  }
  lambda = right;
  solve_by_factor(dense_, lambda);
  return true;
}

template <class S>
bool ConstraintSolver<S>::solve_sparse(const VectorX<S>& right, VectorX<S>& lambda) {
  auto& [matrix, factor] = *sparse_;
  S* values = matrix.valuePtr();
  std::fill(values, values + matrix.nonZeros(), S(0));
  add_terms([&](const Term& t, S value) { values[t.entry] += value; });
  for (Eigen::Index i = 0; i < matrix.cols(); ++i) {  // the diagonal entry comes first in the lower triangle
    S& entry = values[matrix.outerIndexPtr()[i]];
    entry = soft(entry);
  }
  factor.factorize(matrix);
  if (factor.info() != Eigen::Success) return false;
  diagonal_ = matrix.diagonal();
  const auto pivots = factor.vectorD();
  const auto& order = factor.permutationP().indices();
  for (Eigen::Index i = 0; i < pivots.size(); ++i) {
    if (!(pivots[order[i]] > least_pivot<S>() * diagonal_[i])) return false;
  }
  lambda = factor.solve(right);
  return true;
}

template <class S>
bool ConstraintSolver<S>::solve_independent(const VectorX<S>& right, VectorX<S>& lambda) {
  lambda.resize(right.size());
  switch (rows_.size()) {
    case 1: return solve_small<1>(right, lambda);
    case 2: return solve_small<2>(right, lambda);
    case 3: return solve_small<3>(right, lambda);
    case 4: return solve_small<4>(right, lambda);
    case 5: return solve_small<5>(right, lambda);
    case most_small_rows: return solve_small<most_small_rows>(right, lambda);
    default: return rows_.size() <= most_dense_rows ? solve_dense(right, lambda) : solve_sparse(right, lambda);
  }
}

template <class S>
void ConstraintSolver<S>::solve(const VectorX<S>& right, VectorX<S>& lambda) {
  ++solved_;
  const bool by_rank = dependent_ && !(softness_ > S(0) || share_ > S(0));
  if (by_rank || !solve_independent(right, lambda)) solve_by_rank(right, lambda);
}

/// G M^(−1/2) with rows of unit length in that metric, and the inverse lengths.
template <class S>
auto ConstraintSolver<S>::weighted_rows(Motions motions) const -> std::pair<MatrixX, VectorX<S>> {
  using std::sqrt;
  const Eigen::Index n = Eigen::Index(rows_.size());
  MatrixX a = MatrixX::Zero(n, 6 * Eigen::Index(bodies_.size()));
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto place = [&](std::size_t i, const Wrench<S>& w) {
      const BodyConstants<S>& b = bodies_[i];
      a.template block<1, 3>(k, 6 * Eigen::Index(i)) += sqrt(inverse_mass(i)) * w.force.transpose();
      const Vector3<S> torque = b.axes.transpose() * (motions[i].rotation.transpose() * w.torque);
      a.template block<1, 3>(k, 6 * Eigen::Index(i) + 3) +=
          b.inverse_moments.cwiseSqrt().cwiseProduct(torque).transpose();
    };
    const std::size_t r = std::size_t(k);
    if (one_[r] != none) place(one_[r], rows_[r].first);
    if (two_[r] != none) place(two_[r], rows_[r].second);
  }
  VectorX<S> scale(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const S length = a.row(k).norm();
    scale[k] = length > S(0) ? S(1) / length : S(1);
    a.row(k) *= scale[k];
  }
  return {std::move(a), std::move(scale)};
}

/// λ = (A Aᵀ)⁺ right, A the weighted rows: Aᵀ λ is the smallest correction of the accelerations, and λ has the least
/// norm. A P = Q Tᵀ with the independent columns of Tᵀ, and T P' = Q' R; hence λ = Q P' R⁻¹ R⁻ᵀ P'ᵀ Qᵀ right. Eigen's
/// complete orthogonal decomposition, twice, gives the same: the step of a mechanism takes 1.2 times as long then, and
/// this file twice as long to compile.
template <class S>
void ConstraintSolver<S>::solve_by_rank(const VectorX<S>& right, VectorX<S>& lambda) const {
  const auto [a, scale] = weighted_rows(motions_);
  Eigen::ColPivHouseholderQR<MatrixX> of_rows;
  of_rows.setThreshold(threshold());
  of_rows.compute(a);
  const Eigen::Index rank = of_rows.rank();
  if (rank == 0) {  // no row, or numbers that are not finite
    lambda = VectorX<S>::Zero(right.size());
    return;
  }
  MatrixX t = MatrixX::Zero(a.cols(), rank);
  for (Eigen::Index i = 0; i < rank; ++i) {
    for (Eigen::Index j = i; j < a.cols(); ++j) t(j, i) = of_rows.matrixQR()(i, j);
  }
  const Eigen::ColPivHouseholderQR<MatrixX> of_columns(t);
  MatrixX lower = MatrixX::Zero(rank, rank);  // Rᵀ
  for (Eigen::Index i = 0; i < rank; ++i) {
    for (Eigen::Index j = i; j < rank; ++j) lower(j, i) = of_columns.matrixQR()(i, j);
  }
  VectorX<S> whole = scale.cwiseProduct(right);
  reflect(of_rows, rank, true, whole);
  const auto& order = of_columns.colsPermutation().indices();
  VectorX<S> x(rank);
  for (Eigen::Index i = 0; i < rank; ++i) x[i] = whole[order[i]];
  solve_by_factor(lower, x);
  whole.setZero();
  for (Eigen::Index i = 0; i < rank; ++i) whole[order[i]] = x[i];
  reflect(of_rows, rank, false, whole);
  lambda = scale.cwiseProduct(whole);
}

/// Relative size of a pivot below which a row counts as dependent. Drift of the positions perturbs the pivot of a row
/// that depends on others everywhere, so that the threshold for such joints is wide.
template <class S>
S ConstraintSolver<S>::threshold() const {
  using std::pow;
  return dependent_ ? pow(std::numeric_limits<S>::epsilon(), S(0.4)) : pow(std::numeric_limits<S>::epsilon(), S(0.7));
}

template <class S>
auto ConstraintSolver<S>::rank(Motions motions) const -> Rank {
  Rank found;
  if (rows_.empty()) return found;
  const auto [a, scale] = weighted_rows(motions);
  // Pivots of the transpose: its columns are the rows of the joints.
  const MatrixX columns = a.transpose();
  Eigen::ColPivHouseholderQR<MatrixX> qr;
  qr.setThreshold(threshold());
  qr.compute(columns);
  found.rank = std::size_t(qr.rank());
  const auto pivots = qr.matrixQR().diagonal().cwiseAbs();
  if (found.rank > 0) found.condition = double(pivots[0] / pivots[qr.rank() - 1]);
  for (Eigen::Index k = qr.rank(); k < Eigen::Index(rows_.size()); ++k) {
    found.dependent.push_back(std::size_t(qr.colsPermutation().indices()[k]));
  }
  return found;
}

template class ConstraintSolver<float>;
template class ConstraintSolver<double>;
template class ConstraintSolver<long double>;

}  // namespace polhode::core::system
