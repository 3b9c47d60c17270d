// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies under forces as a mechanical system: Newton–Euler in the chosen formulation.
//
//   velocity_world:  ω̇ = R I⁻¹ Rᵀ (τ − ω × R I Rᵀ ω)      velocity_body:  Ω̇ = I⁻¹ (Rᵀτ − Ω × I Ω)
//   momentum_world:  L̇ = τ, ω = R I⁻¹ Rᵀ L                free bodies:    v̇ = f/m, ṗ = v
//
// The middle products (the gyroscopic term) can be left out, as both source documents do. R is taken as stored, so
// that every scheme is exactly what it names when R has left its manifold. Source: Goldstein, Poole & Safko,
// Classical Mechanics, 3rd ed., ch. 5; course report, section 2.1; engine slides, "Integration".
//
// One template serves one body, whose state has a size known to the compiler, and many. Integrators of ours are
// written against the concept MechanicalSystem below and see the concrete type.
#pragma once

#include <array>
#include <concepts>
#include <type_traits>
#include <vector>

#include "core/flatten.hpp"
#include "core/orientation_chart.hpp"
#include "core/system.hpp"

namespace polhode {

enum class BodyCount { one, many };

/// What a method may ask of a system S; `rate` alone gives the flat ODE ẏ = f(t, y), the other two its halves.
template <class System>
concept MechanicalSystem = requires(const System& system, typename System::Scalar t, const typename System::Flat& y,
                                    typename System::Flat& dy) {
  { system.zero() } -> std::same_as<typename System::Flat>;
  system.rate(t, y, dy);                ///< dy = (N(q) v, v̇, power)
  system.acceleration(t, y, dy);        ///< fills velocity_part(dy) = v̇(t, q, v)
  system.configuration_rate(t, y, dy);  ///< fills configuration_part(dy) = N(q) v and work_part(dy)
  system.configuration_part(dy);
  system.velocity_part(dy);
  system.work_part(dy);
};

template <class S, Orientation O, AngularState A, BodyCount N>
class RigidBodies final : public System<S> {
 public:
  using Scalar = S;
  using Vector = Vector3<S>;
  using Matrix = Matrix3<S>;
  using ChartOf = Chart<S, O>;
  using ChartValue = typename ChartOf::Value;

  static constexpr bool is_one = N == BodyCount::one;
  static constexpr int one_configuration = 3 + ChartOf::size;
  static constexpr int one_size = one_configuration + 6 + 1;
  /// The flat state: a fixed-size vector for one body, a dynamic one for many.
  using Flat = Eigen::Matrix<S, is_one ? one_size : Eigen::Dynamic, 1>;

  RigidBodies(const Problem& problem, const Formulation& formulation) : System<S>(problem, formulation) {
    for (std::size_t i = 0; i < this->moving(); ++i) bodies_.emplace_back(problem.bodies[i]);
    motions_.resize(problem.bodies.size(), {Vector::Zero(), Matrix::Identity(), Vector::Zero(), Vector::Zero()});
    wrenches_.resize(problem.bodies.size());
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) {  // what static and pinned bodies keep
      const BodyStart& s = problem.starts[i];
      motions_[i] = {s.position.template cast<S>(), rotation_matrix<S>(s.orientation.template cast<S>()),
                     Vector::Zero(), Vector::Zero()};
    }
    first_ = bodies_.front();
  }

  // ---- the concept -------------------------------------------------------------------------------------------------

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

  // ---- the erased interface ----------------------------------------------------------------------------------------

  void rate(S t, const S* y, S* dy) const override { full_rate(t, y, dy); }
  State<S> start() const override;
  Measurement<S> measure(const VectorX<S>& y) const override;
  BodySnapshot<S> snapshot(const VectorX<S>& y, std::size_t body) const override;
  void project(VectorX<S>& y) const override;

  /// What measure() and project() do, on the bare numbers, for callers that know the concrete type.
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
      if (!(defect <= m.orientation_defect)) m.orientation_defect = defect;  // NaN stays
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
  /// With one body a call per stage would cost as much as the work: its rates inline into every method. Those of many
  /// bodies are compiled once, which keeps the build of a method short.
  static constexpr bool inlines = is_one;

  POLHODE_FLATTEN void flattened_rate(S t, const S* y, S* dy) const
    requires(is_one)
  {
    rate_of<true, true>(t, y, dy);
  }
  void full_rate(S t, const S* y, S* dy) const;
  void velocity_rate(S t, const S* y, S* dy) const;
  void kinematic_rate(S t, const S* y, S* dy) const;

  /// The constants of one body in the scalar S.
  struct Constants {
    S mass{}, inverse_mass{};
    Matrix inertia, inverse_inertia;
    Vector moments, inverse_moments;
    Vector center_of_mass;
    bool principal = true;  ///< body axes are principal axes: the products below are three multiplications
    bool pinned = false;

    Constants() = default;
    explicit Constants(const Body& b);
    Vector momentum(const Vector& w) const { return principal ? Vector(moments.cwiseProduct(w)) : Vector(inertia * w); }
    Vector velocity(const Vector& l) const {
      return principal ? Vector(inverse_moments.cwiseProduct(l)) : Vector(inverse_inertia * l);
    }
  };

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

  static Vector load(const S* p) { return Eigen::Map<const Vector>(p); }
  static void store(const Vector& v, S* p) { Eigen::Map<Vector>{p} = v; }

  Matrix rotation(const ChartValue& c) const { return ChartOf::rotation(c, this->formulation().rotation_from); }

  /// True where R is a rotation by construction, whatever the state: that of q/|q|.
  bool orthonormal() const {
    return O == Orientation::quaternion && this->formulation().rotation_from == RotationFrom::normalised;
  }

  /// ω in world axes from the angular state a.
  Vector angular_velocity_world(const Constants& b, const Matrix& r, const Vector& a) const {
    if constexpr (A == AngularState::velocity_world) return a;
    else if constexpr (A == AngularState::velocity_body) return r * a;
    else return r * b.velocity(r.transpose() * a);
  }

  /// Ω in body axes from an angular velocity a, in the frame of the formulation.
  static Vector body_velocity(const Matrix& r, const Vector& a) {
    if constexpr (A == AngularState::velocity_body) return a;
    else return r.transpose() * a;
  }

  /// L about the reference point, world axes: R I Ω, or the state itself.
  Vector angular_momentum(const Constants& b, const Matrix& r, const Vector& a) const {
    if constexpr (A == AngularState::momentum_world) return a;
    else return r * b.momentum(body_velocity(r, a));
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

  /// The motions that forces see; without rotation and angular velocity where no force reads them.
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

  S power(S t) const {
    S p(0);
    for (const auto& force : this->forces()) {
      if (force->does_work()) p += force->power(t, motions_);
    }
    return p;
  }

  /// d(angular state)/dt of a body with rotation r under the torque about its reference point; null: no torque.
  Vector angular_rate(const Constants& b, const Matrix& r, const Vector& a, const Vector* torque) const {
    if constexpr (A == AngularState::momentum_world) {
      return torque ? *torque : Vector(Vector::Zero());
    } else if constexpr (A == AngularState::velocity_body) {
      Vector m = torque ? Vector(r.transpose() * *torque) : Vector(Vector::Zero());
      if (this->formulation().gyroscopic) m -= a.cross(b.momentum(a));
      return b.velocity(m);
    } else {
      if (orthonormal()) {  // R RᵀR = R: the products with R around the gyroscopic term cancel
        const Vector w = r.transpose() * a;
        Vector m = torque ? Vector(r.transpose() * *torque) : Vector(Vector::Zero());
        if (this->formulation().gyroscopic) m -= w.cross(b.momentum(w));
        else if (!torque) return m;
        return r * b.velocity(m);
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
    if (forced && WithVelocity) {
      for (auto& w : wrenches_) w = Wrench<S>{};
      for (const auto& force : this->forces()) force->add_wrench(t, motions_, wrenches_);
    }
    for (std::size_t i = 0; i < count(); ++i) {
      const Layout::Slot s = slot(i);
      const Constants& b = body(i);
      const ChartValue c = ChartOf::load(y + s.orientation);
      const Vector a = load(y + s.angular);
      constexpr bool body_axes = A == AngularState::velocity_body;
      // The matrix is needed but for a free body in its own axes.
      Matrix r = Matrix::Identity();
      if (forced && this->forces_read_rotation() && (WithVelocity || working)) {
        r = motions_[i].rotation;
      } else if (!body_axes || this->forces_exert_torques()) {
        r = rotation(c);
      }
      if constexpr (WithConfiguration) {
        if constexpr (body_axes) {
          ChartOf::store(ChartOf::rate_body(c, a), dy + s.orientation);
        } else {
          ChartOf::store(ChartOf::rate_world(c, angular_velocity_world(b, r, a)), dy + s.orientation);
        }
        if (!pinned(i)) store(load(y + s.velocity), dy + s.position);
      }
      if constexpr (WithVelocity) {
        if (forced) {
          store(angular_rate(b, r, a, this->forces_exert_torques() ? &wrenches_[i].torque : nullptr), dy + s.angular);
          if (!pinned(i)) store(wrenches_[i].force * b.inverse_mass, dy + s.velocity);
        } else {
          store(angular_rate(b, r, a, nullptr), dy + s.angular);
          if (!pinned(i)) store(Vector::Zero(), dy + s.velocity);
        }
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
  // Accumulators of the bodies (slides, "Rigid Body Data"): scratch, no state; a system serves one run on one thread.
  mutable std::vector<BodyMotion<S>> motions_;
  mutable std::vector<Wrench<S>> wrenches_;
};

/// Only double is worth an instantiation of its own for one body; float and long double are for studies of rounding.
template <class S>
inline constexpr bool has_one_body_form = std::is_same_v<S, double>;
inline bool fits_one_body_form(const Problem& problem) {
  return problem.bodies.size() == 1 && !problem.bodies.front().pinned;
}

/// Calls f with the concrete system behind the erased one.
template <class S, class F>
auto visit_system(const System<S>& system, F&& f) {
  const auto with = [&]<Orientation O, AngularState A>() {
    if constexpr (has_one_body_form<S>) {
      if (fits_one_body_form(system.problem())) return f(static_cast<const RigidBodies<S, O, A, BodyCount::one>&>(system));
    }
    return f(static_cast<const RigidBodies<S, O, A, BodyCount::many>&>(system));
  };
  const auto with_chart = [&]<Orientation O>() {
    switch (system.formulation().angular_state) {
      case AngularState::velocity_world: return with.template operator()<O, AngularState::velocity_world>();
      case AngularState::velocity_body: return with.template operator()<O, AngularState::velocity_body>();
      default: return with.template operator()<O, AngularState::momentum_world>();
    }
  };
  return system.formulation().orientation == Orientation::quaternion
             ? with_chart.template operator()<Orientation::quaternion>()
             : with_chart.template operator()<Orientation::matrix>();
}

}  // namespace polhode
