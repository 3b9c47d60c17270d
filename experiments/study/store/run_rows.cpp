// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/run_rows.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "experiments/study/record/metric_table.hpp"

namespace polhode::study::inline store {

RunRows::RunRows(const Store& store)
    : db_(&store.database()), runs_(runs_table(metric_table())), timings_(timings_table()) {
  for (const ResultTable* table : {&runs_, &timings_}) {
    for (const ResultColumn& column : table->columns) columns_.push_back(column.name);
  }
}

std::optional<std::size_t> RunRows::find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::int64_t RunRows::count() const { return db_->number("SELECT count(*) FROM runs"); }
std::int64_t RunRows::last() const { return db_->number("SELECT coalesce(max(number), 0) FROM runs"); }

void RunRows::scan(std::span<const std::size_t> chosen, const std::function<void(const Part&)>& use) const {
  constexpr std::int64_t above_none = std::numeric_limits<std::int64_t>::min();
  scan(chosen, above_none, std::numeric_limits<std::int64_t>::max(), use);
}

void RunRows::scan(std::span<const std::size_t> chosen, std::int64_t after, std::int64_t last,
                   const std::function<void(const Part&)>& use) const {
  std::string names = "runs.number, runs.id", tables = "runs";
  for (const std::size_t column : chosen) {
    const bool timed = column >= runs_.columns.size();
    names += (timed ? ", timings." : ", runs.") + quoted_name(columns_[column]);
    if (timed && tables == "runs") tables += " LEFT JOIN timings ON timings.number = runs.number";
  }
  Statement rows(
      *db_, "SELECT " + names + " FROM " + tables + " WHERE runs.number > ? AND runs.number <= ? ORDER BY runs.number");
  rows.bind(1, after);
  rows.bind(2, last);
  std::vector<Value> values(chosen.size());
  while (rows.step()) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = rows.value(2 + static_cast<int>(k));
    const RunKey run = RunKey::of(rows, 1, 0);
    use({run.number, run.id, values});
  }
}

std::string RunRows::selection(const std::string& condition) const {
  return "SELECT runs.id, runs.number, " + RowReader::selection(runs_) + ", " + RowReader::selection(timings_) +
         " FROM runs LEFT JOIN timings ON timings.number = runs.number" + condition;
}

RunRows::Row RunRows::read(const Statement& row, std::vector<Value>& values) const {
  const RunKey run = RunKey::of(row, 0, 1);
  const std::size_t own = runs_.columns.size();
  values.resize(columns_.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = row.value(static_cast<int>(2 + k + (k < own ? 0 : 1)));
  const auto checksum = [&](std::size_t column) { return row.value(static_cast<int>(column)); };
  std::string_view damage;
  if (!run.has_id) {
    damage = id_damage;
  } else if (!is_integer(checksum(2 + own), checksum_of(run.id, std::span(values).first(own)))) {
    damage = "runs.checksum";
  } else if (!is_integer(checksum(3 + values.size()), checksum_of(run.id, std::span(values).subspan(own)))) {
    damage = "timings.checksum";
  }
  return {run, values, damage};
}

void RunRows::for_each(const std::function<void(const Row&)>& use) const {
  Statement rows(*db_, selection(" ORDER BY runs.number"));
  std::vector<Value> values;
  while (rows.step()) use(read(rows, values));
}

void RunRows::for_each(std::int64_t after, std::int64_t last, const std::function<void(const Row&)>& use) const {
  Statement rows(*db_, selection(" WHERE runs.number > ? AND runs.number <= ? ORDER BY runs.number"));
  rows.bind(1, after);
  rows.bind(2, last);
  std::vector<Value> values;
  while (rows.step()) use(read(rows, values));
}

RunRows::Row RunRows::at(std::int64_t number) {
  if (!by_number_) by_number_.emplace(*db_, selection(" WHERE runs.number = ?"));
  by_number_->reset();
  by_number_->bind(1, number);
  if (!by_number_->step()) throw std::runtime_error(db_->path().string() + ": a run was removed meanwhile");
  return read(*by_number_, values_);
}

}  // namespace polhode::study::store
