// SPDX-License-Identifier: BSD-3-Clause
// The columns of a table of the store, and whether a database has such a table.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/study/store/database.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::inline store {

/// A table of the store is missing, or has other columns.
struct OtherTables : InputError {
  using InputError::InputError;
};

struct TableForm {
  std::string name;
  std::vector<std::pair<std::string, std::string>> columns;  ///< name and type in SQL; the first is the primary key
  bool may_have_more = false;                                ///< further columns, of any type, are allowed

  std::string definition() const;  ///< CREATE TABLE …
  /// Throws OtherTables if the database does not have the table, or has it with other columns. Their order is free.
  void check(const Database& db) const;
};

}  // namespace polhode::study::store
