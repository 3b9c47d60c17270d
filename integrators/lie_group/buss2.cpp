// SPDX-License-Identifier: BSD-3-Clause
// Buss's augmented second-order method. The rotation vector θ of a step assumes a constant angular acceleration α in
// world axes and includes the first commutator of the Magnus series:
//   θ = h ω + h²/2 α + h³/12 α × ω,  R' = exp(θ) R,  p' = p + h v + h²/2 f/m.
// The method updates the momentum, which is constant for free bodies. Under forces it follows Heun's rule:
//   L' = L + h/2 (τ(t, q, L) + τ(t + h, q', L + h τ(t, q, L))).
// Linear momentum and work follow the same rule. In body axes θ is h Ω + h²/2 Ω̇ + h³/12 Ω̇ × Ω, because Rᵀα = Ω̇.
// Source: Buss, Accurate and efficient simulation of rigid-body rotations, J. Comput. Phys. 164 (2000). Heun's rule for
// the forces is not from the source.
#include "integrators/fixed_step.hpp"
#include "integrators/lie_group/gyroscopic_only.hpp"

namespace polhode::inline integrators {

template <class System>
class Buss2 {
 public:
  static_assert(BodyFrame<System>);
  using S = typename System::Scalar;
  using Flat = typename System::Flat;
  using Tangent = typename System::Tangent;

  explicit Buss2(const System& system)
      : rate_(system.zero()),
        start_(system.zero()),
        before_(system.zero_tangent()),
        after_(system.zero_tangent()),
        twist_(system.zero_tangent()),
        acceleration_(system.zero_tangent()),
        bracket_(system.zero_tangent()) {}

  [[gnu::noinline]] void step(const System& system, S t, S h, Flat& y) {
    const S half = h / S(2);
    start_ = y;
    system.wrench(t, y, before_);
    system.configuration_rate(t, y, rate_);
    const auto power = system.work_part(rate_).eval();
    system.body_twist(y, twist_);
    system.body_acceleration(y, before_, acceleration_);
    system.bracket(acceleration_, twist_, bracket_);
    twist_ = h * (twist_ + half * (acceleration_ + (h / S(6)) * bracket_));

    after_ = h * before_;
    system.carry_momentum(twist_, after_, y);
    system.wrench(t + h, y, after_);
    after_ = half * (before_ + after_);
    y = start_;
    system.carry_momentum(twist_, after_, y);
    system.configuration_rate(t + h, y, rate_);
    system.work_part(y) += half * (power + system.work_part(rate_));
  }

 private:
  Flat rate_, start_;
  Tangent before_, after_, twist_, acceleration_, bracket_;
};

IntegratorEntry buss2() {
  IntegratorEntry entry = fixed_step<Buss2, Forms::many_bodies>(
      {.name = "buss2",
       .family = "Lie group",
       .summary = "Buss: q' = q exp(h w + h^2/2 a + h^3/12 a x w), the momentum by Heun's rule",
       .equation =
           R"(\dot\Omega &= I^{-1} (R_n^{\mathsf T} \tau_n - \Omega_n \times I \Omega_n), \quad
  \tau_n = \tau(t_n, q_n, v_n) \\
\theta &= h\,\Omega_n + \tfrac12 h^2\,\dot\Omega + \tfrac1{12} h^3\,\dot\Omega \times \Omega_n \\
R_{n+1} &= R_n \exp(\theta), \quad x_{n+1} = x_n + h\,\dot x_n + \tfrac12 h^2 f_n/m \\
L_{n+1} &= L_n + \tfrac12 h\,\bigl(\tau_n + \tau(t_n + h,\; q_{n+1},\; L_n + h\,\tau_n)\bigr) \\
m \dot x_{n+1} &= m \dot x_n + \tfrac12 h\,\bigl(f_n + f(t_n + h,\; q_{n+1},\; m \dot x_n + h f_n)\bigr))",
       .sources = {"buss2000"},
       .order = 2,
       .evaluations_per_step = 2,
       .lie_group = true,
       .conserves_momentum = true,
       .conserves_casimir = true});
  entry.refusal = needs_the_gyroscopic_term;
  return entry;
}

}  // namespace polhode::integrators
