// SPDX-License-Identifier: BSD-3-Clause
// A complete study from the command line to the report: called by the main function of every experiment.
#pragma once

#include "experiments/study/plan/experiment.hpp"

namespace polhode::study {

/// Runs the study of an experiment. Returns the exit status: 0 every run has a result, 2 invalid input, 3 some run
/// could not be carried out, 75 interrupted.
int run_experiment(const Experiment& experiment, int argc, const char* const* argv);

}  // namespace polhode::study
