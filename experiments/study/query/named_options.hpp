// SPDX-License-Identifier: BSD-3-Clause
// The options on demand that have a column in the runs.csv of stored studies.
#pragma once

#include <span>

#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline query {

/// The options that the studies of the stores give, as their manifests say, and those of which a configuration has
/// another value than the usual one: a study that has not ended has no manifest yet.
NamedOptions named_options(const ResultStores& stores, std::span<const Configuration* const> configurations);

}  // namespace polhode::study::query
