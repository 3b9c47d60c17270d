// SPDX-License-Identifier: BSD-3-Clause
// Rows of CSV files (RFC 4180).
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline text {

/// Cells with a comma, a quote or a line break stand in quotes. Ends with a line break.
std::string csv_row(const std::vector<std::string>& cells);

/// All digits; empty where there is no number, or one that is not finite.
inline std::string csv_cell(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? exact(*x) : std::string();
}

}  // namespace polhode::study
