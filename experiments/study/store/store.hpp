// SPDX-License-Identifier: BSD-3-Clause
// The store of a study: results.sqlite, in WAL mode, so that a study that is killed keeps every committed run.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>

#include "experiments/study/record/run_record.hpp"

struct sqlite3;

namespace polhode::study {

/// Every function throws std::runtime_error with SQLite's reason, naming the file (disk full, locked, damaged).
class Store {
 public:
  /// Opens the store in the folder, or makes it.
  explicit Store(const std::filesystem::path& folder);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  struct Loaded {
    std::map<std::string, RunResult> runs;       ///< by run id
    std::map<std::string, std::string> damaged;  ///< the runs that are not among them, and the column that is no result
  };
  Loaded load() const;
  void keep(std::span<const RunRecord> records);  ///< in one transaction
  void forget(const std::string& id);

  /// The ids in a folder's store, empty if there is none; changes nothing. Throws too where another program has made
  /// tables of these names, and where the database is damaged anywhere.
  static std::set<std::string> ids_in(const std::filesystem::path& folder);

  /// Bytes, of the absolute path of a folder whose store SQLite opens.
  static std::size_t longest_folder();

  static constexpr const char* file_name = "results.sqlite";

 private:
  void execute(const std::string& sql) const;

  std::filesystem::path path_;
  struct Close {
    void operator()(sqlite3*) const;
  };
  std::unique_ptr<sqlite3, Close> db_;
};

}  // namespace polhode::study
