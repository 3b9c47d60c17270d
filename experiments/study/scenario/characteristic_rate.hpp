// SPDX-License-Identifier: BSD-3-Clause
// The rate against which the steps of a scenario are measured, so that h times it says how coarse a step is.
#pragma once

#include <optional>

#include "core/problem/problem.hpp"

namespace polhode::study::inline scenario {

/// rad/s; the largest of
///   √(k/m) of each spring, m the body's mass or, between two that move, the reduced mass,
///   |ω| of each moving body at the start,
///   √(m g l/I) of each pinned body under uniform gravity, l from pivot to mass centre, I its largest moment,
///   √(G (m1 + m2)/r³) of each pair under point gravity, r their distance at the start.
/// Absent where there is none of these.
std::optional<double> characteristic_rate(const Problem& problem);

}  // namespace polhode::study
