// SPDX-License-Identifier: BSD-3-Clause
// The contents of the stores: experiments, scenarios, methods, runs by status, damaged runs.
#pragma once

#include "experiments/study/query/result_stores.hpp"

namespace polhode::study::results {

/// Prints the summary of each folder. The checksum of every run is checked. Returns the exit status.
int summarise(const ResultStores& stores);

}  // namespace polhode::study::results
