// SPDX-License-Identifier: BSD-3-Clause
// Choice and order of stored runs. Conditions and sort keys are read without the checksums of rows; what is shown is
// read again, and checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "experiments/study/plan/where.hpp"
#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/query/run_columns.hpp"
#include "experiments/study/store/run_rows.hpp"

namespace polhode::study::inline query {

/// A run that was chosen. Nothing of it has been checked.
struct Hit {
  std::uint32_t store;   ///< index in ResultStores::all()
  std::uint32_t varied;  ///< index in SelectedRuns::varied
  std::int64_t number, id, configuration;
};

struct SortKey {
  RunColumn column;
  bool descending = false;
};

struct SelectedRuns {
  std::vector<Hit> hits;
  std::vector<std::string> varied;       ///< texts of `runs.varied`, each once
  std::vector<std::string> varied_keys;  ///< sorted
  std::size_t runs = 0;                  ///< hits, the same run in several stores counted once
};

enum class Order {
  sorted,
  stored,  ///< the order in the stores, which is read fastest
};

/// The runs that satisfy all conditions, sorted by `sort`, runs without a value last; of equals those come first that
/// come first in runs.csv, folder by folder. The same run in several stores of a study stands there once for each, next
/// to each other. Throws InputError for a condition that compares a number with a text.
SelectedRuns select(const ResultStores& stores, const RunColumns& columns, std::span<const Where> conditions,
                    std::span<const SortKey> sort, Order order = Order::sorted);

/// A checked row.
struct CheckedRow {
  RunPlace place;
  std::span<const Value> values;  ///< values in the order of RunRows::columns(), valid until the next row
};

/// Runs that were left out, because they are damaged.
struct Damage {
  std::size_t runs = 0;
  std::string first;  ///< "run 0123456789abcdef of FILE: runs.checksum", "row 7 of FILE: runs.id"

  void add(const Damage& more) {
    if (runs == 0) first = more.first;
    runs += more.runs;
  }
};

/// Reads chosen runs.
class RunReader {
 public:
  /// With connections of its own a reader may be used beside others, on another thread.
  enum class Connections { of_stores, own };
  /// `stores` must outlive this object.
  explicit RunReader(const ResultStores& stores, Connections connections = Connections::of_stores);

  /// Calls use(row) for each run that is not damaged, in the order of the hits, until it returns false. A run that
  /// stands in several stores of a study comes once.
  Damage read(const SelectedRuns& selection, const std::function<bool(const CheckedRow&)>& use);
  /// The same for the hits of a part, from the index `first` to that before `end`.
  Damage read(const SelectedRuns& selection, std::size_t first, std::size_t end,
              const std::function<bool(const CheckedRow&)>& use);
  /// The indices at which parts of at least `length` hits begin, and the number of all hits. No run stands in two
  /// parts.
  std::vector<std::size_t> parts(const SelectedRuns& selection, std::size_t length) const;

 private:
  bool are_one_run(const Hit& a, const Hit& b) const;
  RunRows& rows_of(std::size_t store);

  const ResultStores* stores_;
  Connections connections_;
  std::vector<std::unique_ptr<Store>> own_;     // opened when they are read first
  std::vector<std::unique_ptr<RunRows>> rows_;  // likewise
};

/// Order of values: numbers, then texts; std::monostate last. Negative, 0 or positive.
int compare(const OptionValue& a, const OptionValue& b);

}  // namespace polhode::study::query
