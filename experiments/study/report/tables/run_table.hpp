// SPDX-License-Identifier: BSD-3-Clause
// The table with one row for each run: what tells the runs apart, then what came out.
#pragma once

#include <cstddef>

#include "experiments/study/plot/table.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

enum class Extent {
  summary,  ///< what fits the width of a printed page
  all
};

/// In the order of runs.csv, at most so many rows. Options that are the same in all runs have no column, nor have
/// numbers that no run has.
Table run_table(const StudyView& study, Extent extent, std::size_t most_rows);

}  // namespace polhode::study::report
