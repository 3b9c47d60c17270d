// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/legible.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/trimmed.hpp"

namespace polhode::study::inline text {
namespace {

constexpr std::string_view blanks = " \t";
constexpr std::size_t first_buffer = 4096;  // bytes; doubled for a longer line until it has 1 MiB

std::string shown(std::string_view text) { return "'" + shortened(text) + "'"; }

}  // namespace

CsvReader::CsvReader(const std::string& path, std::size_t most) : path_(path), most_(most), buffer_(first_buffer) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw InputError(path + " is a folder; name a CSV file in it");
  file_.open(path, std::ios::binary);
  if (!file_) throw InputError(path + ": no such file, or it cannot be read");
  if (!next_line()) throw InputError(path + ": there is nothing in it; it needs a line of column names, then rows");
  split();
  names_ = cells_;
}

std::size_t CsvReader::column(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) {
    const std::vector<std::string_view> given(names_.begin(), names_.end());
    const auto near = nearest(name, given);
    fail_at(1, fmt::format("there is no column {}{}; name it in the first line", name,
                           near.empty() ? "" : "; is it " + shown(near) + "?"));
  }
  const auto place = static_cast<std::size_t>(found - names_.begin());
  const auto twin = std::find(found + 1, names_.end(), name);
  if (twin != names_.end()) {
    fail_at(places_[static_cast<std::size_t>(twin - names_.begin())],
            fmt::format("the column {} stands twice; leave one out", name));
  }
  return place;
}

std::vector<std::size_t> CsvReader::columns(const std::vector<std::string>& names) const {
  std::vector<std::size_t> places;
  for (const std::string& name : names) places.push_back(column(name));
  return places;
}

bool CsvReader::next() {
  if (!next_line()) return false;
  split();
  if (cells_.size() != names_.size()) {
    fail_at(places_.back(), fmt::format("{} cells under {} column names; end the file after a whole row, and put cells "
                                        "with commas into quotes",
                                        cells_.size(), names_.size()));
  }
  return true;
}

/// The next line that holds something.
bool CsvReader::next_line() {
  while (read_line()) {
    ++line_number_;
    if (line_number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.erase(0, 3);
    if (line_.ends_with('\r')) line_.pop_back();
    if (!trimmed(line_).empty() && line_.front() != '#') return true;
  }
  if (file_.bad()) throw InputError(path_ + ": it cannot be read to its end");
  return false;
}

bool CsvReader::read_line() {
  std::size_t count = 0;
  for (;;) {
    file_.getline(buffer_.data() + count, static_cast<std::streamsize>(buffer_.size() - count));
    count += static_cast<std::size_t>(file_.gcount());
    if (count == 0) return false;
    if (!file_.fail() || buffer_.size() == mebibyte) break;
    buffer_.resize(2 * buffer_.size());  // the line is longer
    file_.clear();
  }
  const std::size_t length = count - (file_.eof() || file_.fail() ? 0 : 1);
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}:{}:1: {}", path_, line_number_ + 1, what));
  };
  if (std::memchr(buffer_.data(), 0, length)) refuse("a zero byte, so it is no text file; name one in UTF-8");
  if (file_.fail()) refuse("a line of more than 1 MiB; give one line to each row");
  bytes_ += count;
  if (bytes_ > most_) refuse(fmt::format("the file is larger than {}; divide it", in_units(most_)));
  line_.assign(buffer_.data(), length);
  return true;
}

void CsvReader::split() {
  std::size_t count = 0;
  for (std::size_t at = 0;; ++count) {
    if (count == cells_.size()) cells_.emplace_back(), places_.push_back(0);
    std::string& cell = cells_[count];
    std::size_t first = std::min(line_.find_first_not_of(blanks, at), line_.size());
    places_[count] = std::min(first, line_.size()) + 1;
    if (first < line_.size() && line_[first] == '"') {
      cell.clear();
      std::size_t k = first + 1;
      for (;; ++k) {
        if (k >= line_.size()) fail_at(first + 1, "a quote is opened and never closed; close it on the same line");
        if (line_[k] == '"' && k + 1 < line_.size() && line_[k + 1] == '"') ++k;
        else if (line_[k] == '"') break;
        cell += line_[k];
      }
      at = std::min(line_.find_first_not_of(blanks, k + 1), line_.size());
      if (at < line_.size() && line_[at] != ',')
        fail_at(at + 1, "text behind a closed quote; double the quotes within");
    } else {
      const std::size_t end = std::min(line_.find(',', at), line_.size());
      cell.assign(trimmed(std::string_view(line_).substr(at, end - at)));
      if (cell.empty()) places_[count] = at + 1;
      at = end;
    }
    if (at == line_.size()) break;
    ++at;
  }
  cells_.resize(count + 1);
  places_.resize(count + 1);
}

std::int64_t CsvReader::integer(std::size_t column) const {
  const std::string& text = cells_[column];
  std::int64_t x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) {
    fail(column, name_and(column) + ", which is not a whole number");
  }
  return x;
}

double CsvReader::number(std::size_t column) const {
  std::string_view text = cells_[column];
  if (text.starts_with('+')) text.remove_prefix(1);
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error == std::errc::result_out_of_range) fail(column, name_and(column) + ", beyond what a double can hold");
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || text.starts_with('+')) {
    fail(column, name_and(column) + ", which is not a number");
  }
  if (std::isnan(x)) fail(column, name_and(column) + "; cut the file before the motion is lost");
  return x;
}

std::string CsvReader::name_and(std::size_t column) const {
  return names_[column] + (cells_[column].empty() ? " is empty" : " is " + shown(cells_[column]));
}

std::string CsvReader::place(std::size_t column) const {
  return fmt::format("{}:{}:{}", path_, line_number_, places_[column]);
}

void CsvReader::fail(std::size_t column, const std::string& what) const { fail_at(places_[column], what); }

void CsvReader::fail_at(std::size_t character, const std::string& what) const {
  throw InputError(fmt::format("{}:{}:{}: {}", path_, line_number_, character, what));
}

}  // namespace polhode::study::text
