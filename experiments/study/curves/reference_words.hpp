// SPDX-License-Identifier: BSD-3-Clause
// What is said of the references (--reference) that stood for unknown exact solutions.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline curves {

/// True if a reference was used for this run, proven or not.
bool used_reference(const RunRecord& run);

/// How certain the references are, by scenario, and how many errors they could not judge. Empty: none was used.
std::vector<std::string> reference_sentences(const StudyView& study);

}  // namespace polhode::study::report
