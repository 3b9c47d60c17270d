// SPDX-License-Identifier: BSD-3-Clause
// Recorded motions of boxes: reader, and computation of the pairs of each step by a broad phase.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "collision/broad_phase.hpp"

namespace polhode::study::broad_phase {

struct RecordedStep {
  std::int64_t step = 0;
  std::vector<std::int64_t> ids;  ///< ids of the boxes in ascending order
  std::vector<Bounds> boxes;
};

/// Reads a CSV file with the columns step, id (whole numbers), hx, hy, hz (half extents, m, not negative, may be
/// infinite) and px, py, pz (centre, m), found by name; other columns are ignored. Rows may be in any order; steps are
/// returned in ascending order. Throws InputError, with file, line and column.
std::vector<RecordedStep> read_recorded_motion(const std::string& path);

/// Writes the pairs as rows step,a,b with ids a < b, sorted, and prints the wall time of each step. Throws
/// std::runtime_error if the file cannot be written.
void answer_recorded_motion(const std::vector<RecordedStep>& motion, const BroadPhaseEntry& phase,
                            const std::string& out);

}  // namespace polhode::study::broad_phase
