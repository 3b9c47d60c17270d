// SPDX-License-Identifier: BSD-3-Clause
// The interface that a method of our own is compiled against. Fast methods are compiled for a single free body too.
#pragma once

#include <functional>
#include <memory>

#include "core/system/body_constants.hpp"
#include "core/system/system.hpp"

namespace polhode::inline core::inline system {

/// Rotation of a free body over a step, used by free_flow(): dq = rotor(constants, h, m). h is in s. m is the angular
/// momentum in principal axes, updated by the call. dq is the unit quaternion of the rotation.
template <class S>
using Rotor = std::function<Quaternion<S>(const BodyConstants<S>&, S, Vector3<S>&)>;

/// Interface of every system except a single free body in double, alone or in lanes; independent of the formulation.
/// Each operation on all bodies is one virtual call, so that a method is compiled once for all formulations. For a
/// single free body the call costs as much as the operation itself. That case has a type for each formulation, whose
/// operations inline; many_bodies_form() gives it this interface, for methods that take longer than the calls.
/// core/system/concepts.hpp states what each operation does.
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
  auto work_part(Flat& y) const { return y.tail(this->layout().work_size); }

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

/// The system itself, not owned, or for a single free body in double a system with its problem, formulation and added
/// forces: same states, same digits.
template <class S>
std::shared_ptr<const ManyBodies<S>> many_bodies_form(const System<S>& system);

}  // namespace polhode::core::system
