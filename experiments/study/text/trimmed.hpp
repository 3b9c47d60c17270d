// SPDX-License-Identifier: BSD-3-Clause
// A text without the blanks around it.
#pragma once

#include <string_view>

namespace polhode::study::inline text {

/// The text from its first to its last character that is not one of `blanks`; empty if there is none.
inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t") {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace polhode::study::text
