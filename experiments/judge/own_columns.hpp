// SPDX-License-Identifier: BSD-3-Clause
// The program's own angular momentum and energy beside those of its motion. A free motion is the same with half the
// inertia; these columns are not.
#pragma once

#include <optional>
#include <string>

#include "experiments/judge/row_states.hpp"

namespace polhode::study::judge {

struct ColumnFault {
  std::string name;   ///< the cause, as in scores.csv
  std::string words;  ///< what is wrong, as a clause
  double factor;      ///< how many times better the column agrees if so
};

/// What explains a column that is wrong though the motion is right; empty where nothing has to be or can be explained.
std::optional<ColumnFault> own_column_fault(const RowStates& rows);

}  // namespace polhode::study
