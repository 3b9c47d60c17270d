// SPDX-License-Identifier: BSD-3-Clause
// What ends a study on the terminal.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

std::string summary_table(const StudyView& study);

/// A run that did not come to its end.
struct Unfinished {
  std::string status;   ///< "refused" or "failed"
  std::string message;  ///< why
};
/// "2 runs refused: …", each reason once and in a line of its own; empty where there is none.
std::string reasons(const std::vector<Unfinished>& runs);

}  // namespace polhode::study
