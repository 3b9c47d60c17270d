// SPDX-License-Identifier: BSD-3-Clause
// The id of a run: a hash of all that decides its results.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/study/record/run_record.hpp"
#include "experiments/study/record/versions.hpp"

namespace polhode::study::inline record {

/// 16 hexadecimal digits. `canonical`: Scenario::canonical with the varied keys set. Varied keys with an empty value,
/// which the run leaves unchanged, are no part of it.
std::string run_id(const RunConfig& config, std::string_view canonical, int version = results_version);

/// What the id is made of besides the version and the text of the scenario: options by the names of their columns (or
/// as files name them), max_steps, reference, and the varied keys. Of two configurations that vary the same keys, the
/// parts are the same if and only if identity_of() is.
std::vector<std::pair<std::string, std::string>> identity_parts(const RunConfig& config);

}  // namespace polhode::study::record
