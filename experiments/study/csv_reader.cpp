// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/csv_reader.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>

#include "experiments/study/input_error.hpp"
#include "experiments/study/report/read_file.hpp"

namespace polhode::study {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

CsvReader::CsvReader(const std::string& path) : path_(path) {
  auto content = std::filesystem::is_directory(path) ? std::nullopt : report::read_file(path);
  if (!content) throw InputError(path + ": the file cannot be read");
  content_ = std::move(*content);
  if (content_.starts_with("\xef\xbb\xbf")) offset_ = 3;
  if (!next_line()) throw InputError(path + ": it is empty; its first line must be a header");
  split();
  for (const Cell& cell : cells_) header_.push_back(cell.text);
}

bool CsvReader::next_line() {
  while (offset_ < content_.size()) {
    const std::size_t end = std::min(content_.find('\n', offset_), content_.size());
    line_ = std::string_view(content_).substr(offset_, end - offset_);
    offset_ = end + 1;
    ++line_number_;
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    if (!line_.empty() && line_.front() != '#') return true;
  }
  return false;
}

void CsvReader::split() {
  cells_.clear();
  std::size_t at = 0;
  for (;;) {
    const std::size_t start = at;
    std::string text;
    if (at < line_.size() && line_[at] == '"') {
      for (++at;; ++at) {
        if (at >= line_.size()) fail_at(start + 1, "a quote that is opened here is not closed");
        if (line_[at] != '"') text += line_[at];
        else if (at + 1 < line_.size() && line_[at + 1] == '"') text += line_[at++];
        else break;
      }
      ++at;
      if (at < line_.size() && line_[at] != ',') fail_at(at + 1, "a comma must follow the closing quote");
    } else {
      at = std::min(line_.find(',', start), line_.size());
      text = trimmed(line_.substr(start, at - start));
    }
    cells_.push_back({std::move(text), start + 1});
    if (at >= line_.size()) return;
    ++at;
  }
}

std::optional<std::size_t> CsvReader::column(std::string_view name) const {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < header_.size(); ++k) {
    if (header_[k] != name) continue;
    if (found) throw InputError(path_ + ": the header has '" + std::string(name) + "' twice");
    found = k;
  }
  return found;
}

bool CsvReader::next() {
  if (!next_line()) return false;
  split();
  if (cells_.size() != header_.size()) {
    const std::size_t at = cells_.size() > header_.size() ? cells_[header_.size()].at : line_.size() + 1;
    fail_at(at, "the header has " + std::to_string(header_.size()) + " columns and this line " + std::to_string(cells_.size()));
  }
  return true;
}

double CsvReader::number(std::size_t column) const {
  const std::string& word = cells_[column].text;
  const std::size_t sign = word.starts_with('+') && !word.starts_with("+-") ? 1 : 0;
  double value = 0;
  const auto [end, error] = std::from_chars(word.data() + sign, word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) fail(column, "'" + word + "' is out of the range of a double");
  if (error != std::errc() || end != word.data() + word.size()) fail(column, "'" + word + "' is not a number");
  if (!std::isfinite(value)) fail(column, "'" + word + "' is not finite");
  return value;
}

std::uint64_t CsvReader::count(std::size_t column) const {
  const std::string& word = cells_[column].text;
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) fail(column, "'" + word + "' is not a whole number from 0 on");
  return value;
}

void CsvReader::fail(std::size_t column, const std::string& why) const {
  fail_at(cells_[column].at, header_[column] + ": " + why);
}

void CsvReader::fail_at(std::size_t character, const std::string& why) const {
  throw InputError(path_ + ":" + std::to_string(line_number_) + ":" + std::to_string(character) + ": " + why);
}

}  // namespace polhode::study
