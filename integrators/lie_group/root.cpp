// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/lie_group/root.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::inline integrators {
namespace {

constexpr int broyden_iterations = 20, newton_iterations = 40;

/// Convergence test of an iteration that runs until round-off dominates.
template <class S>
class Progress {
 public:
  explicit Progress(S scale) : near_(S(256) * epsilon * scale), nothing_(epsilon * epsilon * scale) {}

  /// True if the iteration has converged: the step is below the round-off of every unknown, or it is small and no
  /// longer decreases by half, or no sum with it would differ. An unknown whose solution is 0 ends by the last.
  bool done(const VectorX<S>& x, const VectorX<S>& step) {
    const S size = step.cwiseAbs().maxCoeff();
    const bool below = (step.array().abs() <= epsilon * x.array().abs()).all();
    const bool stagnant = size <= near_ && last_ <= near_ && size > last_ / S(2);
    last_ = size;
    return below || stagnant || size <= nothing_;
  }
  S size() const { return last_; }

 private:
  static constexpr S epsilon = std::numeric_limits<S>::epsilon();
  S near_, nothing_, last_ = std::numeric_limits<S>::infinity();
};

}  // namespace

template <class S>
const char* RootFinder<S>::solve(StepEquations<S>& equations, VectorX<S>& x, S scale) {
  guess_ = x;
  if (broyden(equations, x, scale)) return nullptr;
  x = guess_;
  return newton(equations, x, scale) ? nullptr : "Newton's iteration for the implicit step did not converge";
}

template <class S>
bool RootFinder<S>::broyden(StepEquations<S>& equations, VectorX<S>& x, S scale) {
  f_.resizeLike(x);
  steps_.resize(broyden_iterations + 1);
  squares_.resize(broyden_iterations + 1);
  Progress<S> progress(scale);
  S first(0);
  equations.residual(x, f_);
  steps_[0] = -f_;
  for (std::size_t k = 0; k < broyden_iterations; ++k) {
    ++iterations_;
    x += steps_[k];
    if (progress.done(x, steps_[k])) return true;
    if (k == 0) first = progress.size();
    if (!(progress.size() <= S(4) * first)) return false;
    squares_[k] = steps_[k].squaredNorm();
    equations.residual(x, f_);
    f_ = -f_;
    for (std::size_t j = 0; j < k; ++j) f_ += steps_[j + 1] * (steps_[j].dot(f_) / squares_[j]);
    const S remains = S(1) - steps_[k].dot(f_) / squares_[k];
    if (!(remains > S(0.05))) return false;
    steps_[k + 1] = f_ / remains;
  }
  return false;
}

template <class S>
bool RootFinder<S>::newton(StepEquations<S>& equations, VectorX<S>& x, S scale) {
  using std::abs, std::sqrt;
  const S increment = sqrt(std::numeric_limits<S>::epsilon());
  const Eigen::Index n = x.size();
  jacobian_.resize(n, n);
  moved_.resizeLike(x);
  Progress<S> progress(scale);
  for (int k = 0; k < newton_iterations; ++k) {
    ++iterations_;
    equations.residual(x, f_);
    if (!f_.allFinite()) return false;
    for (Eigen::Index j = 0; j < n; ++j) {
      const S kept = x[j];
      x[j] += increment * std::max(S(1), abs(kept));
      const S change = x[j] - kept;
      equations.residual(x, moved_);
      jacobian_.col(j) = (moved_ - f_) / change;
      x[j] = kept;
    }
    moved_ = -jacobian_.partialPivLu().solve(f_);
    if (!moved_.allFinite()) return false;
    x += moved_;
    if (progress.done(x, moved_)) return true;
  }
  return false;
}

template class RootFinder<float>;
template class RootFinder<double>;
template class RootFinder<long double>;

}  // namespace polhode::integrators
