// SPDX-License-Identifier: BSD-3-Clause
// Tables for the terminal.
#pragma once

#include <string>
#include <vector>

namespace polhode::study::inline text {

/// Text of a table with columns of constant width, aligned to the left or to the right. It has at least one row.
std::string aligned(const std::vector<std::vector<std::string>>& table, const std::vector<bool>& left);

}  // namespace polhode::study::text
