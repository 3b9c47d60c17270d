// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/faulty_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace polhode::study::judge {
namespace {

using Slot = Layout::Slot;

auto spin(VectorX<double>& y, const Slot& s) { return y.segment<3>(s.angular); }
auto attitude(VectorX<double>& y, const Slot& s) { return y.segment<4>(s.orientation); }
Vector3<double> spin(const VectorX<double>& y, const Slot& s) { return y.segment<3>(s.angular); }
Quaternion<double> attitude(const VectorX<double>& y, const Slot& s) { return y.segment<4>(s.orientation); }

Quaternion<double> turn_by(const Vector3<double>& phi, FirstOrderStep::Turn turn) {
  const double angle = phi.norm();
  switch (turn) {
    case FirstOrderStep::Turn::exponential: return quaternion_from_rotation_vector(phi);
    case FirstOrderStep::Turn::quaternion:
      return Quaternion<double>(1, phi[0] / 2, phi[1] / 2, phi[2] / 2).normalized();
    default:  // the polar factor of 1 + [φ] turns by atan |φ|
      return angle > 0 ? quaternion_from_rotation_vector(Vector3<double>(phi * (std::atan(angle) / angle)))
                       : identity_quaternion<double>();
  }
}

}  // namespace

std::string FirstOrderStep::words() const {
  const std::string what = state == State::velocity_world  ? "ω in world axes"
                           : state == State::velocity_body ? "ω in body axes"
                                                           : "L";
  const std::string chart = turn == Turn::exponential ? "exp(hω)" : turn == Turn::quaternion ? "q + ½hωq" : "R + h[ω]R";
  return (order == Order::together         ? "explicit Euler"
          : order == Order::velocity_first ? "semi-implicit Euler"
                                           : "semi-implicit Euler, attitude first") +
         (" with " + what + " and " + chart);
}

FaultyMotion::FaultyMotion(const Problem& problem, const Equations& equations)
    : equations_(equations),
      system_(make_system<double>(problem, {Orientation::quaternion, AngularState::velocity_world, false})) {}

void FaultyMotion::rate(double t, const VectorX<double>& y, VectorX<double>& dy) const {
  using Frame = Equations::Frame;
  const auto& slots = system_->layout().slots;
  dy.resize(y.size());
  if (equations_.frame == Frame::body_turns_world) {  // the slots hold Ω, and forces read ω
    VectorX<double> seen = y;
    change_slots(seen, false);
    system_->rate(t, seen.data(), dy.data());
  } else {
    system_->rate(t, y.data(), dy.data());
  }
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const Slot& s = slots[i];
    const Quaternion<double> q = attitude(y, s);
    const Vector3<double> w = spin(y, s);
    const Matrix3<double> r = rotation_matrix(q);
    const Matrix3<double>&inertia = system_->problem().bodies[i].inertia, &inverse = system_->inverse_inertia(i);
    const Vector3<double> by_torque = r.transpose() * spin(std::as_const(dy), s);  // I⁻¹ Rᵀ τ
    const auto gyroscopic = [&](const Vector3<double>& omega) -> Vector3<double> {
      return equations_.gyroscopic * (inverse * omega.cross(inertia * omega));
    };
    Quaternion<double> turning;
    switch (equations_.frame) {
      case Frame::inertia_not_turned:
        spin(dy, s) = inverse * (r * (inertia * by_torque)) - gyroscopic(w);
        turning = product(pure(w), q);
        break;
      case Frame::body_turns_world:
        spin(dy, s) = by_torque - gyroscopic(w);
        turning = product(pure(w), q);
        break;
      default:
        spin(dy, s) -= r * gyroscopic(r.transpose() * w);
        turning = equations_.frame == Frame::right ? product(pure(w), q) : product(q, pure(w));
    }
    attitude(dy, s) = (equations_.turning / 2) * turning;
  }
}

/// Replaces ω by Ω in the slots of the angular velocities, or Ω by ω.
void FaultyMotion::change_slots(VectorX<double>& y, bool to_body) const {
  for (const Slot& s : system_->layout().slots) {
    const Matrix3<double> r = rotation_matrix(attitude(std::as_const(y), s));
    spin(y, s) = to_body ? Vector3<double>(r.transpose() * spin(std::as_const(y), s))
                         : Vector3<double>(r * spin(std::as_const(y), s));
  }
}

/// One step from y by the extrapolated midpoint rule with 2, 4, 6 and 8 substeps. The error estimate is the change by
/// the last extrapolation.
bool FaultyMotion::extrapolate(double t, double h, const VectorX<double>& y, VectorX<double>& next,
                               double& error) const {
  constexpr int columns = 4;
  std::array<VectorX<double>, columns> row;
  VectorX<double> first, now, before, there, change;
  rate(t, y, first);
  for (int j = 0; j < columns; ++j) {
    const int n = 2 * (j + 1);
    const double small = h / n;
    before = y;
    now = y + small * first;
    for (int i = 1; i < n; ++i) {
      rate(t + i * small, now, change);
      there = before + 2 * small * change;
      before.swap(now);
      now.swap(there);
    }
    for (int k = 0; k < j; ++k) {  // Aitken and Neville
      const double ratio = (j + 1.0) / (j - k);
      there = now + (now - row[std::size_t(k)]) / (ratio * ratio - 1);
      row[std::size_t(k)] = now;
      now = there;
    }
    row[std::size_t(j)] = now;
  }
  next = now;
  error = 0;
  const VectorX<double> last = now - row[columns - 2];
  for (const Slot& s : system_->layout().slots) {
    const double size = std::max(spin(y, s).norm(), std::abs(1 / h));
    error = std::max({error, attitude(last, s).norm(), spin(last, s).norm() / size});
  }
  return next.allFinite();
}

bool FaultyMotion::advance(double t, double span, VectorX<double>& y) const {
  constexpr double tolerance = 1e-11, longest_turn = 0.7;  // rotation in the first step, rad
  constexpr int most_steps = 1000;
  if (span == 0) return true;
  if (equations_.frame == Equations::Frame::body_turns_world) change_slots(y, true);
  double fastest = 0;
  for (const Slot& s : system_->layout().slots) fastest = std::max(fastest, spin(std::as_const(y), s).norm());
  double h = fastest * std::abs(span) > longest_turn ? std::copysign(longest_turn / fastest, span) : span, done = 0;
  VectorX<double> next;
  for (int i = 0; done != span; ++i) {
    if (i == most_steps) return false;
    const bool last = std::abs(span - done) <= std::abs(h) * (1 + 1e-9);
    const double now = last ? span - done : h;
    double error = 0;
    const bool finite = extrapolate(t + done, now, y, next, error);
    if (!finite || !(error <= tolerance)) {
      h = now / 2;
      continue;
    }
    y.swap(next);
    done = last ? span : done + now;
    if (error < tolerance / 1024) h = now * 1.5;
  }
  for (const Slot& s : system_->layout().slots) attitude(y, s).normalize();
  if (equations_.frame == Equations::Frame::body_turns_world) change_slots(y, false);
  return true;
}

void FaultyMotion::step(double t, double h, const FirstOrderStep& by, VectorX<double>& y) const {
  using Order = FirstOrderStep::Order;
  using State = FirstOrderStep::State;
  const auto& slots = system_->layout().slots;
  VectorX<double> dy, old = y;
  const auto speed_up = [&] {  // all that is not attitude or position, by the rates in dy
    for (const Slot& s : slots) {
      if (s.velocity >= 0) y.segment<3>(s.velocity) += h * dy.segment<3>(s.velocity);
    }
    y[system_->layout().work()] += h * dy[system_->layout().work()];
  };
  const auto turn = [&](std::size_t i, const Vector3<double>& omega) {
    const Slot& s = slots[i];
    const Quaternion<double> q = attitude(std::as_const(y), s);
    attitude(y, s) = product(turn_by(h * equations_.turning * omega, by.turn), q);
    if (s.position >= 0) {
      const auto& v = by.order == Order::velocity_first ? y : old;
      y.segment<3>(s.position) += h * v.segment<3>(s.velocity);
    }
  };
  const auto rotation_of = [&](const Slot& s) { return rotation_matrix(attitude(std::as_const(y), s)); };
  if (by.order == Order::attitude_first) {
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const Slot& s = slots[i];
      const Matrix3<double> before = rotation_of(s), &inertia = system_->problem().bodies[i].inertia;
      const Vector3<double> omega = spin(std::as_const(y), s), in_body = before.transpose() * omega;
      turn(i, omega);
      const Matrix3<double> now = rotation_of(s);
      if (by.state == State::velocity_body) spin(y, s) = now * in_body;
      if (by.state == State::momentum_world) {
        spin(y, s) = now * (system_->inverse_inertia(i) * (now.transpose() * (before * (inertia * in_body))));
      }
    }
  }
  rate(t, y, dy);
  speed_up();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const Slot& s = slots[i];
    const Matrix3<double>&inertia = system_->problem().bodies[i].inertia, &inverse = system_->inverse_inertia(i);
    const Matrix3<double> r = rotation_of(s);
    const Vector3<double> omega = spin(std::as_const(y), s), body = r.transpose() * omega;
    Vector3<double> acceleration = spin(std::as_const(dy), s);
    if (by.state == State::momentum_world) {  // L̇ = τ
      acceleration += r * (equations_.gyroscopic * (inverse * body.cross(inertia * body)));
      const Vector3<double> momentum = r * (inertia * (body + h * (r.transpose() * acceleration)));
      const auto rate_at = [&](const Matrix3<double>& at) -> Vector3<double> {
        return at * (inverse * (at.transpose() * momentum));
      };
      if (by.order != Order::attitude_first) turn(i, by.order == Order::together ? omega : rate_at(r));
      spin(y, s) = rate_at(rotation_of(s));
      continue;
    }
    const Vector3<double> now = omega + h * acceleration;
    if (by.order != Order::attitude_first) turn(i, by.order == Order::together ? omega : now);
    spin(y, s) = by.state == State::velocity_body ? Vector3<double>(rotation_of(s) * (r.transpose() * now)) : now;
  }
}

}  // namespace polhode::study::judge
