// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/results/output.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <variant>

#include "experiments/study/plot/latex_table.hpp"
#include "experiments/study/plot/table.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/aligned.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::results {
namespace {

constexpr std::pair<const char*, Format> formats[] = {
    {"table", Format::table}, {"csv", Format::csv}, {"markdown", Format::markdown}, {"latex", Format::latex}};

std::string rounded_cell(const OptionValue& value) {
  const double* x = std::get_if<double>(&value);
  if (!x) return text_of(value);
  return std::isfinite(*x) ? rounded(*x) : "";
}

}  // namespace

Format format_of(const std::string& name) {
  const auto found =
      std::find_if(std::begin(formats), std::end(formats), [&](const auto& f) { return f.first == name; });
  if (found == std::end(formats)) throw std::logic_error("there is no format " + name);
  return found->second;
}

void add_csv_row(std::string& text, const std::vector<OptionValue>& row) {
  CsvRow cells(text);
  for (const OptionValue& value : row) {
    if (const double* x = std::get_if<double>(&value)) cells.add(*x);
    else cells.add(text_of(value));
  }
  cells.end();
}

Output::Output(Format format, const std::string& file, std::vector<std::string> names)
    : format_(format), names_(std::move(names)), is_text_(names_.size()) {
  if (!file.empty()) file_.emplace(file);
  if (format_ == Format::csv) write(csv_row(names_));
}

void Output::write(const std::string& text) {
  if (file_) file_->add(text);
  else std::fwrite(text.data(), 1, text.size(), stdout);
}

void Output::add(const std::vector<OptionValue>& row) {
  if (format_ == Format::csv) {
    std::string text;
    add_csv_row(text, row);
    return add_csv_rows(text, 1);
  }
  ++count_;
  std::vector<std::string>& cells = rows_.emplace_back();
  cells.reserve(row.size());
  for (std::size_t k = 0; k < row.size(); ++k) {
    cells.push_back(rounded_cell(row[k]));
    if (std::holds_alternative<std::string>(row[k])) is_text_[k] = true;
  }
}

void Output::add_csv_rows(const std::string& text, std::size_t rows) {
  count_ += rows;
  write(text);
}

void Output::finish() {
  if (format_ == Format::table) {
    std::vector<std::vector<std::string>> all = {names_};
    for (auto& row : rows_) {
      for (std::string& cell : row) cell = cell.empty() ? "-" : one_line(cell);
      all.push_back(std::move(row));
    }
    write(aligned(all, is_text_));
  } else if (format_ != Format::csv) {
    Table table;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      const auto kind = is_text_[k] ? plot::Column::Kind::name : plot::Column::Kind::number;
      table.columns.push_back({.header = names_[k], .kind = kind});
    }
    table.rows = std::move(rows_);
    write(format_ == Format::markdown ? markdown(table) : latex_table(table).text);
  }
  if (file_) file_->finish();
}

}  // namespace polhode::study::results
