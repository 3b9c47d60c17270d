// SPDX-License-Identifier: BSD-3-Clause
// Pairs of boxes from a CSV file, and what a narrow phase says of them.
#pragma once

#include <string>
#include <vector>

#include "collision/narrow/box_sat.hpp"
#include "collision/narrow_phase.hpp"

namespace polhode::study::narrow_phase {

struct BoxPair {
  std::string id;
  PosedBox a, b;
};

/// Columns id, class, then of A and of B half extents (3, m), position (3, m) and quaternion w x y z, which is
/// normalised: ahx … aqz, bhx … bqz by name, or in this order where the header has none of these names. Further columns
/// are ignored. Throws InputError.
std::vector<BoxPair> read_pairs(const std::string& path);

/// results.csv: id, overlap (0 or 1), sdist (m, negative: depth), nx, ny, nz (unit, in which B leaves A). Throws
/// InputError, naming the pair, where the narrow phase has no answer.
std::string answers(const std::vector<BoxPair>& pairs, const NarrowPhase& narrow_phase);

}  // namespace polhode::study
