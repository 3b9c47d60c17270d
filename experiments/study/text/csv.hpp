// SPDX-License-Identifier: BSD-3-Clause
// Writes rows of CSV files (RFC 4180).
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline text {

/// One row with its line break. Cells with a comma, a quote or a line break are quoted.
std::string csv_row(const std::vector<std::string>& cells);

/// A number with all its digits; empty if it is absent or not finite.
inline std::string csv_cell(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? exact(*x) : std::string();
}

}  // namespace polhode::study::text
