// SPDX-License-Identifier: BSD-3-Clause
// The answer of a study to the question with which its page is opened: which method, at which step, and why? Every
// number is computed from the runs.
#pragma once

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/record/analysis.hpp"

namespace polhode::study::inline report::inline answer {

/// The cheapest method for an error: of the attitude, or of the position for a motion without one. Where the runs do
/// not decide, the sentences say so, and which runs would.
Answer answer_of(const StudyView& study, const Grouping& grouping);

}  // namespace polhode::study::report::answer
