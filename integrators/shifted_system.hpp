// SPDX-License-Identifier: BSD-3-Clause
// The flat ODE of a system relative to a base state y0: ż = f(t, y0 + z). Its solution from z = 0 is the change of the
// state. The round-off of a method applied to it is proportional to that change instead of the state.
#pragma once

#include "core/system/concepts.hpp"
#include "core/system/system.hpp"

namespace polhode::inline integrators {

/// The ODE of the change z. It is a PartitionedOde only: the change of a configuration is not a configuration, so that
/// group operations and inertia map do not exist.
template <class S>
class ShiftedSystem final : public Ode<S> {
 public:
  using Scalar = S;
  using Flat = VectorX<S>;

  /// The system must outlive this object.
  explicit ShiftedSystem(const System<S>& system) : system_(system), from_(zero()), there_(zero()), whole_(zero()) {}

  /// Sets the base state y0.
  void stand_at(const Flat& y) { from_ = y; }

  int size() const override { return system_.size(); }
  Flat zero() const { return Flat::Zero(size()); }

  void rate(S t, const S* z, S* dz) const override {
    there_ = from_ + Eigen::Map<const Flat>(z, from_.size());
    system_.rate(t, there_.data(), dz);
  }
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

  auto configuration_part(Flat& z) const { return z.head(system_.layout().configuration_size); }
  auto velocity_part(Flat& z) const {
    return z.segment(system_.layout().configuration_size, system_.layout().velocity_size);
  }
  auto work_part(Flat& z) const { return z.tail(system_.layout().work_size); }

 private:
  const System<S>& system_;
  Flat from_;
  mutable Flat there_, whole_;
};

static_assert(PartitionedOde<ShiftedSystem<double>>);

}  // namespace polhode::integrators
