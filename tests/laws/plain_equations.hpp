// SPDX-License-Identifier: BSD-3-Clause
// The equations of motion a second time, as a textbook writes them and with no thought of speed: the judge of
// core/system/flat_ode.hpp. What an orientation off its manifold means:
//   R of a quaternion: normalized, R v = q v q⁻¹; stored, R = 1 + 2 w v* + 2 v* v* with (w, v) as it is
//   R of a matrix: as stored; the world inverse inertia is R I⁻¹ Rᵀ; Ω = Rᵀω, L = R I Ω, ω = R I⁻¹ Rᵀ L
//   q̇ = ½ ω q or ½ q Ω, Ṙ = ω* R or R Ω*, with q and R as stored
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <vector>

#include "core/system/system.hpp"

namespace polhode::laws {

/// A moving body at one instant, world axes but for Ω.
template <class S>
struct PlainBody {
  Matrix3<S> inertia_body, rotation;
  Vector3<S> position, velocity;     ///< position and velocity of the reference point
  Vector3<S> state;                  ///< the angular state as stored
  Vector3<S> angular_velocity;       ///< ω
  Vector3<S> angular_velocity_body;  ///< Ω, of which energy and momentum are made
  Vector3<S> angular_momentum;       ///< angular momentum about the reference point
  S kinetic{};
};

template <class S>
Matrix3<S> star(const Vector3<S>& a) {
  Matrix3<S> m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

template <class S>
Matrix3<S> plain_rotation(const Formulation& f, const S* chart) {
  if (f.orientation == Orientation::matrix) return Eigen::Map<const Matrix3<S>>(chart);
  const Vector3<S> v(chart[1], chart[2], chart[3]);
  if (f.rotation_from == RotationFrom::stored) {
    return Matrix3<S>::Identity() + 2 * chart[0] * star(v) + 2 * star(v) * star(v);
  }
  const Eigen::Quaternion<S> q(chart[0], chart[1], chart[2], chart[3]);
  Matrix3<S> r;
  for (int i = 0; i < 3; ++i) {
    Eigen::Quaternion<S> e(0, 0, 0, 0);
    e.vec()[i] = 1;
    r.col(i) = (q * e * q.inverse()).vec();
  }
  return r;
}

template <class S>
std::vector<PlainBody<S>> plain_bodies(const System<S>& system, const VectorX<S>& y) {
  std::vector<PlainBody<S>> all;
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const Layout::Slot& slot = system.layout().slots[i];
    const Body& body = system.problem().bodies[i];
    PlainBody<S> b;
    const Matrix3<S> inertia = body.inertia.template cast<S>();
    const Matrix3<S> inverse = inertia.fullPivLu().inverse();
    b.inertia_body = inertia;
    b.rotation = plain_rotation(system.formulation(), y.data() + slot.orientation);
    const Matrix3<S>&r = b.rotation, rt = r.transpose();
    b.state = y.template segment<3>(slot.angular);
    switch (system.formulation().angular_state) {
      case AngularState::velocity_world:
        b.angular_velocity = b.state;
        b.angular_velocity_body = rt * b.state;
        b.angular_momentum = r * inertia * rt * b.state;
        b.kinetic = b.state.dot(b.angular_momentum) / 2;
        break;
      case AngularState::velocity_body:
        b.angular_velocity = r * b.state;
        b.angular_velocity_body = b.state;
        b.angular_momentum = r * inertia * b.state;
        b.kinetic = b.state.dot(inertia * b.state) / 2;
        break;
      default:
        b.angular_velocity = r * inverse * rt * b.state;
        b.angular_velocity_body = inverse * rt * b.state;
        b.angular_momentum = b.state;
        b.kinetic = b.state.dot(b.angular_velocity) / 2;
    }
    if (body.pinned) {
      b.position = system.problem().starts[i].position.template cast<S>();
      b.velocity.setZero();
    } else {
      b.position = y.template segment<3>(slot.position);
      b.velocity = y.template segment<3>(slot.velocity);
      b.kinetic += S(body.mass) * b.velocity.squaredNorm() / 2;
    }
    all.push_back(b);
  }
  return all;
}

/// All bodies as forces read them: the moving ones, then the static ones.
template <class S>
std::vector<BodyMotion<S>> plain_motions(const System<S>& system, const VectorX<S>& y) {
  std::vector<BodyMotion<S>> motions;
  for (const PlainBody<S>& b : plain_bodies(system, y)) {
    motions.push_back({b.position, b.rotation, b.velocity, b.angular_velocity});
  }
  for (std::size_t i = system.moving(); i < system.problem().bodies.size(); ++i) {
    const BodyStart& s = system.problem().starts[i];
    const Quaternion<S> q = s.orientation.template cast<S>();
    motions.push_back({s.position.template cast<S>(), plain_rotation(Formulation{}, q.data()), Vector3<S>::Zero(),
                       Vector3<S>::Zero()});
  }
  return motions;
}

template <class S>
std::vector<Wrench<S>> plain_wrenches(const System<S>& system, S t, const VectorX<S>& y) {
  const auto motions = plain_motions(system, y);
  std::vector<Wrench<S>> wrenches(motions.size());
  for (const auto& force : system.forces()) force->add_wrench(t, motions, wrenches);
  return wrenches;
}

template <class S>
S plain_power(const System<S>& system, S t, const VectorX<S>& y) {
  const auto motions = plain_motions(system, y);
  S power(0);
  for (const auto& force : system.forces()) power += force->power(t, motions);
  return power;
}

/// ẏ = f(t, y), with y laid out as core/system/state.hpp says.
template <class S>
VectorX<S> plain_rate(const System<S>& system, S t, const VectorX<S>& y) {
  const Formulation& f = system.formulation();
  const auto bodies = plain_bodies(system, y);
  const auto wrenches = plain_wrenches(system, t, y);
  VectorX<S> dy = VectorX<S>::Zero(y.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const PlainBody<S>& b = bodies[i];
    const Layout::Slot& slot = system.layout().slots[i];
    const Matrix3<S>& r = b.rotation;
    const Matrix3<S> inverse = b.inertia_body.fullPivLu().inverse();
    const bool in_body = f.angular_state == AngularState::velocity_body;
    const Vector3<S>& w = in_body ? b.state : b.angular_velocity;
    // kinematics
    const S* c = y.data() + slot.orientation;
    if (f.orientation == Orientation::quaternion) {
      const Eigen::Quaternion<S> q(c[0], c[1], c[2], c[3]), turn(0, w[0], w[1], w[2]);
      const Eigen::Quaternion<S> rate = in_body ? q * turn : turn * q;
      dy[slot.orientation] = rate.w() / 2;
      dy.template segment<3>(slot.orientation + 1) = rate.vec() / 2;
    } else {
      const Matrix3<S> stored = Eigen::Map<const Matrix3<S>>(c);
      Eigen::Map<Matrix3<S>>(dy.data() + slot.orientation) = in_body ? stored * star(w) : star(w) * stored;
    }
    // Newton and Euler
    const Vector3<S>& torque = wrenches[i].torque;
    Vector3<S> angular;
    switch (f.angular_state) {
      case AngularState::velocity_world: {
        Vector3<S> m = torque;
        if (f.gyroscopic) m -= w.cross(r * b.inertia_body * r.transpose() * w);
        angular = r * inverse * r.transpose() * m;
        break;
      }
      case AngularState::velocity_body: {
        Vector3<S> m = r.transpose() * torque;
        if (f.gyroscopic) m -= w.cross(b.inertia_body * w);
        angular = inverse * m;
        break;
      }
      default: angular = torque;
    }
    dy.template segment<3>(slot.angular) = angular;
    if (slot.position >= 0) {
      dy.template segment<3>(slot.position) = b.velocity;
      dy.template segment<3>(slot.velocity) = wrenches[i].force / S(system.problem().bodies[i].mass);
    }
  }
  dy[system.layout().work()] = plain_power(system, t, y);
  return dy;
}

}  // namespace polhode::laws
