// SPDX-License-Identifier: BSD-3-Clause
// Compares two results of the same run, digit by digit.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/run_record.hpp"

namespace polhode::study::rerun {

/// A number that is not the same; both values have all digits, and are empty where there is none.
struct Difference {
  std::string name;  ///< metric, t_reached_s, or "series" and "attitude_errors" for the first point that differs
  std::string stored, again;
};

/// All differences but those of wall times, metrics in the order of runs.csv. Curves that are not stored are not
/// compared. Empty: every digit is the same.
std::vector<Difference> differences(const RunResult& stored, const RunResult& again);

}  // namespace polhode::study::rerun
