// SPDX-License-Identifier: BSD-3-Clause
// Symmetric compositions of a symmetric method Φ of order 2: Ψ_h = Φ_{γ_s h} ∘ … ∘ Φ_{γ_1 h} with γ_i = γ_{s+1−i},
// Σ γ_i = 1. Each part starts at the end time of the previous part.
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.4 and V.3.2.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "core/run/integrator.hpp"

namespace polhode::inline integrators {

/// The triple jump, γ1 = γ3 = 1/(2 − 2^{1/3}), γ2 = −2^{1/3} γ1: order 4. Yoshida, Phys. Lett. A 150 (1990) 262.
struct Yoshida4 {
  static constexpr int order = 4;
  static constexpr const char* source = "yoshida1990";
  static constexpr const char* equation =
      R"(y_{n+1} &= \Phi_{\gamma_3 h} \circ \Phi_{\gamma_2 h} \circ \Phi_{\gamma_1 h}\,(y_n) \\
\gamma_1 &= \gamma_3 = 1/(2 - 2^{1/3}), \quad \gamma_2 = -2^{1/3}/(2 - 2^{1/3}) \\
)";
  template <class S>
  static std::array<S, 3> fractions() {
    using std::cbrt;
    const S root = cbrt(S(2)), g = S(1) / (S(2) - root);
    return {g, -root * g, g};
  }
};

/// Five parts, γ1 = γ2 = γ4 = γ5 = 1/(4 − 4^{1/3}), γ3 = −4^{1/3} γ1: order 4. Suzuki, Phys. Lett. A 146 (1990) 319.
struct Suzuki4 {
  static constexpr int order = 4;
  static constexpr const char* source = "suzuki1990";
  static constexpr const char* equation =
      R"(y_{n+1} &= \Phi_{\gamma_5 h} \circ \Phi_{\gamma_4 h} \circ \Phi_{\gamma_3 h} \circ \Phi_{\gamma_2 h}
  \circ \Phi_{\gamma_1 h}\,(y_n) \\
\gamma_1 &= \gamma_2 = \gamma_4 = \gamma_5 = 1/(4 - 4^{1/3}), \quad \gamma_3 = -4^{1/3}/(4 - 4^{1/3}) \\
)";
  template <class S>
  static std::array<S, 5> fractions() {
    using std::cbrt;
    const S root = cbrt(S(4)), g = S(1) / (S(4) - root);
    return {g, g, -root * g, g, g};
  }
};

/// Nine parts, order 6. Kahan & Li, Math. Comp. 66 (1997) 1089, s9odr6a.
struct KahanLi6 {
  static constexpr int order = 6;
  static constexpr const char* source = "kahanLi1997";
  static constexpr const char* equation =
      R"(y_{n+1} &= \Phi_{\gamma_9 h} \circ \dots \circ \Phi_{\gamma_1 h}\,(y_n), \quad \gamma_{10-i} = \gamma_i \\
\gamma_1 &= 0.39216144400731413927925056 \\
\gamma_2 &= 0.33259913678935943859974864 \\
\gamma_3 &= -0.70624617255763935980996482 \\
\gamma_4 &= 0.08221359629355080023149045 \\
\gamma_5 &= 1 - 2 (\gamma_1 + \gamma_2 + \gamma_3 + \gamma_4) \\
)";
  template <class S>
  static std::array<S, 9> fractions() {
    const S a = S(0.39216144400731413927925056L), b = S(0.33259913678935943859974864L),
            c = S(-0.70624617255763935980996482L), d = S(0.08221359629355080023149045L),
            e = S(1) - S(2) * (a + b + c + d);
    return {a, b, c, d, e, d, c, b, a};
  }
};

/// Declaration of the composition Scheme of the method `base`: it has the properties of the method and an order of its
/// own.
template <class Scheme>
Declaration composition_of(Declaration base, std::string name, std::string summary) {
  base.name = std::move(name);
  base.summary = std::move(summary);
  base.equation = Scheme::equation + base.equation;
  base.sources.insert(base.sources.begin(), Scheme::source);
  base.order = Scheme::order;
  return base;
}

/// The composition of the method Base. Base::step() returns a const char*, null or the reason of a failure, and
/// Base::evaluations() counts the right-hand sides.
template <class System, template <class> class Base, class Scheme>
class Composition {
 public:
  using S = typename System::Scalar;
  using Flat = typename System::Flat;

  explicit Composition(const System& system) : base_(system) {}

  const char* step(const System& system, S t, S h, Flat& y) {
    S gone(0);
    for (const S fraction : fractions_) {
      if (const char* failure = base_.step(system, t + gone * h, fraction * h, y)) return failure;
      gone += fraction;
    }
    return nullptr;
  }

  std::int64_t evaluations() const { return base_.evaluations(); }

 private:
  Base<System> base_;
  decltype(Scheme::template fractions<S>()) fractions_ = Scheme::template fractions<S>();
};

}  // namespace polhode::integrators
