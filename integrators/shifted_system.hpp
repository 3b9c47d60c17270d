// SPDX-License-Identifier: BSD-3-Clause
// The flat ODE of a system as seen from one of its states y0: ż = f(t, y0 + z). Its solution from z = 0 is the change of
// the state, and what a method computes of it carries rounding errors in proportion to the change alone.
#pragma once

#include "core/system.hpp"

namespace polhode {

/// Its flat state is dynamic and its rate a virtual call: one instantiation for each scalar serves all formulations. Of
/// the concept MechanicalSystem it has what a method on the flat ODE and its halves asks for.
template <class S>
class ShiftedSystem final : public System<S> {
 public:
  using Scalar = S;
  using Flat = VectorX<S>;

  /// The system must outlive it.
  explicit ShiftedSystem(const System<S>& system)
      : System<S>(system.problems(), system.formulation()), system_(system), from_(zero()), seen_(zero()), whole_(zero()) {}

  /// y0 from now on.
  void stand_at(const Flat& y) { from_ = y; }

  Flat zero() const { return Flat::Zero(this->layout().size()); }
  void rate(S t, const Flat& z, Flat& dz) const { rate(t, z.data(), dz.data()); }
  void acceleration(S t, const Flat& z, Flat& dz) const {
    rate(t, z, whole_);
    velocity_part(dz) = velocity_part(whole_);
  }
  void configuration_rate(S t, const Flat& z, Flat& dz) const {
    rate(t, z, whole_);
    configuration_part(dz) = configuration_part(whole_);
    work_part(dz) = work_part(whole_);
  }
  auto configuration_part(Flat& z) const { return z.head(this->layout().configuration_size); }
  auto velocity_part(Flat& z) const { return z.segment(this->layout().configuration_size, this->layout().velocity_size); }
  S& work_part(Flat& z) const { return z[z.size() - 1]; }

  void rate(S t, const S* z, S* dz) const override {
    seen_ = from_ + Eigen::Map<const Flat>(z, from_.size());
    system_.rate(t, seen_.data(), dz);
  }
  State<S> start() const override { return {0, zero()}; }
  Measurement<S> measure(const Flat& z) const override { return system_.measure(from_ + z); }
  BodySnapshot<S> snapshot(const Flat& z, std::size_t body) const override { return system_.snapshot(from_ + z, body); }
  void project(Flat& z) const override {
    seen_ = from_ + z;
    system_.project(seen_);
    z = seen_ - from_;
  }

 private:
  const System<S>& system_;
  Flat from_;
  mutable Flat seen_, whole_;
};

}  // namespace polhode
