// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/article/prose.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/study/plot/latex_table.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline article {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Length of the number at the beginning of a text: "1e-3", "0.5", "12"; 0: none.
std::size_t number_length(std::string_view text) {
  std::size_t n = 0;
  const auto digits = [&] {
    const std::size_t from = n;
    while (n < text.size() && is_digit(text[n])) ++n;
    return n > from;
  };
  if (!digits()) return 0;
  if (n + 1 < text.size() && text[n] == '.' && is_digit(text[n + 1])) ++n, digits();
  if (n < text.size() && text[n] == 'e') {
    const std::size_t mantissa = n++;
    if (n < text.size() && (text[n] == '-' || text[n] == '+')) ++n;
    if (!digits()) n = mantissa;
  }
  return n;
}

/// Length of the name at the beginning of a text: "rk4", "body.0.inertia.1", "runs.csv"; 0: none.
std::size_t name_length(std::string_view text) {
  std::size_t n = 0;
  if (text.empty() || !is_letter(text.front())) return 0;
  const auto is_part = [](char c) { return is_letter(c) || is_digit(c); };
  while (n < text.size() && (is_part(text[n]) || (text[n] == '.' && n + 1 < text.size() && is_part(text[n + 1])))) ++n;
  return n;
}

bool is_name(std::string_view word) {
  return std::any_of(word.begin(), word.end(), [](char c) { return is_digit(c) || c == '_'; });
}

/// 0 → "A", 25 → "Z", 26 → "AA".
std::string letters(std::size_t number) {
  std::string out;
  for (++number; number > 0; number = (number - 1) / 26)
    out.insert(out.begin(), static_cast<char>('A' + (number - 1) % 26));
  return out;
}

}  // namespace

std::string Prose::command(std::string_view place) {
  auto found = used_.find(place);
  if (found == used_.end()) found = used_.emplace(place, 0).first;
  return fmt::format("polhode{}{}", place, letters(found->second++));
}

std::string Prose::operator()(std::string_view place, std::string_view sentence) {
  std::string out, plain, lines;
  const auto flush = [&] { out += tex(plain), plain.clear(); };
  for (std::size_t i = 0; i < sentence.size();) {
    const std::string_view rest = sentence.substr(i);
    const bool begins_word = i == 0 || !(is_letter(sentence[i - 1]) || is_digit(sentence[i - 1]));
    if (const std::size_t n = begins_word ? name_length(rest) : 0) {
      if (is_name(rest.substr(0, n)) || names_.contains(rest.substr(0, n))) {
        flush();
        out += fmt::format("\\name{{{}}}", tex_breakable(rest.substr(0, n)));
      } else {
        plain += rest.substr(0, n);
      }
      i += n;
      continue;
    }
    const bool negative = rest.front() == '-' && (i == 0 || sentence[i - 1] == ' ' || sentence[i - 1] == '(');
    if (std::size_t n = number_length(rest.substr(negative ? 1 : 0))) {
      n += negative ? 1 : 0;
      flush();
      const std::string name = command(place), number = tex_number(rest.substr(0, n));
      lines += fmt::format("\\newcommand{{\\{}}}{{\\ensuremath{{{}}}}}\n", name, number.substr(1, number.size() - 2));
      out += fmt::format("\\{}{{}}", name);
      i += n;
      continue;
    }
    plain += sentence[i++];
  }
  flush();
  if (!lines.empty()) definitions_ += fmt::format("\n% {}: {}\n{}", place, one_line(sentence), lines);
  return out;
}

std::string Prose::value(std::string_view name, std::string_view text) {
  definitions_ += fmt::format("\\newcommand{{\\polhode{}}}{{{}}}\n", name, tex_breakable(text));
  return fmt::format("\\polhode{}{{}}", name);
}

}  // namespace polhode::study::report::article
