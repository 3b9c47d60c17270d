// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies under forces as a mechanical system: the Newton–Euler equations in the chosen formulation.
//
//   velocity_world:  ω̇ = R I⁻¹ Rᵀ (τ − ω × R I Rᵀ ω)      velocity_body:  Ω̇ = I⁻¹ (Rᵀτ − Ω × I Ω)
//   momentum_world:  L̇ = τ, ω = R I⁻¹ Rᵀ L                free bodies:    v̇ = f/m, ṗ = v
//
// The gyroscopic term (the products ω × R I Rᵀ ω and Ω × I Ω) can be omitted, as in both source documents. R is used as
// stored, so that the equations hold as written even if R has left its manifold.
// Source: Goldstein, Poole & Safko, Classical Mechanics, 3rd ed., ch. 5; course report, section 2.1; engine slides,
// "Integration".
//
// One template covers a single body, whose state size is known at compile time, and many bodies. Polhode's own methods
// are written against the concepts of core/system/concepts.hpp and are instantiated for the concrete type.
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "core/math/flatten.hpp"
#include "core/system/concepts.hpp"
#include "core/system/orientation_chart.hpp"
#include "core/system/system.hpp"

namespace polhode {

enum class BodyCount { one, many };

/// The constants of one body in the scalar S.
template <class S>
struct BodyConstants {
  // The members that the rate of a free body reads come first, so that they share a cache line.
  bool principal = true;  ///< body axes are principal axes, so that I is diagonal
  bool pinned = false;
  S inverse_mass{};
  Vector3<S> moments, inverse_moments;  ///< principal moments of inertia, kg m², and their inverses
  S mass{};
  Matrix3<S> inertia, inverse_inertia;
  Matrix3<S> axes;  ///< rotation matrix with the principal axes as columns
  Vector3<S> center_of_mass;

  BodyConstants() = default;
  explicit BodyConstants(const Body& b);
  /// I ω in body axes.
  Vector3<S> momentum(const Vector3<S>& w) const {
    if (principal) [[likely]]
      return moments.cwiseProduct(w);
    return inertia * w;
  }
  /// I⁻¹ l in body axes.
  Vector3<S> velocity(const Vector3<S>& l) const {
    if (principal) [[likely]]
      return inverse_moments.cwiseProduct(l);
    return inverse_inertia * l;
  }
};

/// Coefficient (1 − (θ/2) cot(θ/2))/θ² of dexp⁻¹ as a function of θ². Near 0 it is computed by its power series.
template <class S>
S dexp_inverse_coefficient(S theta2) {
  using std::sqrt, std::tan;
  const S series =
      S(1) / S(12) +
      theta2 * (S(1) / S(720) +
                theta2 * (S(1) / S(30240) +
                          theta2 * (S(1) / S(1209600) +
                                    theta2 * (S(1) / S(47900160) + theta2 * (S(691) / S(1307674368000.0))))));
  const S half = sqrt(theta2) / S(2);
  return select(theta2 < S(1e-2), series, S((S(1) - half / tan(half)) / theta2));
}

/// Rotation of a free body over a step, used by free_flow(): dq = rotor(constants, h, m). h is in s. m is the angular
/// momentum in principal axes, updated by the call. dq is the unit quaternion of the rotation.
template <class S>
using Rotor = std::function<Quaternion<S>(const BodyConstants<S>&, S, Vector3<S>&)>;

/// Interface of every system except a single free body in double, alone or in lanes; independent of the formulation.
/// Each operation on all bodies is one virtual call, so that a method is compiled once for all formulations. For a
/// single free body the call would cost as much as the operation itself. That case is compiled for each formulation,
/// and its operations inline.
template <class S>
class ManyBodies : public System<S> {
 public:
  using Flat = VectorX<S>;
  using Tangent = VectorX<S>;
  static constexpr bool is_one = false;

  Flat zero() const { return Flat::Zero(this->layout().size()); }
  Tangent zero_tangent() const { return Tangent::Zero(this->layout().velocity_size); }
  auto configuration_part(Flat& y) const { return y.head(this->layout().configuration_size); }
  auto velocity_part(Flat& y) const {
    return y.segment(this->layout().configuration_size, this->layout().velocity_size);
  }
  S& work_part(Flat& y) const { return y[y.size() - 1]; }

  using System<S>::rate;
  virtual void rate(S t, const Flat& y, Flat& dy) const = 0;
  virtual void acceleration(S t, const Flat& y, Flat& dy) const = 0;
  virtual void configuration_rate(S t, const Flat& y, Flat& dy) const = 0;
  virtual void twist(const Flat& y, Tangent& xi) const = 0;
  virtual void retract(Flat& y, const Tangent& xi) const = 0;
  virtual void dexp_inverse(const Tangent& theta, const Tangent& eta, Tangent& out) const = 0;
  virtual void wrench(S t, const Flat& y, Tangent& w) const = 0;
  virtual void momentum(const Flat& y, Tangent& p) const = 0;
  virtual void set_momentum(const Tangent& p, Flat& y) const = 0;
  virtual void body_twist(const Flat& y, Tangent& xi) const = 0;
  virtual void set_body_twist(const Tangent& xi, Flat& y) const = 0;
  virtual void body_acceleration(const Flat& y, const Tangent& wrench, Tangent& rate) const = 0;
  virtual void retract_in_body(Flat& y, const Tangent& xi) const = 0;
  virtual void carry_momentum(const Tangent& theta, const Tangent& impulse, Flat& y) const = 0;
  virtual void bracket(const Tangent& a, const Tangent& b, Tangent& out) const = 0;
  virtual void kick(S t, S h, Flat& y) const = 0;
  virtual void kick(S t, S h, const Flat& seen, Flat& y) const = 0;
  virtual void free_flow(S h, Flat& y, const Rotor<S>& rotor) const = 0;
  virtual Measurement<S> measure_flat(const S* y) const = 0;
  virtual void project_flat(S* y) const = 0;

 protected:
  using System<S>::System;
};

/// Rigid bodies in one formulation. For many bodies the members override those of ManyBodies. For one body they are
/// called through the concrete type only.
template <class S, Orientation O, AngularState A, BodyCount N>
class RigidBodies final : public std::conditional_t<N == BodyCount::one, System<S>, ManyBodies<S>> {
 public:
  using Base = std::conditional_t<N == BodyCount::one, System<S>, ManyBodies<S>>;
  using Scalar = S;
  using Vector = Vector3<S>;
  using Matrix = Matrix3<S>;
  using ChartOf = Chart<S, O>;
  using ChartValue = typename ChartOf::Value;
  using Constants = BodyConstants<S>;

  static constexpr bool is_one = N == BodyCount::one;
  static constexpr int one_configuration = 3 + ChartOf::size;
  static constexpr int one_size = one_configuration + 6 + 1;
  /// Flat state: a vector of fixed size for one body, of dynamic size for many.
  using Flat = Eigen::Matrix<S, is_one ? one_size : Eigen::Dynamic, 1>;
  using Tangent = Eigen::Matrix<S, is_one ? 6 : Eigen::Dynamic, 1>;

  /// Takes one problem, or for lanes one problem for each lane.
  RigidBodies(std::vector<Problem> problems, const Formulation& formulation);

  // ---- operations of the concepts -----------------------------------------------------------------------------------

  Flat zero() const { return Flat::Zero(this->layout().size()); }

  auto configuration_part(Flat& y) const {
    if constexpr (is_one) return y.template head<one_configuration>();
    else return y.head(this->layout().configuration_size);
  }
  auto velocity_part(Flat& y) const {
    if constexpr (is_one) return y.template segment<6>(one_configuration);
    else return y.segment(this->layout().configuration_size, this->layout().velocity_size);
  }
  S& work_part(Flat& y) const { return y[y.size() - 1]; }

  void rate(S t, const Flat& y, Flat& dy) const {
    if constexpr (inlines) rate_of<true, true>(t, y.data(), dy.data());
    else full_rate(t, y.data(), dy.data());
  }
  void acceleration(S t, const Flat& y, Flat& dy) const {
    if constexpr (inlines) rate_of<false, true>(t, y.data(), dy.data());
    else velocity_rate(t, y.data(), dy.data());
  }
  void configuration_rate(S t, const Flat& y, Flat& dy) const {
    if constexpr (inlines) rate_of<true, false>(t, y.data(), dy.data());
    else kinematic_rate(t, y.data(), dy.data());
  }

  // Lie group SO(3)ⁿ × R³ⁿ (Iserles, Munthe-Kaas, Nørsett & Zanna, Lie-group methods, Acta Numerica 2000).

  Tangent zero_tangent() const { return Tangent::Zero(this->layout().velocity_size); }
  void twist(const Flat& y, Tangent& xi) const;
  void retract(Flat& y, const Tangent& xi) const;

  /// out = η ∓ ½ θ × η + c θ × (θ × η), with − for exp(θ) R (world axes) and + for R exp(θ) (body axes).
  /// c = (1 − (θ/2) cot(θ/2))/θ².
  void dexp_inverse(const Tangent& theta, const Tangent& eta, Tangent& out) const;

  // Inertia map.

  void wrench(S t, const Flat& y, Tangent& w) const;
  void momentum(const Flat& y, Tangent& p) const;
  void set_momentum(const Tangent& p, Flat& y) const;

  // Body frame, in every formulation, for methods whose source is written in body axes.

  void body_twist(const Flat& y, Tangent& xi) const;
  void set_body_twist(const Tangent& xi, Flat& y) const;
  void body_acceleration(const Flat& y, const Tangent& wrench, Tangent& rate) const;
  void retract_in_body(Flat& y, const Tangent& xi) const;

  /// Updates the velocity by increments. A free body then conserves its momentum R I Ω for every defect of R, and the
  /// round-off of I I⁻¹ does not enter at every step.
  void carry_momentum(const Tangent& theta, const Tangent& impulse, Flat& y) const;
  void bracket(const Tangent& a, const Tangent& b, Tangent& out) const;

  // Splitting T + V: kicks change the momentum at fixed configuration, and free flow moves bodies without a wrench.

  /// v ← v + h M⁻¹ (f, τ) without the gyroscopic term. The work of the wrench follows by the trapezoidal rule.
  void kick(S t, S h, Flat& y) const;

  /// Kick with the wrench and power of the state `seen`, whose configuration equals that of y. It is a stage of a
  /// quadrature rule for forces that depend on v.
  void kick(S t, S h, const Flat& seen, Flat& y) const;

  /// Free motion over h (s). Mass centres move in straight lines. Each body rotates by dq = rotor(constants, h, m): the
  /// call advances the angular momentum m (principal axes) over the step and returns the unit quaternion of the
  /// rotation dR, R' = R dR in the same axes. constants.moments are the principal moments (kg m²).
  ///
  /// With momentum_world, L is bitwise unchanged. The other variables are updated by increments, and for velocity_world
  /// Ω solves R Ω = ω. The transformation into body axes and back then cancels exactly. It would not otherwise, because
  /// I I⁻¹ = 1 holds only to round-off and RᵀR = 1 only to the defect of R; over many steps these factors would cause a
  /// drift. For the same reason R of a quaternion is always that of q/|q| here: only then R(q dq) = R(q) R(dq).
  template <class AnyRotor>
  requires(!is_lanes<S>) void free_flow(S h, Flat& y, AnyRotor&& rotor) const;

  // ---- interface of System ------------------------------------------------------------------------------------------

  void rate(S t, const S* y, S* dy) const { full_rate(t, y, dy); }
  State<S> start() const;
  Measurement<S> measure(const VectorX<S>& y) const;
  BodySnapshot<S> snapshot(const VectorX<S>& y, std::size_t body) const;
  BodyMotion<S> motion_of(const VectorX<S>& y, std::size_t body) const;
  const Matrix3<S>& inverse_inertia(std::size_t i) const { return body(i).inverse_inertia; }
  void apply_impulse(VectorX<S>& y, std::size_t body, const Vector3<S>& impulse,
                     const Vector3<S>& angular_impulse) const;
  void displace(VectorX<S>& y, std::size_t body, const Vector3<S>& shift, const Vector3<S>& turn) const;
  void project(VectorX<S>& y) const;

  /// measure() and project() on the array of the state's numbers, for callers that know the concrete type.
  Measurement<S> measure_flat(const S* y) const {
    Measurement<S> m;
    const bool alone = count() == 1;
    for (std::size_t i = 0; i < count(); ++i) {
      const Layout::Slot s = slot(i);
      const Constants& b = body(i);
      const BodyMotion<S> now = motion(y, i);
      if (this->forces_read_rotation()) motions_[i] = now;
      Vector l = angular_momentum(b, now.rotation, load(y + s.angular));
      if constexpr (A == AngularState::momentum_world) {
        m.kinetic += S(0.5) * now.angular_velocity.dot(l);
      } else {
        const Vector w = body_velocity(now.rotation, load(y + s.angular));
        m.kinetic += S(0.5) * w.dot(b.momentum(w));
      }
      if (pinned(i)) {
        if (!alone) l += now.position.cross(b.mass * now.angular_velocity.cross(now.rotation * b.center_of_mass));
      } else {
        const Vector p = b.mass * now.velocity;
        m.kinetic += S(0.5) * now.velocity.dot(p);
        m.linear_momentum += p;
        if (!alone) l += now.position.cross(p);
      }
      m.angular_momentum += l;
      const S defect = ChartOf::defect(ChartOf::load(y + s.orientation));
      m.orientation_defect = select(defect <= m.orientation_defect, m.orientation_defect, defect);  // keeps a NaN
    }
    if (this->has_forces() && !this->forces_read_rotation()) fill_motions(y);
    for (const auto& force : this->forces()) m.potential += force->potential_energy(motions_);
    return m;
  }
  void project_flat(S* y) const {
    for (std::size_t i = 0; i < count(); ++i) {
      S* c = y + slot(i).orientation;
      ChartOf::store(ChartOf::project(ChartOf::load(c)), c);
    }
  }

 private:
  /// Override of the member of ManyBodies. For one body only the template above exists.
  void free_flow(S h, Flat& y, const Rotor<S>& rotor) const {
    if constexpr (!is_one) free_flow<const Rotor<S>&>(h, y, rotor);
  }

  /// True if the rates inline into every method. For one body a call per stage would cost as much as the rate itself.
  /// For many bodies the rates are compiled once, which shortens the build of a method.
  static constexpr bool inlines = is_one;

  POLHODE_FLATTEN void full_rate(S t, const S* y, S* dy) const;
  void velocity_rate(S t, const S* y, S* dy) const;
  void kinematic_rate(S t, const S* y, S* dy) const;

  const Constants& body(std::size_t i) const {
    if constexpr (is_one) return first_;
    else return bodies_[i];
  }
  Layout::Slot slot(std::size_t i) const {
    if constexpr (is_one) return {0, 3, one_configuration, one_configuration + 3};
    else return this->layout().slots[i];
  }
  bool pinned(std::size_t i) const {
    if constexpr (is_one) return false;
    else return bodies_[i].pinned;
  }
  std::size_t count() const {
    if constexpr (is_one) return 1;
    else return bodies_.size();
  }

  static constexpr bool in_body_axes = A == AngularState::velocity_body;  ///< true: tangent vectors are in body axes

  /// Pointers to the angular and linear parts of body i in a Tangent.
  template <class T>
  auto angular(T& xi, std::size_t i) const {
    return xi.data() + (slot(i).angular - configuration_size());
  }
  template <class T>
  auto linear(T& xi, std::size_t i) const {
    return xi.data() + (slot(i).velocity - configuration_size());
  }
  int configuration_size() const {
    if constexpr (is_one) return one_configuration;
    else return this->layout().configuration_size;
  }

  static Vector load(const S* p) { return Eigen::Map<const Vector>(p); }
  static void store(const Vector& v, S* p) { Eigen::Map<Vector>{p} = v; }

  Matrix rotation(const ChartValue& c) const { return ChartOf::rotation(c, this->formulation().rotation_from); }

  /// True if R is a rotation for every state by construction, as the rotation of q/|q| is.
  bool orthonormal() const {
    return O == Orientation::quaternion && this->formulation().rotation_from == RotationFrom::normalised;
  }

  /// ω in world axes from the angular state a.
  Vector angular_velocity_world(const Constants& b, const Matrix& r, const Vector& a) const {
    if constexpr (A == AngularState::velocity_world) return a;
    else if constexpr (A == AngularState::velocity_body) return r * a;
    else return r * b.velocity(r.transpose() * a);
  }

  /// Change of the vector v under the rotation by the unit quaternion d: d v d* − v.
  static Vector turning(const Quaternion<S>& d, const Vector& v) {
    const Vector u = d.template tail<3>();
    const Vector uv = u.cross(v);
    return S(2) * (d[0] * uv + u.cross(uv));
  }

  /// Ω in body axes from the angular state a.
  Vector angular_velocity_body(const Constants& b, const ChartValue& c, const Vector& a) const {
    if constexpr (in_body_axes) return a;
    else if constexpr (A == AngularState::velocity_world) return rotation(c).transpose() * a;
    else return b.velocity(rotation(c).transpose() * a);
  }

  /// R⁻¹ a: by the transpose for the rotation of a quaternion, by Cramer's rule for a stored matrix.
  static Vector unturned(const Matrix& r, const Vector& a) {
    if constexpr (O == Orientation::quaternion) return r.transpose() * a;
    const Vector c0 = r.col(1).cross(r.col(2)), c1 = r.col(2).cross(r.col(0)), c2 = r.col(0).cross(r.col(1));
    return Vector(c0.dot(a), c1.dot(a), c2.dot(a)) / c0.dot(r.col(0));
  }

  /// Ω in body axes from an angular velocity a in the frame of the formulation.
  static Vector body_velocity(const Matrix& r, const Vector& a) {
    if constexpr (A == AngularState::velocity_body) return a;
    else return r.transpose() * a;
  }

  /// Angular momentum about the reference point, world axes: R I Ω, or the angular state itself for momentum_world.
  Vector angular_momentum(const Constants& b, const Matrix& r, const Vector& a) const {
    if constexpr (A == AngularState::momentum_world) return a;
    else return r * b.momentum(body_velocity(r, a));
  }

  /// Angular state with the angular momentum l (world axes). Linear in l.
  Vector angular_state(const Constants& b, const Matrix& r, const Vector& l) const {
    if constexpr (A == AngularState::momentum_world) return l;
    else if constexpr (in_body_axes) return b.velocity(r.transpose() * l);
    else return r * b.velocity(r.transpose() * l);
  }

  BodyMotion<S> motion(const S* y, std::size_t i) const {
    const Layout::Slot s = slot(i);
    BodyMotion<S> m;
    m.rotation = rotation(ChartOf::load(y + s.orientation));
    m.angular_velocity = angular_velocity_world(body(i), m.rotation, load(y + s.angular));
    if (pinned(i)) {
      m.position = this->problem().starts[i].position.template cast<S>();
      m.velocity.setZero();
    } else {
      m.position = load(y + s.position);
      m.velocity = load(y + s.velocity);
    }
    return m;
  }

  /// Fills the motions that are passed to forces. Skips rotations and angular velocities if no force reads them.
  void fill_motions(const S* y) const {
    for (std::size_t i = 0; i < count(); ++i) {
      if (this->forces_read_rotation()) {
        motions_[i] = motion(y, i);
      } else if (!pinned(i)) {
        motions_[i].position = load(y + slot(i).position);
        motions_[i].velocity = load(y + slot(i).velocity);
      }
    }
  }

  void fill_wrenches(S t) const {
    for (auto& w : wrenches_) w = Wrench<S>{};
    for (const auto& force : this->forces()) force->add_wrench(t, motions_, wrenches_);
  }

  /// v ← v + h M⁻¹ (f, τ) with the wrenches of the last fill_wrenches().
  void push(S h, Flat& y) const {
    for (std::size_t i = 0; i < count(); ++i) {
      const Layout::Slot s = slot(i);
      if (this->forces_exert_torques()) {
        const Matrix r = rotation(ChartOf::load(y.data() + s.orientation));
        S* a = y.data() + s.angular;
        store(load(a) + h * angular_state(body(i), r, wrenches_[i].torque), a);
      }
      if (!pinned(i)) {
        S* v = y.data() + s.velocity;
        store(load(v) + h * (wrenches_[i].force * body(i).inverse_mass), v);
      }
    }
  }

  S power(S t) const {
    S p(0);
    for (const auto& force : this->forces()) {
      if (force->does_work()) p += force->power(t, motions_);
    }
    return p;
  }

  /// Gyroscopic torque IΩ × Ω in body axes, N m; zero if the formulation omits it.
  Vector gyroscopic_torque(const Constants& b, const Vector& w) const {
    if (this->formulation().gyroscopic) [[likely]]
      return b.momentum(w).cross(w);
    return Vector::Zero();
  }

  /// dω/dt or dL/dt in world axes of a body with rotation r under the torque about its reference point. A null torque
  /// is zero.
  Vector angular_rate_world(const Constants& b, const Matrix& r, const Vector& a, const Vector* torque) const {
    if constexpr (A == AngularState::momentum_world) {
      return torque ? *torque : Vector(Vector::Zero());
    } else {
      if (orthonormal()) {  // R RᵀR = R, so that products with R around the gyroscopic term cancel
        const Vector w = r.transpose() * a;
        const Vector m = gyroscopic_torque(b, w);
        return r * b.velocity(torque ? Vector(r.transpose() * *torque + m) : m);
      }
      Vector m = torque ? *torque : Vector(Vector::Zero());
      if (this->formulation().gyroscopic) {
        const Vector l = r * b.momentum(r.transpose() * a);
        m -= a.cross(l);
      } else if (!torque) {
        return m;
      }
      return r * b.velocity(r.transpose() * m);
    }
  }

  template <bool WithConfiguration, bool WithVelocity>
  void rate_of(S t, const S* y, S* dy) const {
    const bool forced = this->has_forces();
    const bool working = WithConfiguration && forced && this->forces_do_work();
    if (forced && (WithVelocity || working)) fill_motions(y);
    if (forced && WithVelocity) fill_wrenches(t);
    for (std::size_t i = 0; i < count(); ++i) {
      const Layout::Slot s = slot(i);
      const Constants& b = body(i);
      const ChartValue c = ChartOf::load(y + s.orientation);
      const Vector a = load(y + s.angular);
      const Vector* torque = forced && this->forces_exert_torques() ? &wrenches_[i].torque : nullptr;
      const auto rotation_now = [&]() -> Matrix {
        const bool known = forced && this->forces_read_rotation() && (WithVelocity || working);
        return known ? motions_[i].rotation : rotation(c);
      };
      if constexpr (WithConfiguration) {
        if constexpr (in_body_axes) ChartOf::store(ChartOf::rate_body(c, a), dy + s.orientation);
        if (!pinned(i)) store(load(y + s.velocity), dy + s.position);
      }
      if constexpr (in_body_axes) {  // R is needed for torques only
        if constexpr (WithVelocity) {
          const Vector m = gyroscopic_torque(b, a);
          store(b.velocity(torque ? Vector(rotation_now().transpose() * *torque + m) : m), dy + s.angular);
        }
      } else {
        const Matrix r = rotation_now();
        if constexpr (WithConfiguration) {
          ChartOf::store(ChartOf::rate_world(c, angular_velocity_world(b, r, a)), dy + s.orientation);
        }
        if constexpr (WithVelocity) store(angular_rate_world(b, r, a, torque), dy + s.angular);
      }
      if constexpr (WithVelocity) {
        if (!pinned(i))
          store(forced ? Vector(wrenches_[i].force * b.inverse_mass) : Vector(Vector::Zero()), dy + s.velocity);
      }
    }
    if constexpr (WithConfiguration) dy[this->flat_size() - 1] = working ? power(t) : S(0);
  }

  int flat_size() const {
    if constexpr (is_one) return one_size;
    else return this->layout().size();
  }

  std::vector<Constants> bodies_;
  Constants first_;
  // Accumulators of the bodies (engine slides, "Rigid Body Data"). Scratch storage; a system serves one run on one
  // thread.
  mutable std::vector<BodyMotion<S>> motions_;
  mutable std::vector<Wrench<S>> wrenches_;
};

/// True for double, alone or in lanes: a single body then has instantiations of its own. Float and long double serve
/// rounding studies, where speed matters less.
template <class S>
inline constexpr bool has_one_body_form = std::is_same_v<S, double> || is_lanes<S>;
/// True for a problem with a single body that is free.
inline bool fits_one_body_form(const Problem& problem) {
  return problem.bodies.size() == 1 && !problem.bodies.front().pinned;
}

/// Calls build<O, A>() with the orientation chart and the angular state of the formulation.
template <class Build>
auto in_formulation(const Formulation& formulation, const Build& build) {
  const auto chart = [&]<Orientation O>() {
    switch (formulation.angular_state) {
      case AngularState::velocity_world: return build.template operator()<O, AngularState::velocity_world>();
      case AngularState::velocity_body: return build.template operator()<O, AngularState::velocity_body>();
      default: return build.template operator()<O, AngularState::momentum_world>();
    }
  };
  return formulation.orientation == Orientation::quaternion ? chart.template operator()<Orientation::quaternion>()
                                                            : chart.template operator()<Orientation::matrix>();
}

/// Calls f with the concrete system: ManyBodies, or RigidBodies of one body in its formulation.
template <class S, class F>
auto visit_system(const System<S>& system, F&& f) {
  const auto one = [&]<Orientation O, AngularState A>() {
    return f(static_cast<const RigidBodies<S, O, A, BodyCount::one>&>(system));
  };
  if constexpr (!has_one_body_form<S>) return f(static_cast<const ManyBodies<S>&>(system));
  else if constexpr (is_lanes<S>) return in_formulation(system.formulation(), one);
  else if (const auto* many = dynamic_cast<const ManyBodies<S>*>(&system)) return f(*many);
  else return in_formulation(system.formulation(), one);
}

}  // namespace polhode

#include "core/system/rigid_bodies_motions.hpp"
