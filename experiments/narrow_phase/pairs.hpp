// SPDX-License-Identifier: BSD-3-Clause
// Pairs of boxes from a CSV file, and the results of a narrow phase for them.
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

/// Reads the columns id, class, then for A and for B half extents (3, m), position (3, m) and quaternion w x y z, which
/// is normalized: ahx … aqz, bhx … bqz by name, or in this order if the header has none of these names. Further columns
/// are ignored. Throws InputError.
std::vector<BoxPair> read_pairs(const std::string& path);

/// Text of results.csv: id, overlap (0 or 1), sdist (signed distance, m; negative: depth), nx, ny, nz (unit normal, the
/// direction in which B separates from A). Throws InputError, with the id, for a pair without a result.
std::string answers(const std::vector<BoxPair>& pairs, const NarrowPhase& narrow_phase);

}  // namespace polhode::study::narrow_phase
