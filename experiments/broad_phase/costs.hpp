// SPDX-License-Identifier: BSD-3-Clause
// What broad phases cost on boxes that fly about at a fixed density, and whether they agree.
#pragma once

#include "experiments/broad_phase/options.hpp"

namespace polhode::study::broad_phase {

/// Measures, writes cost.csv, tables/ and figures/, and prints the table. Returns the exit status: 1 where two broad
/// phases do not report the same pairs.
int measure_costs(const BroadPhaseOptions& options);

}  // namespace polhode::study
