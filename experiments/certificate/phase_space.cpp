// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/phase_space.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/system/joint_projection.hpp"
#include "core/system/orientation_chart.hpp"

namespace polhode::study::certificate {
namespace {

template <class S>
void store_orientation(Orientation chart, const Quaternion<S>& q, S* to) {
  if (chart == Orientation::quaternion) {
    Chart<S, Orientation::quaternion>::store(q, to);
  } else {
    Chart<S, Orientation::matrix>::store(rotation_matrix<S>(q), to);
  }
}

template <class S>
Quaternion<S> unit(const Quaternion<S>& q) {
  using std::sqrt;
  return q / sqrt(q.squaredNorm());
}

}  // namespace

template <class S>
PhaseSpace<S>::PhaseSpace(const System<S>& system) : system_(system) {
  using std::sqrt;
  const VectorX<S> y = system.start().y;
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const Body& body = system.problem().bodies[i];
    const S speed = system.snapshot(y, i).angular_velocity.norm();
    lengths_.push_back(S(std::sqrt(body.inertia.trace() / (2 * body.mass))));
    action_ = std::max(action_, S(body.inertia.norm()) * std::max(speed, S(1)));
    dimension_ += body.pinned ? 6 : 12;
  }
}

template <class S>
PhasePoint<S> PhaseSpace<S>::generic() const {
  VectorX<S> by(dimension_);
  for (int k = 0; k < dimension_; ++k) by[k] = std::sin(S(1 + 2 * k)) / S(3);
  return moved(start(), by);
}

template <class S>
PhasePoint<S> PhaseSpace<S>::point(VectorX<S> y) const {
  system_.project(y);
  PhasePoint<S> point;
  for (std::size_t i = 0; i < system_.moving(); ++i) {
    const BodySnapshot<S> now = system_.snapshot(y, i);
    point.bodies.push_back({.position = now.position,
                            .attitude = unit<S>(now.orientation),
                            .momentum = S(system_.problem().bodies[i].mass) * now.velocity,
                            .body_momentum = now.rotation.transpose() * now.angular_momentum});
  }
  return point;
}

template <class S>
VectorX<S> PhaseSpace<S>::state(const PhasePoint<S>& point) const {
  const Formulation& f = system_.formulation();
  VectorX<S> y = VectorX<S>::Zero(system_.layout().size());
  for (std::size_t i = 0; i < system_.moving(); ++i) {
    const Layout::Slot& slot = system_.layout().slots[i];
    const Body& body = system_.problem().bodies[i];
    const auto& at = point.bodies[i];
    store_orientation<S>(f.orientation, at.attitude, y.data() + slot.orientation);
    const Matrix3<S> r = rotation_matrix<S>(at.attitude);
    const Vector3<S> omega = body.inertia.cast<S>().inverse() * at.body_momentum;
    switch (f.angular_state) {
      case AngularState::velocity_world: y.template segment<3>(slot.angular) = r * omega; break;
      case AngularState::velocity_body: y.template segment<3>(slot.angular) = omega; break;
      default: y.template segment<3>(slot.angular) = r * at.body_momentum;
    }
    if (body.pinned) continue;
    y.template segment<3>(slot.position) = at.position;
    y.template segment<3>(slot.velocity) = at.momentum / S(body.mass);
  }
  return y;
}

template <class S>
PhasePoint<S> PhaseSpace<S>::moved(const PhasePoint<S>& from, const VectorX<S>& by) const {
  PhasePoint<S> to = from;
  int k = 0;
  const auto next = [&] { return Vector3<S>(by.template segment<3>((k += 3) - 3)); };
  for (std::size_t i = 0; i < to.bodies.size(); ++i) {
    auto& body = to.bodies[i];
    const bool free = !system_.problem().bodies[i].pinned;
    if (free) body.position += lengths_[i] * next();
    body.attitude = unit<S>(product<S>(body.attitude, quaternion_from_rotation_vector<S>(next())));
    if (free) body.momentum += action_ / lengths_[i] * next();
    body.body_momentum += action_ * next();
  }
  if (!system_.has_joints()) return to;
  VectorX<S> y = state(to);
  project_joint_positions(system_, y);
  project_joint_velocities(system_, y);
  return point(std::move(y));
}

template <class S>
VectorX<S> PhaseSpace<S>::coordinates(const PhasePoint<S>& from, const PhasePoint<S>& to) const {
  VectorX<S> all(dimension_);
  int k = 0;
  const auto put = [&](const Vector3<S>& part) { all.template segment<3>((k += 3) - 3) = part; };
  for (std::size_t i = 0; i < to.bodies.size(); ++i) {
    const auto &a = from.bodies[i], &b = to.bodies[i];
    const bool free = !system_.problem().bodies[i].pinned;
    if (free) put((b.position - a.position) / lengths_[i]);
    put(rotation_vector<S>(product<S>(conjugate<S>(a.attitude), b.attitude)));
    if (free) put((b.momentum - a.momentum) * (lengths_[i] / action_));
    put((b.body_momentum - a.body_momentum) / action_);
  }
  return all;
}

template <class S>
MatrixX<S> PhaseSpace<S>::two_form(const PhasePoint<S>& at) const {
  MatrixX<S> form = MatrixX<S>::Zero(dimension_, dimension_);
  int k = 0;
  for (std::size_t i = 0; i < at.bodies.size(); ++i) {
    const int half = system_.problem().bodies[i].pinned ? 3 : 6;
    form.block(k, k + half, half, half).setIdentity();
    form.block(k + half, k, half, half) = -MatrixX<S>::Identity(half, half);
    // ⟨π, ξ_a × ξ_b⟩ = −ξ_aᵀ π* ξ_b
    form.template block<3, 3>(k + half - 3, k + half - 3) = -skew<S>(at.bodies[i].body_momentum / action_);
    k += 2 * half;
  }
  return form;
}

template class PhaseSpace<double>;
template class PhaseSpace<long double>;

}  // namespace polhode::study::certificate
