// SPDX-License-Identifier: BSD-3-Clause
// Rows of runs as plain values, for programs that read some columns of very many runs. Store::find and Store::for_each
// make results of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/store/database.hpp"
#include "experiments/study/store/result_tables.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/store/value.hpp"

namespace polhode::study::inline store {

/// Reads rows of `runs`, each with its row of `timings`. Every function throws std::runtime_error as Store does.
class RunRows {
 public:
  /// `store` must outlive this object.
  explicit RunRows(const Store& store);

  /// Columns of `runs` in the order of their names, then wall_s; without number, id and checksum.
  const std::vector<std::string>& columns() const { return columns_; }
  std::optional<std::size_t> find(std::string_view column) const;  ///< its index in columns()
  std::int64_t count() const;                                      ///< number of all rows, damaged ones too
  std::int64_t last() const;                                       ///< largest number of a row; 0 if there is none

  /// Columns of a row whose checksum is not checked; the values are valid until the next row.
  struct Part {
    std::int64_t number;
    std::int64_t id;                ///< RunKey::id
    std::span<const Value> values;  ///< values of the chosen columns
  };
  /// Calls use(part) for each row, in the order of numbers. `chosen`: indices in columns().
  void scan(std::span<const std::size_t> chosen, const std::function<void(const Part&)>& use) const;
  /// The same for the rows whose numbers are above `after` and at most `last`.
  void scan(std::span<const std::size_t> chosen, std::int64_t after, std::int64_t last,
            const std::function<void(const Part&)>& use) const;

  /// A row whose checksum was checked.
  struct Row {
    RunKey run;
    std::span<const Value> values;  ///< values in the order of columns(); valid until the next row
    std::string_view damage;        ///< "runs.id", "runs.checksum", "timings.checksum"; empty: none
  };
  void for_each(const std::function<void(const Row&)>& use) const;  ///< calls use(row) in the order of numbers
  /// The same for the rows whose numbers are above `after` and at most `last`.
  void for_each(std::int64_t after, std::int64_t last, const std::function<void(const Row&)>& use) const;
  /// The row with this number, valid until the next call. Throws if there is none any more.
  Row at(std::int64_t number);

 private:
  Row read(const Statement& row, std::vector<Value>& values) const;
  std::string selection(const std::string& condition) const;

  const Database* db_;
  ResultTable runs_, timings_;
  std::vector<std::string> columns_;
  std::optional<Statement> by_number_;
  std::vector<Value> values_;
};

}  // namespace polhode::study::store
