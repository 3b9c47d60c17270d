// SPDX-License-Identifier: BSD-3-Clause
// The kick of a splitting method: the flow of the wrench alone over h, at time t and at rest in q, v̇ = M⁻¹ f(t, q, v).
//
// Where the forces do not depend on v that flow is linear in h, and one evaluation gives it exactly. Where they do
// (drag, dampers) the kick is the implicit midpoint rule of that equation,
//   v' = v + h M⁻¹ f(t, q, (v + v')/2),  work' = work + h P(t, q, (v + v')/2),
// which keeps a symmetric splitting symmetric and of even order. It is solved by fixed-point iteration to round-off,
// which converges while h times the damping rate is below 2 and says so when it does not.
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.5 (splitting), V.3 (symmetric methods).
#pragma once

#include <cstdint>
#include <limits>

#include "core/system/concepts.hpp"

namespace polhode::inline integrators {

/// The kick, with its scratch storage and count of evaluations.
template <class System>
class Kick {
 public:
  static_assert(Splitting<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit Kick(const System& system) : mean_(system.zero()), next_(system.zero()) {}

  /// Null, or why there is no result.
  const char* operator()(const System& system, S t, S h, Flat& y) {
    if (system.forces_read_velocity()) return by_midpoint(system, t, h, y);
    system.kick(t, h, y);
    ++evaluations_;
    return nullptr;
  }

  std::int64_t evaluations() const { return evaluations_; }

 private:
  [[gnu::noinline]] const char* by_midpoint(const System& system, S t, S h, Flat& y) {
    mean_ = y;
    for (int iteration = 0; iteration < 100; ++iteration) {
      next_ = y;
      system.kick(t, h, mean_, next_);
      ++evaluations_;
      // (v + v')/2 of this iteration in place of that of the last; the increment keeps the digits.
      auto mean = system.velocity_part(mean_);
      const auto update = (S(0.5) * (system.velocity_part(y) + system.velocity_part(next_)) - mean).eval();
      const S change = update.cwiseAbs().maxCoeff(), size = mean.cwiseAbs().maxCoeff();
      mean += update;
      if (change <= S(4) * std::numeric_limits<S>::epsilon() * size) {
        y = next_;
        return nullptr;
      }
      if (!next_.allFinite()) break;
    }
    return "the implicit midpoint rule of the kick did not converge: the step is too long for the damping";
  }

  Flat mean_, next_;
  std::int64_t evaluations_ = 0;
};

}  // namespace polhode
