// SPDX-License-Identifier: BSD-3-Clause
// A run option that tests add to the table (AddedRunOption).
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/run_options.hpp"

namespace polhode::study {

/// The tidiness of a run, `never` by default. No code uses it.
inline RunOption tidiness() {
  RunOption option{.name = "tidy-up",
                   .values = "never|daily",
                   .help = "when the run tidies up (default: never)",
                   .column = "tidy_up",
                   .on_demand = true,
                   .header = "tidies up",
                   .word = "tidy",
                   .usual = std::string("never")};
  option.known = [] { return std::vector<std::string>{"never", "daily"}; };
  return without_member(option);
}

}  // namespace polhode::study
