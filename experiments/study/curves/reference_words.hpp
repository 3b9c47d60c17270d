// SPDX-License-Identifier: BSD-3-Clause
// Sentences on the references (--reference) used in place of unknown exact solutions.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline curves {

/// True if a reference was used for this run, proven or not.
bool used_reference(const RunRecord& run);

/// The uncertainty of the references, by scenario, and the number of errors that they could not prove. Empty if none
/// was used.
std::vector<std::string> reference_sentences(const StudyView& study);

}  // namespace polhode::study::curves
