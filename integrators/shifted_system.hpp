// SPDX-License-Identifier: BSD-3-Clause
// The flat ODE of a system as seen from one of its states y0: ż = f(t, y0 + z). Its solution from z = 0 is the change
// of the state, and what a method computes of it carries rounding errors in proportion to the change alone.
#pragma once

#include <stdexcept>

#include "core/system/rigid_bodies.hpp"

namespace polhode {

/// Has what a method on the flat ODE and its halves asks for; no group steps, inertia map or flows, since z is no
/// configuration: a method that asks for those is not additive, and gets a std::logic_error.
template <class S>
class ShiftedSystem final : public ManyBodies<S> {
 public:
  using Flat = VectorX<S>;
  using Tangent = VectorX<S>;

  /// The system must outlive it.
  explicit ShiftedSystem(const System<S>& system)
      : ManyBodies<S>(system.problems(), system.formulation()),
        system_(system),
        from_(this->zero()),
        seen_(this->zero()),
        whole_(this->zero()) {}

  /// y0 from now on.
  void stand_at(const Flat& y) { from_ = y; }

  void rate(S t, const S* z, S* dz) const override {
    seen_ = from_ + Eigen::Map<const Flat>(z, from_.size());
    system_.rate(t, seen_.data(), dz);
  }
  void rate(S t, const Flat& z, Flat& dz) const override { rate(t, z.data(), dz.data()); }
  void acceleration(S t, const Flat& z, Flat& dz) const override {
    rate(t, z, whole_);
    this->velocity_part(dz) = this->velocity_part(whole_);
  }
  void configuration_rate(S t, const Flat& z, Flat& dz) const override {
    rate(t, z, whole_);
    this->configuration_part(dz) = this->configuration_part(whole_);
    this->work_part(dz) = this->work_part(whole_);
  }

  State<S> start() const override { return {0, this->zero()}; }
  Measurement<S> measure(const Flat& z) const override { return system_.measure(from_ + z); }
  Measurement<S> measure_flat(const S* z) const override { return measure(Eigen::Map<const Flat>(z, from_.size())); }
  BodySnapshot<S> snapshot(const Flat& z, std::size_t body) const override { return system_.snapshot(from_ + z, body); }
  BodyMotion<S> motion_of(const Flat& z, std::size_t body) const override { return system_.motion_of(from_ + z, body); }
  const Matrix3<S>& inverse_inertia(std::size_t body) const override { return system_.inverse_inertia(body); }
  void apply_impulse(Flat&, std::size_t, const Vector3<S>&, const Vector3<S>&) const override { refuse(); }
  void displace(Flat&, std::size_t, const Vector3<S>&, const Vector3<S>&) const override { refuse(); }
  void project(Flat& z) const override { project_flat(z.data()); }
  void project_flat(S* z) const override {
    Eigen::Map<Flat> change(z, from_.size());
    seen_ = from_ + change;
    system_.project(seen_);
    change = seen_ - from_;
  }

  void twist(const Flat&, Tangent&) const override { refuse(); }
  void retract(Flat&, const Tangent&) const override { refuse(); }
  void dexp_inverse(const Tangent&, const Tangent&, Tangent&) const override { refuse(); }
  void wrench(S, const Flat&, Tangent&) const override { refuse(); }
  void momentum(const Flat&, Tangent&) const override { refuse(); }
  void set_momentum(const Tangent&, Flat&) const override { refuse(); }
  void body_twist(const Flat&, Tangent&) const override { refuse(); }
  void set_body_twist(const Tangent&, Flat&) const override { refuse(); }
  void body_acceleration(const Flat&, const Tangent&, Tangent&) const override { refuse(); }
  void retract_in_body(Flat&, const Tangent&) const override { refuse(); }
  void carry_momentum(const Tangent&, const Tangent&, Flat&) const override { refuse(); }
  void bracket(const Tangent&, const Tangent&, Tangent&) const override { refuse(); }
  void kick(S, S, Flat&) const override { refuse(); }
  void kick(S, S, const Flat&, Flat&) const override { refuse(); }
  void free_flow(S, Flat&, const Rotor<S>&) const override { refuse(); }

 private:
  [[noreturn]] static void refuse() { throw std::logic_error("a change of the state is no configuration"); }

  const System<S>& system_;
  Flat from_;
  mutable Flat seen_, whole_;
};

}  // namespace polhode
