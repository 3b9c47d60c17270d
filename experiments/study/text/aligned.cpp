// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/aligned.hpp"

#include <algorithm>
#include <cstddef>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline text {

std::string aligned(const std::vector<std::vector<std::string>>& table, const std::vector<bool>& left) {
  std::vector<std::size_t> width(table[0].size());
  for (const auto& row : table) {
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], length(row[k]));
  }
  std::string text;
  for (const auto& row : table) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string blanks(width[k] - length(row[k]), ' ');
      text += (left[k] ? row[k] + blanks : blanks + row[k]) + "  ";
    }
    while (text.ends_with(' ')) text.pop_back();
    text += '\n';
  }
  return text;
}

}  // namespace polhode::study::text
