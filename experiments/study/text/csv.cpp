// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/csv.hpp"

namespace polhode::study::inline text {

std::string csv_row(const std::vector<std::string>& cells) {
  std::string row;
  bool first = true;
  for (const std::string& cell : cells) {
    if (!first) row += ',';
    first = false;
    if (cell.find_first_of(",\"\n\r") == std::string::npos) {
      row += cell;
      continue;
    }
    row += '"';
    for (const char c : cell) row += c == '"' ? std::string("\"\"") : std::string(1, c);
    row += '"';
  }
  return row + '\n';
}

}  // namespace polhode::study::text
