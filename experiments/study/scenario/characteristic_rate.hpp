// SPDX-License-Identifier: BSD-3-Clause
// The characteristic rate of a scenario. A step h is coarse if h times the rate is large.
#pragma once

#include <optional>

#include "core/problem/problem.hpp"

namespace polhode::study::inline scenario {

/// Characteristic rate (rad/s): the largest of
///   √(k/m) of each spring, m the body's mass or, between two moving bodies, the reduced mass,
///   |ω| of each moving body at the start,
///   √(m g l/I) of each pinned body under uniform gravity, l from pivot to mass centre, I its largest moment,
///   √(G (m1 + m2)/r³) of each pair under point gravity, r their distance at the start.
/// Absent if the scenario has none of these.
std::optional<double> characteristic_rate(const Problem& problem);

}  // namespace polhode::study::scenario
