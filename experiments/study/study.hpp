// SPDX-License-Identifier: BSD-3-Clause
// A study from the command line to the report: what the main of every experiment calls.
#pragma once

#include "experiments/study/plan/experiment.hpp"

namespace polhode::study {

/// Exit status: 0 every run has its row, 2 bad input, 3 some run could not be carried out, 130 interrupted.
int run_experiment(const Experiment& experiment, int argc, const char* const* argv);

}  // namespace polhode::study
