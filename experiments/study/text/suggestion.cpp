// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/suggestion.hpp"

#include <algorithm>

namespace polhode::study::inline text {

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

namespace {

constexpr std::size_t most_compared = 100;  // letters of a name that are looked at
constexpr std::size_t most_named = 6;

/// Small letters, and one sign between words: RK4 and rk4, lie-midpoint and lie_midpoint are the same.
std::string folded(std::string_view name) {
  std::string text(name.substr(0, most_compared));
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '-' || c == ' ') c = '_';
  }
  return text;
}

/// True if consecutive words of a name are these words: "euler" in "explicit_euler", but not "mas" in "mass".
bool holds_words(const std::string& name, const std::string& words) {
  return !words.empty() && ("_" + name + "_").find("_" + words + "_") != std::string::npos;
}

/// The known names of which the test is true, as they are written.
template <class Test>
std::vector<std::string_view> those(const std::vector<std::string_view>& known, const Test& test) {
  std::vector<std::string_view> found;
  for (const std::string_view candidate : known) {
    if (test(folded(candidate))) found.push_back(candidate);
  }
  return found;
}

/// "'a', 'b' or 'c'"
std::string choice(const std::vector<std::string_view>& names, std::string_view sign) {
  std::string text;
  const std::size_t n = std::min(names.size(), most_named);
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : " or ";
    text.append("'").append(sign).append(names[i]).append("'");
  }
  return names.size() > n ? text + ", …" : text;
}

/// "; did you mean 'rk4'? " or, where no name is near, "; ".
std::string question(std::string_view name, const std::vector<std::string_view>& known) {
  const std::string text = did_you_mean(name, known);
  return text.empty() ? "; " : text + " ";
}

}  // namespace

std::vector<std::string_view> near_names(std::string_view name, const std::vector<std::string_view>& known) {
  const std::string said = folded(name);
  auto found = those(known, [&](const std::string& k) { return k == said; });
  if (found.empty())
    found = those(known, [&](const std::string& k) { return holds_words(k, said) || holds_words(said, k); });
  if (!found.empty()) return found;
  std::vector<std::string> all;
  for (const std::string_view candidate : known) all.push_back(folded(candidate));
  const std::string_view near = nearest(said, {all.begin(), all.end()});
  if (!near.empty()) return those(known, [&](const std::string& k) { return k == near; });
  if (said.size() < 3) return {};
  found = those(known, [&](const std::string& k) { return k.starts_with(said); });
  if (found.empty()) found = those(known, [&](const std::string& k) { return k.find(said) != std::string::npos; });
  return found;
}

std::string suggestion(std::string_view name, std::string_view introduction,
                       const std::vector<std::string_view>& known) {
  std::string text = question(name, known);
  text.append(introduction).append(": ");
  for (std::size_t i = 0; i < known.size(); ++i) text.append(i == 0 ? "" : ", ").append(known[i]);
  return text;
}

std::string suggestion_of_many(std::string_view name, const std::vector<std::string_view>& known,
                               std::string_view list) {
  return question(name, known).append(list).append(" prints all ").append(std::to_string(known.size()));
}

std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& known, std::string_view sign) {
  const auto near = near_names(name, known);
  return near.empty() ? "" : "; did you mean " + choice(near, sign) + "?";
}

}  // namespace polhode::study::text
