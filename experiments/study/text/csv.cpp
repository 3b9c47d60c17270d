// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/csv.hpp"

#include <algorithm>
#include <charconv>

namespace polhode::study::inline text {
namespace {

template <class Number>
void append(std::string& text, Number number) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

}  // namespace

void CsvRow::separate() {
  if (!first_) text_ += ',';
  first_ = false;
}

void CsvRow::add(std::string_view cell) {
  separate();
  const auto is_special = [](char c) { return c == ',' || c == '"' || c == '\n' || c == '\r'; };
  if (std::none_of(cell.begin(), cell.end(), is_special)) {
    text_ += cell;
    return;
  }
  text_ += '"';
  for (const char c : cell) {
    if (c == '"') text_ += '"';
    text_ += c;
  }
  text_ += '"';
}

void CsvRow::add(std::int64_t number) {
  separate();
  append(text_, number);
}

void CsvRow::add(double number) {
  separate();
  if (std::isfinite(number)) append(text_, number);
}

void CsvRow::add(const std::optional<double>& number) {
  if (number) add(*number);
  else separate();
}

std::string csv_row(const std::vector<std::string>& cells) {
  std::string text;
  CsvRow row(text);
  for (const std::string& cell : cells) row.add(cell);
  row.end();
  return text;
}

}  // namespace polhode::study::text
