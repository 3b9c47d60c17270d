// SPDX-License-Identifier: BSD-3-Clause
// A study, or several as one, as its stores have it: what figures are made from, without the program that made it.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline query {

struct StoredStudyView {
  StudyView view;
  std::vector<std::string> remarks;  ///< reasons for what was left out
};

/// The runs of all stores that satisfy the conditions (select()), each once, in the order of runs.csv. Refused runs are
/// in no store. The analysis of the experiment is not made. Throws InputError for a condition that cannot be read, if
/// no run is left, and if there are more than most_table_rows.
StoredStudyView stored_study(const ResultStores& stores, const std::vector<std::string>& where);

}  // namespace polhode::study::query
