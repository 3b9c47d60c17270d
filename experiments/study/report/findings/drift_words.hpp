// SPDX-License-Identifier: BSD-3-Clause
// How drifts grow, and errors along the polhode and off it, in words.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline findings {

/// Class of a run's drift: "linear: p = 1.001, 95 % between 0.998 and 1.004" or "undecided, which some 60 s would
/// decide"; empty if the result has no class.
std::string growth_words(const RunResult& result);

/// Which methods' drifts grow how, of how many it cannot be told, and what duration would.
std::vector<std::string> growth_sentences(const StudyView& study);

/// Whose error is one of phase alone.
std::vector<std::string> polhode_sentences(const StudyView& study);

}  // namespace polhode::study::report
