// SPDX-License-Identifier: BSD-3-Clause
// The variables of each body in the flat state: where they stand in it, and how ω, Ω and the angular momentum follow
// from the angular state in one formulation. R is used as stored, so that the equations hold as written even if R has
// left its manifold.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "core/system/body_constants.hpp"
#include "core/system/many_bodies.hpp"
#include "core/system/orientation_chart.hpp"

namespace polhode::inline core::inline system {

enum class BodyCount { one, many };

/// Vectors within an array of numbers.
template <class S>
inline Vector3<S> load_vector(const S* p) {
  return Eigen::Map<const Vector3<S>>(p);
}
template <class S>
inline void store_vector(const std::type_identity_t<Vector3<S>>& v, S* p) {
  Eigen::Map<Vector3<S>>{p} = v;
}

/// The bodies of a system in one formulation. The number of variables of a single free body is known at compile time.
template <class S, Orientation O, AngularState A, BodyCount N>
class BodyVariables : public std::conditional_t<N == BodyCount::one, System<S>, ManyBodies<S>> {
 public:
  using Base = std::conditional_t<N == BodyCount::one, System<S>, ManyBodies<S>>;
  using Scalar = S;
  using Vector = Vector3<S>;
  using Matrix = Matrix3<S>;
  using ChartOf = Chart<S, O>;
  using ChartValue = typename ChartOf::Value;
  using Constants = BodyConstants<S>;

  static constexpr bool is_one = N == BodyCount::one;
  static constexpr Orientation orientation = O;
  static constexpr AngularState angular_variable = A;
  static constexpr bool in_body_axes = A == AngularState::velocity_body;  ///< true: tangent vectors are in body axes
  static constexpr int one_configuration = 3 + ChartOf::size;
  static constexpr int one_size = one_configuration + 6 + 1;
  /// Flat state: a vector of fixed size for one body, of dynamic size for many.
  using Flat = Eigen::Matrix<S, is_one ? one_size : Eigen::Dynamic, 1>;
  using Tangent = Eigen::Matrix<S, is_one ? 6 : Eigen::Dynamic, 1>;

  // The parts of a flat state and of a tangent vector.

  Flat zero() const { return Flat::Zero(this->layout().size()); }
  Tangent zero_tangent() const { return Tangent::Zero(this->layout().velocity_size); }

  auto configuration_part(Flat& y) const {
    if constexpr (is_one) return y.template head<one_configuration>();
    else return Base::configuration_part(y);
  }
  auto velocity_part(Flat& y) const {
    if constexpr (is_one) return y.template segment<6>(one_configuration);
    else return Base::velocity_part(y);
  }
  auto work_part(Flat& y) const {
    if constexpr (is_one) return y.template tail<1>();
    else return Base::work_part(y);
  }

  int configuration_size() const {
    if constexpr (is_one) return one_configuration;
    else return this->layout().configuration_size;
  }
  int flat_size() const {
    if constexpr (is_one) return one_size;
    else return this->layout().size();
  }

  // The moving bodies, by index.

  std::size_t count() const {
    if constexpr (is_one) return 1;
    else return bodies_.size();
  }
  const Constants& body(std::size_t i) const {
    if constexpr (is_one) return first_;
    else return bodies_[i];
  }
  bool pinned(std::size_t i) const {
    if constexpr (is_one) return false;
    else return bodies_[i].pinned;
  }
  Layout::Slot slot(std::size_t i) const {
    if constexpr (is_one) return {0, 3, one_configuration, one_configuration + 3};
    else return this->layout().slots[i];
  }
  /// Pointers to the angular and linear parts of body i in a Tangent.
  template <class T>
  auto angular_part(T& xi, std::size_t i) const {
    return xi.data() + (slot(i).angular - configuration_size());
  }
  template <class T>
  auto linear_part(T& xi, std::size_t i) const {
    return xi.data() + (slot(i).velocity - configuration_size());
  }

  // Orientation c, rotation matrix r and angular state a of a body.

  Matrix rotation(const ChartValue& c) const { return ChartOf::rotation(c, this->formulation().rotation_from); }

  /// True if R is a rotation for every state by construction, as the rotation of q/|q| is.
  bool orthonormal() const {
    return O == Orientation::quaternion && this->formulation().rotation_from == RotationFrom::normalized;
  }

  /// ω in world axes from the angular state a.
  static Vector angular_velocity_world(const Constants& b, const Matrix& r, const Vector& a) {
    if constexpr (A == AngularState::velocity_world) return a;
    else if constexpr (A == AngularState::velocity_body) return r * a;
    else return r * b.velocity(r.transpose() * a);
  }

  /// Ω in body axes from the angular state a.
  Vector angular_velocity_body(const Constants& b, const ChartValue& c, const Vector& a) const {
    if constexpr (in_body_axes) return a;
    else if constexpr (A == AngularState::velocity_world) return rotation(c).transpose() * a;
    else return b.velocity(rotation(c).transpose() * a);
  }

  /// Ω in body axes from an angular velocity a in the frame of the formulation.
  static Vector body_velocity(const Matrix& r, const Vector& a) {
    if constexpr (A == AngularState::velocity_body) return a;
    else return r.transpose() * a;
  }

  /// Angular momentum about the reference point, world axes: R I Ω, or the angular state itself for momentum_world.
  static Vector angular_momentum(const Constants& b, const Matrix& r, const Vector& a) {
    if constexpr (A == AngularState::momentum_world) return a;
    else return r * b.momentum(body_velocity(r, a));
  }

  /// Angular state with the angular momentum l (world axes). Linear in l.
  static Vector angular_state(const Constants& b, const Matrix& r, const Vector& l) {
    if constexpr (A == AngularState::momentum_world) return l;
    else if constexpr (in_body_axes) return b.velocity(r.transpose() * l);
    else return r * b.velocity(r.transpose() * l);
  }

  /// The motion of a moving body as forces read it.
  BodyMotion<S> motion(const S* y, std::size_t i) const {
    const Layout::Slot s = slot(i);
    BodyMotion<S> m;
    m.rotation = rotation(ChartOf::load(y + s.orientation));
    m.angular_velocity = angular_velocity_world(body(i), m.rotation, load_vector(y + s.angular));
    if (pinned(i)) {
      m.position = this->problem().starts[i].position.template cast<S>();
      m.velocity.setZero();
    } else {
      m.position = load_vector(y + s.position);
      m.velocity = load_vector(y + s.velocity);
    }
    return m;
  }

 protected:
  BodyVariables(std::vector<Problem> problems, const Formulation& formulation)
      : Base(std::move(problems), formulation) {
    for (std::size_t i = 0; i < this->moving(); ++i) bodies_.push_back(constants_of<S>(this->problems(), i));
    first_ = bodies_.front();
  }

 private:
  std::vector<Constants> bodies_;
  Constants first_;
};

}  // namespace polhode::core::system
