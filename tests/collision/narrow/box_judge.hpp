// SPDX-License-Identifier: BSD-3-Clause
// A narrow phase on pairs of boxes against the exact judge.
#pragma once

#include <cstdint>
#include <string>

#include "collision/narrow_phase.hpp"
#include "experiments/narrow_phase/box_pairs.hpp"

namespace polhode {

using study::narrow_phase::BoxPairCase;
using study::narrow_phase::BoxPairs;

/// All its numbers, for a message.
std::string describe(const BoxPairCase& pair);

/// Fails the test where an answer is missing or wrong: the signed distance by more than `share` of the smaller box, the
/// overlap where the true signed distance exceeds 1e-14 of the larger box, the witness points, the mirrored question,
/// and 1e-9 after moving B by the depth. The rounding of the poses is allowed for: `rounding` units of 1e-16 of their
/// numbers.
void judge(const NarrowPhase& narrow, const BoxPairCase& pair, double share, double rounding = 0);

/// The pairs 0 … count − 1 of a sequence, up to the first that fails.
void judge_many(const NarrowPhase& narrow, std::uint64_t seed, std::uint64_t count, double share, double rounding = 0);

/// The cases of FCL, libccd, Coal and Drake, each with its source in collision_cases.csv, by the judge and by the
/// distance that is published.
void judge_published(const NarrowPhase& narrow, double share);

}  // namespace polhode
