// SPDX-License-Identifier: BSD-3-Clause
// Store of a study's results: the database results.sqlite in WAL mode, so that a killed study keeps every committed
// run. Its table `runs` has one row for each run and one column for each metric.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_record.hpp"

struct sqlite3;

namespace polhode::study::inline store {

/// Every function throws std::runtime_error with the file and SQLite's reason (disk full, locked, damaged).
class Store {
 public:
  /// Opens the store in the folder, or creates it. `metrics` must outlive the store.
  explicit Store(const std::filesystem::path& folder, std::span<const Metric> metrics = metric_table());
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  struct Loaded {
    std::map<std::string, RunResult> runs;       ///< valid results by run id
    std::map<std::string, std::string> damaged;  ///< invalid rows: run id, and name of the invalid column
  };
  Loaded load() const;
  void keep(std::span<const RunRecord> records);  ///< stores the runs in one transaction; replaces rows of the same id
  void forget(const std::string& id);             ///< deletes the row of a run

  /// The run ids in the store of a folder, empty if there is no store. Read-only. Also throws if the table has other
  /// columns, such as those of another version, or if any part of the database is damaged.
  static std::set<std::string> ids_in(const std::filesystem::path& folder,
                                      std::span<const Metric> metrics = metric_table());

  /// Largest length of the absolute path of a folder, bytes; SQLite does not open a store below a longer path.
  static std::size_t longest_folder();

  static constexpr const char* file_name = "results.sqlite";

 private:
  void execute(const std::string& sql) const;

  std::filesystem::path path_;
  std::span<const Metric> metrics_;
  struct Close {
    void operator()(sqlite3*) const;
  };
  std::unique_ptr<sqlite3, Close> db_;
};

}  // namespace polhode::study::store
