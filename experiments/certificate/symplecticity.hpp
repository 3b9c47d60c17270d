// SPDX-License-Identifier: BSD-3-Clause
// Symplecticity defect of a step Φ: with D its derivative at z in the coordinates of PhaseSpace,
//   defect = ‖Dᵀ ω(Φ(z)) D − ω(z)‖ / ‖ω(z)‖  (Frobenius norms).
// If a step leaves the manifold of orientations, Φ includes the projection to it.
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
