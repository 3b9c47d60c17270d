// SPDX-License-Identifier: BSD-3-Clause
// The narrow phases side by side on random, touching and degenerate pairs of boxes: do they agree, and what do they
// cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "collision/narrow_phase.hpp"
#include "experiments/study/record/analysis.hpp"

namespace polhode::study::narrow_phase {

/// comparison.csv and its table: of each class and narrow phase how often it differs from `sat`, by how much of the
/// smaller box, and in timings/ what it costs. Tables and files of `analysis` are added to.
void compare_narrow_phases(const std::vector<const NarrowPhaseEntry*>& entries, std::size_t count, std::uint64_t seed,
                           Analysis& analysis);

/// How often the course report's test calls two cubes overlapping that are not, against the angle by which one is
/// turned.
void measure_course_report(std::size_t count, std::uint64_t seed, Analysis& analysis);

}  // namespace polhode::study
