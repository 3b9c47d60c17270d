// SPDX-License-Identifier: BSD-3-Clause
// Recorded motion of boxes: reads it, and answers each of its steps with a broad phase.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "collision/broad_phase.hpp"

namespace polhode::study::broad_phase {

struct RecordedStep {
  std::int64_t step = 0;
  std::vector<std::int64_t> ids;  ///< increasing; the body with number k is ids[k]
  std::vector<Bounds> boxes;
};

/// Columns step, id (whole numbers), hx, hy, hz (m, half extents, 0 or more, may be infinite), px, py, pz (m, centre),
/// by name; others are passed over. Rows may stand in any order; steps come out in increasing order. Throws InputError,
/// with file, line and column.
std::vector<RecordedStep> read_recorded_motion(const std::string& path);

/// Writes step,a,b with a < b, sorted, and prints what each step took. Throws std::runtime_error where it cannot write.
void answer_recorded_motion(const std::vector<RecordedStep>& motion, const BroadPhaseEntry& phase,
                            const std::string& out);

}  // namespace polhode::study
