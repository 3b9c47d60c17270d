// SPDX-License-Identifier: BSD-3-Clause
// The answer about the energy on a page whose runs are no study.
#pragma once

#include <string>
#include <vector>

#include "experiments/replay/recording.hpp"

namespace polhode::study::replay {

/// Sentences: the runs with the least and the most energy drift, the runs that did not come to the end, and the study
/// that gives distances from the exact motion.
std::vector<std::string> energy_answer(const std::vector<Recording>& recordings);

}  // namespace polhode::study::replay
