// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/assignments.hpp"

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/trimmed.hpp"

namespace polhode::study::inline plan {

std::vector<std::string> split_outside_brackets(std::string_view text, char separator) {
  std::vector<std::string> items(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(' || c == '[' || c == '{') {
      ++depth;
    } else if (c == ')' || c == ']' || c == '}') {
      --depth;
    } else if (c == separator && depth == 0) {
      items.emplace_back();
      continue;
    }
    items.back() += c;
  }
  for (std::string& item : items) item = trimmed(item);
  return items;
}

std::vector<std::pair<std::string, std::string>> assignments(std::string_view text, const std::string& label) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const std::string& item : split_outside_brackets(text, ' ')) {
    if (item.empty()) continue;
    const auto equals = item.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == item.size()) {
      throw InputError(label + ": '" + item +
                       "' is not KEY=VALUES; write the pairs with blanks between them only, as in " +
                       "'dt=1e-3,1e-2 t-end=10,100'");
    }
    all.emplace_back(item.substr(0, equals), item.substr(equals + 1));
  }
  if (all.empty()) throw InputError(label + ": there is nothing in it; it takes KEY=VALUES");
  return all;
}

}  // namespace polhode::study::plan
