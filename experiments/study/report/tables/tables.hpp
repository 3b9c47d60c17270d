// SPDX-License-Identifier: BSD-3-Clause
// Writer of the folder tables/ of a study.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

/// Writes tables/: tables in LaTeX, Markdown and CSV, and \newcommand values. Writes the files of the analysis.
void write_tables(const StudyView& study);

}  // namespace polhode::study::report::tables
