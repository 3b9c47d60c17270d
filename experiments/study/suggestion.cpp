// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/suggestion.hpp"

#include <algorithm>

namespace polhode::study {

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  // Three rows of the table: distances of the first i − 2, i − 1 and i letters of a to each prefix of b.
  std::vector<int> before(n + 1), above(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) above[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[n];
}

std::string_view nearest(std::string_view name, const std::vector<std::string_view>& known) {
  std::string_view best;
  const int length = static_cast<int>(name.size());
  int least = std::min(length / 4 + 2, length);  // one more than is near
  for (const std::string_view candidate : known) {
    const int distance = edit_distance(name.substr(0, 100), candidate);
    if (distance >= least) continue;
    least = distance;
    best = candidate;
  }
  return best;
}

std::string suggestion(std::string_view name, std::string_view introduction,
                       const std::vector<std::string_view>& known) {
  std::string text = "; ";
  if (const std::string_view near = nearest(name, known); !near.empty()) {
    text.append("did you mean '").append(near).append("'? ");
  }
  text.append(introduction).append(": ");
  for (std::size_t i = 0; i < known.size(); ++i) text.append(i == 0 ? "" : ", ").append(known[i]);
  return text;
}

}  // namespace polhode::study
