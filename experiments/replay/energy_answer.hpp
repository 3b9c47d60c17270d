// SPDX-License-Identifier: BSD-3-Clause
// What the runs of a page tell about the energy, for runs that are no study.
#pragma once

#include <string>
#include <vector>

#include "experiments/replay/recording.hpp"

namespace polhode::study::replay {

/// Sentences: the run with the least energy drift and that with the most, and what would tell more.
std::vector<std::string> energy_answer(const std::vector<Recording>& recordings);

}  // namespace polhode::study::replay
