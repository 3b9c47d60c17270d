// SPDX-License-Identifier: BSD-3-Clause
// The kick of a splitting method: the flow of v̇ = M⁻¹ f(t, q, v) over h at constant t and q.
//
// If the forces do not depend on v, the flow is linear in h, and one evaluation gives it exactly. If they do (drag,
// dampers), the kick is the implicit midpoint rule for that equation,
//   v' = v + h M⁻¹ f(t, q, (v + v')/2),  work' = work + h P(t, q, (v + v')/2).
// A symmetric splitting then remains symmetric and of even order. The rule is solved by fixed-point iteration to
// round-off. The iteration converges if h × damping rate < 2; otherwise the kick fails with a message.
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

  /// Applies the kick of length h (s) at time t (s) to y. Returns null, or the reason of a failure.
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
      // Replaces the last (v + v')/2 by the new one. The update by an increment limits the round-off.
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

}  // namespace polhode::integrators
