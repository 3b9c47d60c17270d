// SPDX-License-Identifier: BSD-3-Clause
// Compensated summation of the state, for additive methods. The sum y ← y + Δ rounds Δ to the last digit of y. The
// round-off is kept and added to the next increment.
//
//   Δ_n from the method on ż = f(t, y_n + z), z = 0;   a = Δ_n + e_n;
//   y_{n+1} = fl(y_n + a);   e_{n+1} = y_n + a − y_{n+1}
//
// e_{n+1} is exact by Knuth's two-sum, which holds for any order of magnitude of its terms. The accumulated round-off
// is then proportional to ε h Σ |f| instead of ε |y| for each step. Sources: Kahan, Comm. ACM 8 (1965); Møller, BIT 5
// (1965), for Runge–Kutta methods; Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., 4.3; Hairer, Lubich
// & Wanner, Geometric Numerical Integration, 2nd ed., VIII.5.
#pragma once

#include "integrators/catalogue.hpp"

namespace polhode::inline integrators {

/// Builds the method of this entry with compensated summation, in float, double or long double. A projection discards
/// the stored round-off, which belongs to the state before the projection. The system must outlive the integrator.
/// Throws std::invalid_argument for a method that is not additive.
template <class S>
IntegratorPointer<S> make_compensated(const IntegratorEntry& entry, const System<S>& system,
                                      const IntegratorSettings& settings);

}  // namespace polhode::integrators
