// SPDX-License-Identifier: BSD-3-Clause
// Symplecticity defect of a step Φ. z(u) is the point of the phase space displaced from z by the coordinates u and
// projected to the equations of the joints, C its derivative and D that of Φ(z(u)) at u = 0, in the coordinates of
// PhaseSpace:
//   defect = ‖Dᵀ ω(Φ(z)) D − Cᵀ ω(z) C‖ / ‖Cᵀ ω(z) C‖  (Frobenius norms).
// Without joints C = 1. With joints the columns of C span the tangent space of {g(q) = 0, G v = 0}, so that the form is
// that of the cotangent bundle of g(q) = 0. If a step leaves the manifold of orientations, Φ includes the projection to
// it.
#pragma once

#include <functional>
#include <optional>

#include "experiments/certificate/phase_space.hpp"

namespace polhode::study::certificate {

/// A map that advances a flat state in place; returns false if it fails.
template <class S>
using FlatMap = std::function<bool(VectorX<S>& y)>;

/// The defect of a map at a point. The derivative is computed by central differences of sixth order with steps of
/// `increment`: 6 evaluations of the map for each dimension. Absent if the map fails. S: double or long double.
template <class S>
std::optional<double> symplecticity_defect(const PhaseSpace<S>& space, const FlatMap<S>& map, const PhasePoint<S>& at,
                                           double increment);

/// Increment at which the truncation error of the difference quotient, of the order of increment⁶/140, equals its
/// round-off error ε/increment.
template <class S>
constexpr double best_increment = sizeof(S) > sizeof(double) ? 2e-3 : 8e-3;

/// Measured defect of a symplectic map due to round-off and truncation of the difference quotient.
template <class S>
constexpr double differentiation_floor = sizeof(S) > sizeof(double) ? 1e-14 : 1e-11;

}  // namespace polhode::study::certificate
