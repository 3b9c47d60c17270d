// SPDX-License-Identifier: BSD-3-Clause
// An open SQLite database and its prepared statements. Every function throws std::runtime_error with the file and
// SQLite's reason (locked, damaged) in one line, and DiskFull where the disk is full.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/study/store/file_system.hpp"
#include "experiments/study/store/value.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace polhode::study::inline store {

/// There is no room for what is to be written. The database itself is sound.
struct DiskFull : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Access {
  /// If all of the content is in the file itself, nothing is changed in the folder; else as `write`, since a writer is
  /// at work or was killed.
  look,
  read,    ///< the file is not changed; with write-ahead logging another program may write meanwhile
  write,   ///< the file must exist
  create,  ///< the file is created if it does not exist
};

class Database {
 public:
  Database(std::filesystem::path path, Access access, Journal journal);

  const std::filesystem::path& path() const { return path_; }
  sqlite3* handle() const { return db_.get(); }
  void execute(const std::string& sql) const;
  /// The integer that the statement gives: "PRAGMA user_version", "SELECT count(*) FROM runs".
  std::int64_t number(const std::string& sql) const;
  [[noreturn]] void fail() const;

 private:
  void set_journal(Journal journal);

  std::filesystem::path path_;
  struct Close {
    void operator()(sqlite3*) const;
  };
  std::unique_ptr<sqlite3, Close> db_;
};

/// A prepared statement. `db` must outlive it.
class Statement {
 public:
  Statement(const Database& db, const std::string& sql);

  /// Sets the parameters, the first of which has the number 1, and carries the statement out to its end. Returns the
  /// number of rows that an INSERT or DELETE has added or deleted.
  int run(std::span<const Value> parameters);

  void bind(int parameter, const Value& value);  ///< counted from 1; a text or a blob must live until the next step()
  bool step();                                   ///< advances to the next row; false if there is none
  void reset();                                  ///< allows further bind() and step()
  Value value(int column) const;       ///< value of a column, counted from 0; valid until the next step() or reset()
  int columns() const;                 ///< number of columns of a row
  std::string name(int column) const;  ///< name of a column, counted from 0
  std::int64_t integer(int column) const;  ///< throws std::runtime_error if the value is no integer

 private:
  const Database* db_;
  struct Finalize {
    void operator()(sqlite3_stmt*) const;
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::vector<bool> is_null_;  ///< true for a parameter that is NULL, as all are at first
};

/// The name as an SQL identifier, in double quotes.
std::string quoted_name(const std::string& name);

}  // namespace polhode::study::store
