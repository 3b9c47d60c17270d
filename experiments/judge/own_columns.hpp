// SPDX-License-Identifier: BSD-3-Clause
// Comparison of the angular momentum and energy columns of a trajectory with those of its motion. They reveal a wrong
// inertia even in a free motion, which does not depend on a factor of the inertia.
#pragma once

#include <optional>
#include <string>

#include "experiments/judge/row_states.hpp"

namespace polhode::study::judge {

struct ColumnFault {
  std::string name;   ///< name of the cause in scores.csv
  std::string words;  ///< description of the fault, as a clause
  double factor;      ///< disagreement of the column without this cause over that with it
};

/// The fault that explains a wrong column of a right motion; absent if no column is wrong or no fault explains it.
std::optional<ColumnFault> own_column_fault(const RowStates& rows);

}  // namespace polhode::study::judge
