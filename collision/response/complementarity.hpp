// SPDX-License-Identifier: BSD-3-Clause
// The linear complementarity problem of a symmetric matrix that is positive semidefinite: j >= 0, w = A j + b >= 0, j·w
// = 0.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace polhode::inline collision::inline response {

/// Solves it by principal pivoting (Dantzig & Cottle, 1968; Cottle, Pang & Stone, 1992, section 4.3), in the order of
/// Lawson & Hanson (1974). Each pivot lowers ½ j·A j + b·j, so no set of positive impulses recurs, and the method
/// terminates. Of linearly dependent columns, such as those of the corners of a face, only independent ones are in the
/// basis; w does not depend on the choice.
class Complementarity {
 public:
  /// Starts from the given j, which must be non-negative, and replaces it by the solution. False: there is no solution,
  /// or rounding hides it.
  bool solve(const Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>& a,
             const Eigen::Ref<const Eigen::VectorXd>& b, Eigen::Ref<Eigen::VectorXd> j);

 private:
  using Matrix = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

  bool append(const Matrix& a, Eigen::Index i);
  void remove(const Matrix& a, std::size_t place);
  bool factor_row(const Matrix& a, std::size_t row);
  void solve_lower(std::size_t count);
  void solve_upper(std::size_t count);
  void settle(const Matrix& a, const Eigen::Ref<const Eigen::VectorXd>& b, Eigen::Ref<Eigen::VectorXd> j);

  std::vector<Eigen::Index> basis_;  ///< indices of the positive impulses
  std::vector<std::uint8_t> carries_, barred_;
  Eigen::MatrixXd lower_;  ///< Cholesky's factor of A on the basis
  Eigen::VectorXd x_;
};

}  // namespace polhode::collision::response
