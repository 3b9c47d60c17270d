// SPDX-License-Identifier: BSD-3-Clause
// Clean-up of the numbers of a result: all finite, and no negative zeros.
#pragma once

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline record {

/// Removes each number that is not finite, and replaces −0 by 0. Metrics that may be infinite are left unchanged.
void keep_finite(RunResult& result);

}  // namespace polhode::study::record
