// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/legible.hpp"

#include <algorithm>

namespace polhode::study::inline text {
namespace {

constexpr std::string_view ellipsis = "...";

unsigned byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

bool continues(std::string_view text, std::size_t i) { return i < text.size() && (byte_at(text, i) & 0xc0) == 0x80; }

/// The bytes of the character at i that a terminal may print as they are; 0: spell the first one out.
std::size_t printable(std::string_view text, std::size_t i) {
  const unsigned first = byte_at(text, i);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 && first < 0xf5 ? 4 : first >= 0xe0 ? 3 : first >= 0xc2 ? 2 : 0;
  if (length == 0 || first >= 0xf5) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if (!continues(text, i + k)) return 0;
  }
  const unsigned second = byte_at(text, i + 1);
  const bool control = first == 0xc2 && second < 0xa0;
  const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool beyond = (first == 0xed && second >= 0xa0) || (first == 0xf4 && second >= 0x90);
  return control || overlong || beyond ? 0 : length;
}

std::string spelled_out(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string line;
  for (std::size_t i = 0; i < text.size();) {
    if (const std::size_t length = printable(text, i)) {
      line.append(text.substr(i, length));
      i += length;
    } else {
      const unsigned byte = byte_at(text, i++);
      line.append("\\x").append(1, digits[byte >> 4]).append(1, digits[byte & 15]);
    }
  }
  return line;
}

/// The first `head` and the last `tail` bytes, never half of a character.
std::string without_middle(std::string_view text, std::size_t head, std::size_t tail) {
  std::size_t last = text.size() - tail;
  while (head > 0 && continues(text, head)) --head;
  while (continues(text, last)) ++last;
  return std::string(text.substr(0, head)).append(ellipsis).append(text.substr(last));
}

}  // namespace

std::string legible(std::string_view message) {
  constexpr std::size_t longest_word = 300, longest_message = 3000;
  const std::string line = spelled_out(message);
  std::string text;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size() - 1) + 1;
    const std::string_view word = std::string_view(line).substr(at, end - at);
    text += word.size() > longest_word ? without_middle(word, 160, 100) : std::string(word);
    at = end;
  }
  return text.size() > longest_message ? without_middle(text, 2000, 900) : text;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t longest = 40;
  if (text.size() <= longest) return spelled_out(text);
  std::size_t end = longest;
  while (end > 0 && continues(text, end)) --end;
  return spelled_out(text.substr(0, end)).append(ellipsis);
}

}  // namespace polhode::study::text
