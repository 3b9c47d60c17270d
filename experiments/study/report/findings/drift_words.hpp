// SPDX-License-Identifier: BSD-3-Clause
// Sentences about the growth of energy drifts, and about errors along the polhode and off it.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline findings {

/// Class of a run's drift: "linear: p = 1.001, 95 % between 0.998 and 1.004" or "undecided, which some 60 s would
/// decide"; empty if the result has no class.
std::string growth_words(const RunResult& result);

/// Sentences about the growth of the methods' drifts: classes with their methods, number of undecided runs, and the
/// duration that would decide.
std::vector<std::string> growth_sentences(const StudyView& study);

/// Sentences about methods whose error is an error of phase alone.
std::vector<std::string> polhode_sentences(const StudyView& study);

}  // namespace polhode::study::report::findings
