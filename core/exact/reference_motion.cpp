// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/reference_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"

namespace polhode::inline core::inline exact {
namespace {

using Real = long double;
using Flat = VectorX<Real>;

constexpr int columns = 8;  // columns of the extrapolation; its order is twice this number
constexpr int rates_per_step = columns * columns + 1;
/// Limit of right-hand sides of one body in the finest attempt; about two seconds of computation.
constexpr double budget = 4e6;
/// Sufficient uncertainty (rad, or relative): the round-off of double divided by 100, because a reference must be 100
/// times more accurate than the results that it judges.
constexpr double enough = 1e-17;

/// Extrapolation of the midpoint rule with 2, 4, … 16 substeps.
class Stepper {
 public:
  explicit Stepper(const System<Real>& system) : system_(system) {}

  /// Advances y by one step of size `big` (s) from time t (s). The extrapolation works on increments of y, so that it
  /// amplifies their round-off and not the round-off of y.
  void step(Real t, Real big, Flat& y) {
    rate(t, y);
    const Flat first = rate_;
    for (int j = 0; j < columns; ++j) {
      const int n = 2 * (j + 1);
      const Real h = big / Real(n);
      before_.setZero(y.size());
      now_ = h * first;
      for (int i = 1; i < n; ++i) {
        at_ = y + now_;
        rate(t + h * Real(i), at_);
        before_ += 2 * h * rate_;
        before_.swap(now_);
      }
      for (int k = 0; k < j; ++k) {  // Aitken–Neville with the abscissae n_j²
        const Real ratio = Real(j + 1) / Real(j - k);
        Flat& behind = row_[std::size_t(k)];
        at_ = now_ + (now_ - behind) / (ratio * ratio - 1);
        behind.swap(now_);
        now_.swap(at_);
      }
      row_[std::size_t(j)] = now_;
    }
    y += now_;
  }

 private:
  void rate(Real t, const Flat& y) {
    rate_.resize(y.size());
    system_.rate(t, y.data(), rate_.data());
  }

  const System<Real>& system_;
  Flat rate_, before_, now_, at_;
  std::array<Flat, columns> row_;  // row T_{j,1} … T_{j,j} of the extrapolation table for the last j
};

/// Time of an evaluation of the right-hand side in that of one free body. Equations of joints that depend on each other
/// are factorized with their rank, which costs the cube of their number.
double cost_of(const System<Real>& system) {
  const double bodies = static_cast<double>(system.moving());
  if (!system.has_joints()) return bodies;
  const double rows = static_cast<double>(system.constraints()->rows());
  return bodies + (system.constraints()->dependent() ? rows * rows * rows / 40 : rows);
}

void raise(double& worst, Real x) {
  if (!(x <= Real(worst))) worst = std::isfinite(x) ? static_cast<double>(x) : std::numeric_limits<double>::infinity();
}

}  // namespace

double ReferenceMotion::Uncertainty::largest() const { return std::max({position, attitude, angular_velocity}); }

ReferenceMotion::ReferenceMotion(const Problem& problem, bool gyroscopic, double t_end, const std::atomic<bool>* stop,
                                 std::function<void(System<long double>&)> prepare)
    : problem_(problem), gyroscopic_(gyroscopic), prepare_(std::move(prepare)), t_end_(t_end) {
  double fastest = 0;
  for (std::size_t i = 0; i < problem.moving(); ++i) {
    fastest = std::max(fastest, problem.starts[i].angular_velocity.norm());
  }
  if (fastest > 0) speed_scale_ = fastest;
  constexpr double unknown = std::numeric_limits<double>::infinity();
  uncertainty_ = {unknown, unknown, unknown};
  const auto system = make();
  const double most = std::max(4.0, budget / (cost_of(*system) * intervals * rates_per_step));
  states_ = march(*system, steps_, stop);
  double before = unknown;
  for (int finer = 2; finer <= most && !(stop && *stop); finer *= 2) {
    std::vector<Flat> states = march(*system, finer, stop);
    if (stop && *stop) break;
    const Uncertainty change = difference(*system, states_, states);
    const double now = change.largest();
    if (now >= before && before < 1e-10) break;  // round-off dominates: keep the previous states
    uncertainty_ = change;
    states_ = std::move(states);
    steps_ = finer;
    if (now <= enough || (now > before / 4 && now < 1e-10)) break;
    before = now;
  }
}

std::unique_ptr<System<long double>> ReferenceMotion::make() const {
  Formulation formulation{Orientation::quaternion, AngularState::velocity_body, gyroscopic_};
  formulation.joints.stabilization = Stabilization::both;
  auto system = make_system<Real>(problem_, formulation);
  if (prepare_) prepare_(*system);
  return system;
}

std::vector<Flat> ReferenceMotion::march(const System<Real>& system, int steps, const std::atomic<bool>* stop) const {
  std::vector<Flat> states = {system.start().y};
  Stepper stepper(system);
  for (std::size_t k = 0; k < intervals; ++k) {
    Flat y = states.back();
    const Real from = instant(k), big = (Real(instant(k + 1)) - from) / Real(steps);
    for (int i = 0; i < steps; ++i) {
      if (stop && *stop) return states;
      stepper.step(from + big * Real(i), big, y);
      project_joints(system, y);
    }
    if (!y.allFinite()) break;
    states.push_back(std::move(y));
  }
  return states;
}

ReferenceMotion::Uncertainty ReferenceMotion::difference(const System<Real>& system, const std::vector<Flat>& a,
                                                         const std::vector<Flat>& b) const {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  if (a.size() != intervals + 1 || b.size() != intervals + 1) return {unknown, unknown, unknown};
  Uncertainty worst;
  for (std::size_t k = 0; k <= intervals; ++k) {
    for (std::size_t i = 0; i < system.moving(); ++i) {
      const BodySnapshot<Real> one = system.snapshot(a[k], i), two = system.snapshot(b[k], i);
      if (!problem_.bodies[i].pinned) raise(worst.position, (one.position - two.position).norm());
      raise(worst.attitude, angle_between<Real>(one.orientation, two.orientation));
      raise(worst.angular_velocity, (one.angular_velocity - two.angular_velocity).norm() / Real(speed_scale_));
    }
  }
  return worst;
}

ReferenceMotion::Follower::Follower(std::shared_ptr<const ReferenceMotion> reference)
    : reference_(std::move(reference)), system_(reference_->make()), y_(reference_->states_.front()) {}

const VectorX<Real>& ReferenceMotion::Follower::at(double t) {
  const ReferenceMotion& reference = *reference_;
  const double interval = reference.t_end_ / intervals;
  const std::size_t last = reference.states_.size() - 1;
  std::size_t k = std::min(last, static_cast<std::size_t>(std::max(0.0, t / interval)));
  while (k > 0 && reference.instant(k) > t) --k;
  if (t_ > t || reference.instant(k) >= t_) {
    t_ = reference.instant(k);
    y_ = reference.states_[k];
  }
  if (t > t_) {
    const Real span = Real(t) - Real(t_), size = Real(interval) / Real(reference.steps_);
    const int steps = std::max(1, static_cast<int>(std::ceil(span / size * (1 - Real(1e-15)))));
    const Real big = span / Real(steps);
    Stepper stepper(*system_);
    for (int i = 0; i < steps; ++i) stepper.step(Real(t_) + big * Real(i), big, y_);
    t_ = t;
  }
  return y_;
}

ExactMotion::Error ReferenceMotion::Follower::error(const System<double>& system, const State<double>& state) {
  const ReferenceMotion& reference = *reference_;
  at(state.t);
  ExactMotion::Error error;
  const auto keep = [](std::optional<double>& worst, Real x) {
    if (!worst || !(x <= Real(*worst))) worst = static_cast<double>(x);
  };
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const BodySnapshot<double> now = system.snapshot(state.y, i);
    const BodySnapshot<Real> right = system_->snapshot(y_, i);
    if (!reference.problem_.bodies[i].pinned) keep(error.position, (now.position.cast<Real>() - right.position).norm());
    keep(error.attitude, angle_between<Real>(now.orientation.cast<Real>(), right.orientation));
    keep(error.angular_velocity,
         (now.angular_velocity.cast<Real>() - right.angular_velocity).norm() / Real(reference.speed_scale_));
  }
  return error;
}

}  // namespace polhode::core::exact
