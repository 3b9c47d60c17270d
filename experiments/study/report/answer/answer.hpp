// SPDX-License-Identifier: BSD-3-Clause
// The answer of a study to the question with which its page is opened: which method, at which step, and why? Every
// number is computed from the runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/table.hpp"

namespace polhode::study::inline report::inline answer {

struct Answer {
  std::vector<std::string> sentences;  ///< at most three
  std::vector<std::string> depends;    ///< what the answer depends on
  std::optional<Table> table{};
};

/// The cheapest method for an error: of the attitude, or of the position for a motion without one. Where the runs do
/// not decide, the sentences say so, and which runs would.
Answer answer_of(const StudyView& study, const Grouping& grouping);

}  // namespace polhode::study::report::answer
