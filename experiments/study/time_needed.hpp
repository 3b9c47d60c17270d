// SPDX-License-Identifier: BSD-3-Clause
// The time that a study still takes, in the words of --dry-run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/plan/experiment.hpp"
#include "experiments/study/plan/options.hpp"
#include "experiments/study/plan/plan.hpp"

namespace polhode::study {

/// "about 3 min 20 s with 2 jobs, of which 5 s for tables and figures; …": the time until the report is written, from
/// the wall times in the folder and from runs that are carried out for less than half a second in all. `done`: ids of
/// the runs in the folder, in ascending order. Writes no file.
std::string time_needed_text(const Experiment& experiment, const Options& options, const Plan& plan,
                             const std::vector<std::filesystem::path>& stores, const std::vector<std::uint64_t>& done);

}  // namespace polhode::study
