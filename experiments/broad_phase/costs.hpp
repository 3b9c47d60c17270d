// SPDX-License-Identifier: BSD-3-Clause
// Comparison of broad phases on moving boxes of a fixed density: cost, and agreement of the reported pairs.
#pragma once

#include "experiments/broad_phase/options.hpp"

namespace polhode::study::broad_phase {

/// Measures the broad phases, writes cost.csv, tables/ and figures/, and prints the table. Returns the exit status: 1
/// if two broad phases do not report the same pairs.
int measure_costs(const BroadPhaseOptions& options);

}  // namespace polhode::study::broad_phase
