// SPDX-License-Identifier: BSD-3-Clause
// Summary of a study, printed last on the terminal.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

std::string summary_table(const StudyView& study);

/// A run that was not completed.
struct Unfinished {
  std::string status;   ///< "refused" or "failed"
  std::string message;  ///< reason
};
/// Reasons for which runs were not completed: "2 runs refused: …", one line for each reason; empty if there are none.
std::string reasons(const std::vector<Unfinished>& runs);

}  // namespace polhode::study::report::tables
