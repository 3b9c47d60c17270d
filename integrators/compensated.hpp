// SPDX-License-Identifier: BSD-3-Clause
// Compensated summation of the state, for methods whose step is a sum: y ← y + Δ rounds to the digits of y, far more
// than Δ itself is rounded, and what is lost is kept and added to the next increment.
//
//   Δ_n from the method on ż = f(t, y_n + z), z = 0;   a = Δ_n + e_n;   y_{n+1} = fl(y_n + a), e_{n+1} = y_n + a −
//   y_{n+1}
//
// e_{n+1} is exact (Knuth's sum of two numbers, whichever is larger). Rounding then adds up as ε h Σ |f| does and no
// longer as ε |y| for each step.
// Sources: Kahan, Comm. ACM 8 (1965); Møller, BIT 5 (1965), of Runge–Kutta methods; Higham, Accuracy and Stability of
// Numerical Algorithms, 2nd ed., 4.3; Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., VIII.5.
#pragma once

#include "integrators/catalogue.hpp"

namespace polhode::inline integrators {

/// The method of this entry with its sums compensated. A projection discards the error that is carried, for it belongs
/// to the state before it. Throws std::invalid_argument for a method that is not additive. One for each of float,
/// double and long double; the system must outlive it.
template <class S>
IntegratorPointer<S> make_compensated(const IntegratorEntry& entry, const System<S>& system);

}  // namespace polhode
