// SPDX-License-Identifier: BSD-3-Clause
// The catalogue of forces: the kinds that a scenario may name under [[force]].
#pragma once

#include <string_view>
#include <vector>

#include "core/problem/force_kind.hpp"
#include "core/problem/problem.hpp"

namespace polhode::inline core::inline forces {

const std::vector<ForceEntry>& force_catalogue();

/// The entry of that name, or null.
const ForceEntry* find_force(std::string_view name);

/// Builds a force on the scalar S from its parameters; kinds are checked by the reader of scenarios.
template <class S>
ForcePointer<S> make_force(const ForceParameters& parameters, std::span<const Body> bodies);
template <>
ForcePointer<float> make_force(const ForceParameters& parameters, std::span<const Body> bodies);
template <>
ForcePointer<double> make_force(const ForceParameters& parameters, std::span<const Body> bodies);
template <>
ForcePointer<long double> make_force(const ForceParameters& parameters, std::span<const Body> bodies);

/// The k-th force of each problem in the lanes of an ensemble; each problem has one free body.
ForcePointer<Lanes> make_force_in_lanes(std::span<const Problem> problems, std::size_t k);

}  // namespace polhode::core::forces
