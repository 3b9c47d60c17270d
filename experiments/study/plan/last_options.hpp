// SPDX-License-Identifier: BSD-3-Clause
// The options of the run that was made last. Neighbouring runs of a plan mostly have them all in common, so that they
// are set once and then copied.
#pragma once

#include <utility>
#include <vector>

#include "experiments/study/record/run_options.hpp"

namespace polhode::study::inline plan {

struct LastOptions {
  const void* scenario = nullptr;                                 ///< scenario of a product; null: no run was made yet
  std::vector<std::pair<const RunOption*, OptionValue>> options;  ///< those that the study gives
  RunConfig config;                                               ///< what follows from both, without varied keys
};

}  // namespace polhode::study::plan
