// SPDX-License-Identifier: BSD-3-Clause
// Common step of the two implicit midpoint methods on the Lie group. Wrench and power are evaluated at the midpoint:
//   p' = p + h w(t + h/2, q ⊕ θ/2, θ/h),  q' = q ⊕ θ.
// p is the momentum about the reference point in world axes. θ is in body axes; its linear part is h times a velocity.
// The parameter Where selects the equation for θ:
//   middle: θ = h Ω̄, with Ω̄ the body twist of the momentum p + h/2 w at q ⊕ θ/2.
//   end:    θ = h/2 (Ω + Ω'), with Ω' the body twist of the momentum p' at q'.
// For translation both are the implicit midpoint rule. A twist parallel to θ has the same components in the body axes
// of q and of q ⊕ θ/2.
#pragma once

#include <algorithm>

#include "integrators/fixed_step.hpp"
#include "integrators/lie_group/gyroscopic_only.hpp"
#include "integrators/lie_group/root.hpp"

namespace polhode::inline integrators {

/// Equation for θ, see above.
enum class TwistRule { middle, end };

template <class System, TwistRule Where>
class MidpointStep {
 public:
  static_assert(BodyFrame<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  using Tangent = typename System::Tangent;

  explicit MidpointStep(const System& system) : work_(system) {}

  [[gnu::noinline]] const char* step(const System& system, S t, S h, Flat& y) {
    const S half_way = t + h / S(2);
    Equations equations(system, work_, half_way, h, y);
    VectorX<S>& theta = work_.unknown;
    theta = h * work_.twist;
    const S scale = std::max(S(1), y.cwiseAbs().maxCoeff());
    if (const char* failure = work_.root.solve(equations, theta, scale)) return failure;
    equations.residual(theta, work_.residual);
    work_.theta = theta;
    work_.impulse = h * work_.wrench;
    system.carry_momentum(work_.theta, work_.impulse, y);
    system.configuration_rate(half_way, work_.middle, work_.rate);
    system.work_part(y) += h * system.work_part(work_.rate);
    return nullptr;
  }

  std::int64_t evaluations() const { return work_.evaluations; }
  std::int64_t iterations() const { return work_.root.iterations(); }

 private:
  struct Work {
    explicit Work(const System& system)
        : middle(system.zero()),
          moved(system.zero()),
          rate(system.zero()),
          twist(system.zero_tangent()),
          theta(system.zero_tangent()),
          velocity(system.zero_tangent()),
          wrench(system.zero_tangent()),
          impulse(system.zero_tangent()) {}
    Flat middle, moved, rate;
    Tangent twist;  ///< (v, Ω) at the start of the step
    Tangent theta, velocity, wrench, impulse;
    VectorX<S> unknown, residual;
    RootFinder<S> root;
    std::int64_t evaluations = 0;
  };

  /// Residual of the equation for θ: the left-hand side minus the right-hand side.
  class Equations final : public StepEquations<S> {
   public:
    Equations(const System& system, Work& work, S half_way, S h, const Flat& start)
        : system_(system), work_(work), half_way_(half_way), h_(h), start_(start) {
      system.body_twist(start, work.twist);
    }

    void residual(const VectorX<S>& x, VectorX<S>& f) override {
      Work& w = work_;
      w.theta = x / S(2);
      w.middle = start_;
      system_.retract_in_body(w.middle, w.theta);
      w.velocity = x / h_;
      system_.set_body_twist(w.velocity, w.middle);
      system_.wrench(half_way_, w.middle, w.wrench);
      ++w.evaluations;
      w.moved = start_;
      if constexpr (Where == TwistRule::middle) {
        w.impulse = (h_ / S(2)) * w.wrench;
        system_.carry_momentum(w.theta, w.impulse, w.moved);
        system_.body_twist(w.moved, w.theta);
        f = x - h_ * w.theta;
      } else {
        w.theta = x;
        w.impulse = h_ * w.wrench;
        system_.carry_momentum(w.theta, w.impulse, w.moved);
        system_.body_twist(w.moved, w.theta);
        f = x - (h_ / S(2)) * (w.twist + w.theta);
      }
    }

   private:
    const System& system_;
    Work& work_;
    const S half_way_, h_;
    const Flat start_;
  };

  Work work_;
};

}  // namespace polhode::integrators
