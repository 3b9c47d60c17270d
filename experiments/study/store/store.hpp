// SPDX-License-Identifier: BSD-3-Clause
// Store of a study's results: the database results.sqlite, in which a killed study keeps every committed run. Each row
// has a checksum, which is checked when the row is read. Tables and columns: result_tables.hpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/store/configurations.hpp"
#include "experiments/study/store/database.hpp"
#include "experiments/study/store/file_system.hpp"

namespace polhode::study::inline store {

/// A run as it stands in the store.
struct StoredRun {
  std::string id;           ///< RunKey::id (result_tables.hpp)
  std::int64_t number = 0;  ///< number of its rows
  // Unspecified if the run is damaged.
  std::int64_t configuration = 0;  ///< key in configurations()
  std::string varied;              ///< varied keys, as varied_text() writes them
  RunResult result;
  /// The first invalid column: "runs.id", "runs.status", "curves.series", "runs.checksum"; empty: none.
  std::string damage;

  std::string name() const;  ///< RunKey::name()
};

/// A scenario as it stands in the store.
struct StoredScenario {
  std::string canonical;  ///< Scenario::canonical(), without varied keys
  std::string source;     ///< its TOML text
};

/// A study that ended in the folder of the store.
struct StoredStudy {
  std::string experiment, command, manifest;
};

/// The choice of curves against time to be read too: RunResult::series and attitude_errors.
enum class Curves { without, with };

/// Every function throws std::runtime_error with the file and the reason (disk full, locked, damaged, of another
/// version) in one line.
class Store {
  class Transaction;

 public:
  /// Opens the store in the folder. `metrics` must outlive the store. `journal`: absent for the one that suits the file
  /// system; a store that was in another mode changes to it.
  explicit Store(const std::filesystem::path& folder, std::span<const Metric> metrics = metric_table(),
                 Access access = Access::create, std::optional<Journal> journal = std::nullopt);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// Calls use(run) for each run, in the order in which they were first stored. One row at a time is in memory.
  void for_each(Curves curves, const std::function<void(StoredRun&&)>& use) const;
  /// The run with this id; absent if there is none.
  std::optional<StoredRun> find(const std::string& id, Curves curves) const;
  /// Reads many runs, without curves, in one transaction.
  class Reading {
   public:
    explicit Reading(const Store& store);
    ~Reading();
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;
    /// Reads the result of the run with this id into `result`, a new one. Returns StoredRun::damage; absent if there is
    /// no such run. Runs are read faster in the order in which they were stored.
    std::optional<std::string> find(std::uint64_t id, RunResult& result);

   private:
    const Store& store_;
    std::int64_t number_ = 0;  // number of the row that was read last
    bool in_order_ = false;    // that row follows the one before
  };
  std::vector<std::uint64_t> ids() const;  ///< ids of all runs, damaged ones too if they have one, in ascending order
  std::vector<std::int64_t> rows_without_id() const;  ///< numbers of the rows of `runs` that have no id
  /// Ids of the runs, damaged ones too, that begin with these 1 to 16 hexadecimal digits, in ascending order.
  std::vector<std::string> ids_with(const std::string& beginning) const;

  /// Stores runs in one transaction, part by part. What is not committed is gone with the object.
  class Keeping {
   public:
    explicit Keeping(Store& store);
    ~Keeping();
    Keeping(const Keeping&) = delete;
    Keeping& operator=(const Keeping&) = delete;
    /// Stores the runs; replaces rows of the same id. A run without series and attitude errors is stored without
    /// curves. Throws std::logic_error for a value that could not be read back.
    void add(std::span<const RunRecord> records);
    void commit();  ///< must be called once, after the last add()

   private:
    Store& store_;
    std::unique_ptr<Transaction> transaction_;  // absent once it is committed
  };
  void keep(std::span<const RunRecord> records);       ///< stores the runs in one transaction, as Keeping does
  void forget(std::span<const std::int64_t> numbers);  ///< deletes the rows of the runs with these numbers
  /// Moves what stands in SQLite's log into the file, for which closing the store waits otherwise. Through a connection
  /// of its own, so that another thread may read the store meanwhile.
  void settle() const;

  /// The configurations of the runs, by key (`runs.configuration`). Damaged ones are left out.
  std::map<std::int64_t, Configuration> configurations() const;
  std::unordered_set<std::int64_t> configuration_keys() const;  ///< the keys of these

  /// The scenarios by name, and the studies. Damaged ones are left out.
  std::map<std::string, StoredScenario> scenarios() const;
  std::vector<StoredStudy> studies() const;

  /// Stores the canonical text and the source of each scenario by name, and replaces what is there.
  void keep_scenarios(std::span<const Scenario> scenarios);
  /// Stores what made results: name of the experiment, command line, manifest.json. The same study stands there once.
  void keep_study(const std::string& experiment, const std::string& command, const std::string& manifest);

  /// ids() of the store of a folder, empty if there is no store. Also throws if any part of the database is damaged in
  /// its structure. A file that no writer left half-written stays as it is.
  static std::vector<std::uint64_t> ids_in(const std::filesystem::path& folder,
                                           std::span<const Metric> metrics = metric_table());

  /// True if the folder has a store without tables: its study was stopped before the first run.
  static bool is_unbegun(const std::filesystem::path& folder);

  /// Largest length of the absolute path of a folder, bytes; SQLite does not open a store below a longer path.
  static std::size_t longest_folder();

  static constexpr const char* file_name = "results.sqlite";

  const Database& database() const { return db_; }  ///< the database, for reading

 private:
  struct Tables;
  class Writer;
  class Reader;

  Journal journal_;
  Database db_;
  std::unique_ptr<const Tables> tables_;
  std::unique_ptr<Writer> writer_;                             ///< made by the first Keeping
  mutable std::unique_ptr<Reader> finder_, finder_of_curves_;  ///< made at the first find()
  mutable std::unique_ptr<Reader> from_number_;                ///< made by the first Reading
};

}  // namespace polhode::study::store
