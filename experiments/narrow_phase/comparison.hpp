// SPDX-License-Identifier: BSD-3-Clause
// Comparison of narrow phases on random, touching and degenerate pairs of boxes: agreement and cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "collision/narrow_phase.hpp"
#include "experiments/study/record/analysis.hpp"

namespace polhode::study::narrow_phase {

/// Adds comparison.csv and its table to the analysis: for each class of pairs and each narrow phase the number of
/// results that differ from `sat`, and the largest difference relative to the smaller box. Adds the cost to
/// Analysis::timed.
void compare_narrow_phases(const std::vector<const NarrowPhaseEntry*>& entries, std::size_t count, std::uint64_t seed,
                           Analysis& analysis);

/// Adds the rate of false overlaps that the course report's test reports for two cubes, against the angle by which one
/// of them is rotated.
void measure_course_report(std::size_t count, std::uint64_t seed, Analysis& analysis);

}  // namespace polhode::study::narrow_phase
