// SPDX-License-Identifier: BSD-3-Clause
// The tables of the store that hold results, one row for each run: `runs` with one column for each metric, `curves`
// with curves against time, `timings` with wall times, which differ from call to call.
//
// Each has the column `number`, which joins the rows of a run, the columns below, and `checksum` (value.hpp) of the run
// id and of these columns in the order of their names. `runs` has the column `id` too: the 16 hexadecimal digits of the
// run id as a 64-bit integer with sign. Numbers grow in the order in which runs are stored, so that rows are appended;
// ids are hashes, and rows in their order would be written all over the file. Columns are found by name: their order in
// the file has no meaning.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/store/database.hpp"
#include "experiments/study/store/value.hpp"

namespace polhode::study::inline store {

struct ResultColumn {
  std::string name;
  std::string_view type;  ///< declared type in SQL
  /// Gives the value to store. Returns false if put() would refuse it. `text` is room for a text that the record does
  /// not hold; it must outlive the value. One thread at a time may call it.
  std::function<bool(const RunRecord&, std::string& text, Value& stored)> value;
  /// Puts a stored value into a result. Returns false if no study writes such a value.
  std::function<bool(const Value&, RunResult&)> put;
  bool may_be_absent = false;  ///< NULL stands for no number, as a new result has none; then put() need not be called
};

struct ResultTable {
  std::string name;
  std::vector<ResultColumn> columns;  ///< columns in the order of their names, without `number`, `id` and `checksum`
  bool has_id = false;                ///< true for `runs`

  /// Place of the column in `columns`. Throws std::logic_error if there is none.
  std::size_t find(std::string_view column) const;
  std::string definition() const;  ///< CREATE TABLE …
  /// INSERT OR `else_do` …, with parameters for `number`, `id` if there is one, the columns and `checksum`.
  std::string insertion(std::string_view else_do) const;
  /// Throws OtherTables (table_form.hpp) if the database has no such table.
  void check(const Database& db) const;
};

/// Name of the column of `runs` that holds the key of the run's configuration (configurations.hpp).
constexpr std::string_view configuration_column = "configuration";
/// Name of the column of `runs` that is 1 for a run with a row in `curves`, and 0 for others.
constexpr std::string_view has_curves = "has_curves";

/// Name of the column of `runs` that holds varied_text() (configurations.hpp).
constexpr std::string_view varied_column = "varied";

ResultTable runs_table(std::span<const Metric> metrics);
ResultTable curves_table();
ResultTable timings_table();

/// Identity of a row of `runs`.
struct RunKey {
  std::int64_t id;  ///< run id; the number of the row if it is damaged so that it has none
  std::int64_t number;
  bool has_id;

  /// `id` and `number`: columns of the SELECT.
  static RunKey of(const Statement& row, int id, int number);
  std::string name() const;  ///< "run 0123456789abcdef"; "row 7" without an id
};
/// The damage of a row without an id.
constexpr std::string_view id_damage = "runs.id";

/// The parameters of insertion() for one record.
class RowWriter {
 public:
  explicit RowWriter(const ResultTable& table);  ///< `table` must outlive the writer
  /// The values, valid until the next call and as long as the record. Throws std::logic_error if a value is none that
  /// may be read back.
  std::span<const Value> values(std::int64_t number, std::int64_t id, const RunRecord& record);
  std::int64_t integer(std::size_t column) const;  ///< value of a column in the row that was made last

 private:
  const ResultTable* table_;
  std::vector<std::string> texts_;
  std::vector<Value> values_;
};

/// Reads the columns of a table from the rows of a SELECT.
class RowReader {
 public:
  /// `first`: number of the column of the SELECT that holds the first of selection(). `table` must outlive the reader.
  RowReader(const ResultTable& table, int first);
  static std::string selection(const ResultTable& table);  ///< "runs.…, runs.checksum"
  int size() const { return static_cast<int>(table_->columns.size()) + 1; }

  /// Puts the values of the run with this id into a new result. Returns the name of the first damaged column,
  /// "runs.status"; empty if there is none. A row that a join did not find is damaged.
  std::string read(const Statement& row, std::int64_t id, RunResult& result);
  const Value& value(std::size_t column) const { return values_[column]; }  ///< value in the row that was read last

 private:
  const ResultTable* table_;
  int first_;
  std::vector<Value> values_;
};

}  // namespace polhode::study::store
