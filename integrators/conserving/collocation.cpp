// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/conserving/collocation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::inline integrators {

template <class S>
CollocationSolver<S>::CollocationSolver(const Ode<S>& ode, int stages)
    : ode_(&ode), stages_(stages), a_(stages, stages), c_(stages), d_(stages) {
  using std::sqrt;
  if (stages == 1) {
    c_ << S(1) / S(2);
    a_ << S(1) / S(2);
    d_ << S(2);
  } else if (stages == 2) {
    const S r = sqrt(S(3));
    c_ << S(1) / S(2) - r / S(6), S(1) / S(2) + r / S(6);
    a_ << S(1) / S(4), S(1) / S(4) - r / S(6),  //
        S(1) / S(4) + r / S(6), S(1) / S(4);
    d_ << -r, r;
  } else {
    const S r = sqrt(S(15));
    c_ << S(1) / S(2) - r / S(10), S(1) / S(2), S(1) / S(2) + r / S(10);
    a_ << S(5) / S(36), S(2) / S(9) - r / S(15), S(5) / S(36) - r / S(30),  //
        S(5) / S(36) + r / S(24), S(2) / S(9), S(5) / S(36) - r / S(24),    //
        S(5) / S(36) + r / S(30), S(2) / S(9) + r / S(15), S(5) / S(36);
    d_ << S(5) / S(3), S(-4) / S(3), S(5) / S(3);
  }
  const Eigen::Index n = ode.size();
  jacobian_ = Matrix::Zero(n, n);
  y_ = stage_ = dy_ = moved_ = Vector::Zero(n);
  z_ = delta_ = Vector::Zero(n * stages);
}

/// Computes ∂f/∂y by forward differences. The column of the work is zero, because f does not depend on it.
template <class S>
void CollocationSolver<S>::differentiate(S t, const Vector& y) {
  using std::abs, std::sqrt;
  const S root = sqrt(std::numeric_limits<S>::epsilon());
  const S size = y.cwiseAbs().maxCoeff();
  rate(t, y, dy_);
  Vector at = y;
  for (Eigen::Index k = 0; k + 1 < y.size(); ++k) {
    const S distance = root * std::max(abs(y[k]), size > S(0) ? size / S(1000) : S(1));
    at[k] = y[k] + distance;
    rate(t, at, moved_);
    jacobian_.col(k) = (moved_ - dy_) / (at[k] - y[k]);
    at[k] = y[k];
  }
}

template <class S>
void CollocationSolver<S>::factorise(S h) {
  const Eigen::Index n = y_.size();
  Matrix m = Matrix::Identity(n * stages_, n * stages_);
  for (int i = 0; i < stages_; ++i) {
    for (int j = 0; j < stages_; ++j) m.block(i * n, j * n, n, n) -= (h * a_(i, j)) * jacobian_;
  }
  factors_.compute(m);
  factored_h_ = h;
}

/// Newton iteration for Z from 0. True if it converges until ΔZ is round-off.
template <class S>
bool CollocationSolver<S>::solve(S t, S h) {
  const S epsilon = std::numeric_limits<S>::epsilon();
  const Eigen::Index n = y_.size();
  z_.setZero();
  S previous(0);
  for (int iteration = 0; iteration < 50; ++iteration) {
    ++iterations_;
    delta_ = -z_;
    for (int j = 0; j < stages_; ++j) {
      stage_ = y_ + z_.segment(j * n, n);
      rate(t + c_[j] * h, stage_, dy_);
      for (int i = 0; i < stages_; ++i) delta_.segment(i * n, n) += (h * a_(i, j)) * dy_;
    }
    delta_ = factors_.solve(delta_).eval();
    z_ += delta_;
    const S change = delta_.cwiseAbs().maxCoeff();
    if (!z_.allFinite()) return false;
    const S size = std::max(y_.cwiseAbs().maxCoeff(), z_.cwiseAbs().maxCoeff());
    if (change <= epsilon / S(8) * size) return true;
    if (iteration > 0) {
      if (change > S(0.05) * previous && change > S(1000) * epsilon * size) jacobian_fits_ = false;
      if (change > S(0.5) * previous) {
        if (change <= S(1000) * epsilon * size) return true;  // the residual is at round-off level
        stage_ = y_;
        for (int j = 0; j < stages_; ++j) stage_ += z_.segment(j * n, n) / S(stages_);
        const Vector mean = stage_;
        differentiate(t + h / S(2), mean);
        factorise(h);
      }
    }
    previous = change;
  }
  return false;
}

template <class S>
const char* CollocationSolver<S>::step(S t, S h, S* y) {
  Eigen::Map<Vector> end(y, y_.size());
  y_ = end;
  for (const bool kept : {true, false}) {
    if (kept && !jacobian_fits_) continue;
    if (!kept) {
      differentiate(t, y_);
      jacobian_fits_ = true;
    }
    if (!kept || h != factored_h_) factorise(h);
    if (solve(t, h)) {
      for (int i = 0; i < stages_; ++i) end += d_[i] * z_.segment(i * y_.size(), y_.size());
      return nullptr;
    }
  }
  jacobian_fits_ = false;
  return "Newton's iteration for the stages did not converge";
}

template class CollocationSolver<float>;
template class CollocationSolver<double>;
template class CollocationSolver<long double>;

std::string refuse_large_system(int stages, const Problem& problem, const Formulation& formulation) {
  constexpr double most_memory = 4e9;  // memory of the matrix in double, bytes; its factors take as much again
  const int unknowns = stages * layout_of(problem, formulation).size();
  const double memory = 8.0 * unknowns * unknowns;
  if (memory <= most_memory) return {};
  return "its stages solve a dense linear system of " + std::to_string(unknowns) + " unknowns, " +
         std::to_string(std::lround(memory / 1e9)) + " GB; take a method that solves none, or fewer bodies";
}

}  // namespace polhode::integrators
