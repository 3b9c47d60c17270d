// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/cells_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/plan/most_runs.hpp"
#include "experiments/study/plan/study_axes.hpp"
#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::inline plan {

std::shared_ptr<const CellsFile> CellsFile::read(const std::string& path) {
  auto cells = std::make_shared<CellsFile>();
  cells->path_ = path;
  CsvReader reader(path);
  std::vector<const RunOption*> options;
  for (std::size_t i = 0; i < reader.names().size(); ++i) {
    const std::string& name = reader.names()[i];
    if (name.empty()) reader.fail(i, "a column without a name; name an option or a key of the scenario");
    cells->labels_.push_back(reader.place(i) + ": " + name);
    cells->keys_.push_back(axis_key(name, cells->labels_.back()));
    const auto twin = std::find(cells->keys_.begin(), cells->keys_.end() - 1, cells->keys_.back());
    if (twin != cells->keys_.end() - 1) reader.fail(i, "the column " + name + " stands twice; leave one out");
    options.push_back(is_option(cells->keys_.back()) ? &run_option(cells->keys_.back()) : nullptr);
  }
  while (reader.next()) {
    for (std::size_t i = 0; i < options.size(); ++i) {
      const std::string& text = reader.text(i);
      if (options[i] && !text.empty()) {
        if (option_values(*options[i], text, reader.place(i) + ": " + cells->keys_[i]).size() != 1)
          reader.fail(i, cells->keys_[i] + " has several values; give one in each row");
      } else if (options[i] &&
                 (options[i]->role == RunOption::Role::scenario || options[i]->role == RunOption::Role::method)) {
        reader.fail(i, cells->keys_[i] + " is empty; name one in each row");
      }
      cells->texts_ += text;
      cells->ends_.push_back(cells->texts_.size());
    }
    cells->lines_.push_back(static_cast<std::uint32_t>(reader.line()));
    if (cells->lines_.size() > most_runs) reader.fail(0, "more than 10 million rows; divide the file");
  }
  if (cells->lines_.empty()) throw InputError(path + ": there is no row below the column names; give at least one");
  return cells;
}

std::size_t CellsFile::column(std::string_view key) const {
  return static_cast<std::size_t>(std::find(keys_.begin(), keys_.end(), key) - keys_.begin());
}

std::string_view CellsFile::text(std::size_t row, std::size_t column) const {
  const std::size_t cell = row * keys_.size() + column, first = cell == 0 ? 0 : ends_[cell - 1];
  return std::string_view(texts_).substr(first, ends_[cell] - first);
}

std::string CellsFile::place(std::size_t row, std::size_t column) const {
  return fmt::format("{}:{}: {}", path_, lines_[row], keys_[column]);
}

}  // namespace polhode::study::plan
