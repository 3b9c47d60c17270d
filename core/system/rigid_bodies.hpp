// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies under forces as a mechanical system, in the chosen formulation. One template covers a single body, whose
// state size is known at compile time, and many bodies. Polhode's own methods are written against the concepts of
// core/system/concepts.hpp and are instantiated for the concrete type. Each group of operations has a file of its own:
//
//   FlatOde, PartitionedOde   core/system/flat_ode.hpp: the equations of motion
//   LieGroup                  core/system/lie_group.hpp
//   InertiaMap                core/system/inertia_map.hpp
//   BodyFrame                 core/system/body_frame.hpp
//   Splitting                 core/system/splitting.hpp
//   Measurable                core/system/measurement.hpp
#pragma once

#include <utility>
#include <vector>

#include "core/math/flatten.hpp"
#include "core/system/body_frame.hpp"
#include "core/system/body_wrenches.hpp"
#include "core/system/flat_ode.hpp"
#include "core/system/inertia_map.hpp"
#include "core/system/lie_group.hpp"
#include "core/system/measurement.hpp"
#include "core/system/splitting.hpp"

namespace polhode::inline core::inline system {

/// Rigid bodies in one formulation. For many bodies the members override those of ManyBodies. For one body they are
/// called through the concrete type only.
template <class S, Orientation O, AngularState A, BodyCount N>
class RigidBodies final : public BodyWrenches<S, O, A, N> {
 public:
  using Base = BodyWrenches<S, O, A, N>;
  using Base::is_one;
  using typename Base::ChartOf;
  using typename Base::ChartValue;
  using typename Base::Constants;
  using typename Base::Flat;
  using typename Base::Tangent;
  using Vector = Vector3<S>;
  using Matrix = Matrix3<S>;

  /// Takes one problem, or for lanes one problem for each lane.
  RigidBodies(std::vector<Problem> problems, const Formulation& formulation);

  // ---- operations of the concepts -----------------------------------------------------------------------------------

  void rate(S t, const Flat& y, Flat& dy) const {
    if constexpr (inlines) flat_ode::rate(*this, t, y.data(), dy.data());
    else full_rate(t, y.data(), dy.data());
  }
  void acceleration(S t, const Flat& y, Flat& dy) const {
    if constexpr (inlines) flat_ode::acceleration(*this, t, y.data(), dy.data());
    else velocity_rate(t, y.data(), dy.data());
  }
  void configuration_rate(S t, const Flat& y, Flat& dy) const {
    if constexpr (inlines) flat_ode::configuration_rate(*this, t, y.data(), dy.data());
    else kinematic_rate(t, y.data(), dy.data());
  }

  void twist(const Flat& y, Tangent& xi) const { lie_group::twist(*this, y, xi); }
  void retract(Flat& y, const Tangent& xi) const { lie_group::retract(*this, y, xi); }
  void dexp_inverse(const Tangent& theta, const Tangent& eta, Tangent& out) const {
    lie_group::dexp_inverse(*this, theta, eta, out);
  }

  void wrench(S t, const Flat& y, Tangent& w) const { inertia_map::wrench(*this, t, y, w); }
  void momentum(const Flat& y, Tangent& p) const { inertia_map::momentum(*this, y, p); }
  void set_momentum(const Tangent& p, Flat& y) const { inertia_map::set_momentum(*this, p, y); }

  void body_twist(const Flat& y, Tangent& xi) const { body_frame::twist(*this, y, xi); }
  void set_body_twist(const Tangent& xi, Flat& y) const { body_frame::set_twist(*this, xi, y); }
  void body_acceleration(const Flat& y, const Tangent& wrench, Tangent& rate) const {
    body_frame::acceleration(*this, y, wrench, rate);
  }
  void retract_in_body(Flat& y, const Tangent& xi) const { body_frame::retract(*this, y, xi); }
  void carry_momentum(const Tangent& theta, const Tangent& impulse, Flat& y) const {
    body_frame::carry_momentum(*this, theta, impulse, y);
  }
  void bracket(const Tangent& a, const Tangent& b, Tangent& out) const { body_frame::bracket(*this, a, b, out); }

  void kick(S t, S h, Flat& y) const { splitting::kick(*this, t, h, y); }
  void kick(S t, S h, const Flat& seen, Flat& y) const { splitting::kick(*this, t, h, seen, y); }
  template <class AnyRotor>
  requires(!is_lanes<S>) void free_flow(S h, Flat& y, AnyRotor&& rotor) const {
    splitting::free_flow(*this, h, y, rotor);
  }

  /// measure() and project() on the array of the state's numbers, for callers that know the concrete type. They are
  /// compiled once; measurement::measure() and measurement::project() inline.
  Measurement<S> measure_flat(const S* y) const;
  void project_flat(S* y) const;

  // ---- interface of System ------------------------------------------------------------------------------------------

  void rate(S t, const S* y, S* dy) const { full_rate(t, y, dy); }
  State<S> start() const;
  Measurement<S> measure(const VectorX<S>& y) const;
  BodySnapshot<S> snapshot(const VectorX<S>& y, std::size_t body) const;
  BodyMotion<S> motion_of(const VectorX<S>& y, std::size_t body) const;
  const Matrix3<S>& inverse_inertia(std::size_t i) const { return this->body(i).inverse_inertia; }
  void apply_impulse(VectorX<S>& y, std::size_t body, const Vector3<S>& impulse,
                     const Vector3<S>& angular_impulse) const;
  void displace(VectorX<S>& y, std::size_t body, const Vector3<S>& shift, const Vector3<S>& turn) const;
  void project(VectorX<S>& y) const;

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
};

}  // namespace polhode::core::system
