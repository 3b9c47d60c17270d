// SPDX-License-Identifier: BSD-3-Clause
// How far a step is from being symplectic: with D its derivative at z in the coordinates of PhaseSpace,
//   defect = ‖Dᵀ ω(Φ(z)) D − ω(z)‖ / ‖ω(z)‖  (Frobenius norms).
// A step that leaves the manifold of orientations counts with the projection that brings it back.
#pragma once

#include <functional>
#include <optional>

#include "experiments/certificate/phase_space.hpp"

namespace polhode::study::certificate {

/// Advances a flat state in place; false where it fails.
template <class S>
using FlatMap = std::function<bool(VectorX<S>& y)>;

/// The derivative is taken by central differences of sixth order with steps of `increment`, 6 evaluations of the map
/// for each dimension. Absent where the map fails. S: double or long double.
template <class S>
std::optional<double> symplecticity_defect(const PhaseSpace<S>& space, const FlatMap<S>& map, const PhasePoint<S>& at,
                                           double increment);

/// Where truncation, of the order of increment⁶/140, meets the round-off ε/increment of that quotient.
template <class S>
constexpr double best_increment = sizeof(S) > sizeof(double) ? 2e-3 : 8e-3;

/// What round-off and truncation leave in the defect of a symplectic map.
template <class S>
constexpr double differentiation_floor = sizeof(S) > sizeof(double) ? 1e-14 : 1e-11;

}  // namespace polhode::study
