// SPDX-License-Identifier: BSD-3-Clause
// Table with one row for each run: first the options in which the runs differ, then their results.
#pragma once

#include <cstddef>
#include <span>

#include "experiments/study/plot/table.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

enum class Extent {
  summary,  ///< columns that fit the width of a printed page
  all       ///< all columns
};

/// A row for each of the runs with the indices `shown`. Options with the same value in all runs, and numbers that no
/// run has, have no column.
Table run_table(const StudyView& study, Extent extent, std::span<const std::size_t> shown);

}  // namespace polhode::study::report::tables
