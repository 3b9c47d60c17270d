// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a result by their places in it: the store keeps them in this order, and all of them are finite.
#pragma once

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline record {

/// Removes each number that is not finite, and replaces −0 by 0. Metrics that may be infinite are left unchanged.
void keep_finite(RunResult& result);

}  // namespace polhode::study
