// SPDX-License-Identifier: BSD-3-Clause
// Stores with random damage: what is read is either right, or said to be damaged, or refused in one line.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/study/store/store.hpp"
#include "tests/experiments/study/store/loaded.hpp"
#include "tests/experiments/study/store/stored_runs.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::store_tests::damage_test {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t n) { return static_cast<std::size_t>(random() % n); }

template <class Item>
const Item& one_of(Random& random, const std::vector<Item>& items) {
  return items[below(random, items.size())];
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// The names of all columns of the tables, "runs.status", without the numbers.
std::vector<std::pair<std::string, std::string>> columns_of(const std::filesystem::path& path) {
  std::vector<std::pair<std::string, std::string>> columns;
  sqlite3* db = nullptr;
  sqlite3_open(path.c_str(), &db);
  for (const char* table : {"runs", "curves", "timings"}) {
    sqlite3_stmt* rows = nullptr;
    sqlite3_prepare_v2(db, ("SELECT name FROM pragma_table_info('" + std::string(table) + "') WHERE pk = 0").c_str(),
                       -1, &rows, nullptr);
    while (sqlite3_step(rows) == SQLITE_ROW)
      columns.emplace_back(table, reinterpret_cast<const char*>(sqlite3_column_text(rows, 0)));
    sqlite3_finalize(rows);
  }
  sqlite3_close(db);
  return columns;
}

/// Damages bytes of the file: some overwritten, some flipped, a page zeroed or put elsewhere, or the end cut off.
std::string damaged_bytes(std::string bytes, Random& random) {
  const std::size_t page = 4096, pages = bytes.size() / page;
  switch (below(random, 6)) {
    case 0:
      for (std::size_t k = 1 + below(random, 40); k > 0; --k)
        bytes[below(random, bytes.size())] = static_cast<char>(random());
      break;
    case 1: bytes[below(random, bytes.size())] ^= static_cast<char>(1 << below(random, 8)); break;
    case 2: bytes.replace(page * below(random, pages), page, std::string(page, '\0')); break;
    case 3: bytes.replace(page * below(random, pages), page, bytes.substr(page * below(random, pages), page)); break;
    case 4: bytes.resize(below(random, bytes.size())); break;
    default: bytes[below(random, 200)] = static_cast<char>(random()); break;  // the header
  }
  return bytes;
}

/// A change by SQL: of a value, of rows, or of the table's columns.
std::string damaging_sql(const std::vector<std::pair<std::string, std::string>>& columns, Random& random) {
  const auto& [table, column] = one_of(random, columns);
  const auto& [other_table, other] = one_of(random, columns);
  const std::string some = " WHERE number IN (SELECT number FROM " + table + " ORDER BY number LIMIT 1 OFFSET " +
                           std::to_string(below(random, 12)) + ")";
  const std::string values[] = {"NULL",
                                "'text'",
                                "7",
                                "0.125",
                                "-1",
                                "9e999",
                                "x'00ff'",
                                "zeroblob(80)",
                                "''",
                                column + " * 2",
                                column + " + 1",
                                "-" + column,
                                "substr(" + column + ", 1, 40)",
                                column + " || 'x'",
                                "CAST(" + column + " AS TEXT)"};
  const std::string quoted = "\"" + column + "\"";
  switch (below(random, 8)) {
    case 0: return "DELETE FROM " + table + some;
    case 1: return "DELETE FROM " + table;
    case 2: return "ALTER TABLE " + table + " RENAME COLUMN " + quoted + " TO renamed";
    case 3:
      if (table != other_table) return "DELETE FROM " + other_table;
      return "ALTER TABLE " + table + " RENAME COLUMN " + quoted + " TO swapped; ALTER TABLE " + table +
             " RENAME COLUMN \"" + other + "\" TO " + quoted + "; ALTER TABLE " + table +
             " RENAME COLUMN swapped TO \"" + other + "\"";
    case 4: return "UPDATE " + table + " SET number = number + 100" + some;
    default: return "UPDATE " + table + " SET " + quoted + " = " + values[below(random, std::size(values))] + some;
  }
}

/// The outcome of the reading of a damaged store.
struct Outcome {
  bool refused = false;
  std::size_t right = 0, damaged = 0;
};

/// Reads the store as a study does. Fails the test for a result that differs from that of the run.
Outcome outcome_of(const std::filesystem::path& folder, const std::map<std::string, std::string>& whole,
                   const std::string& what) {
  Outcome outcome;
  try {
    Store::ids_in(folder);
    const auto loaded = load(Store(folder));
    outcome.damaged = loaded.damaged.size();
    for (const auto& [id, result] : loaded.runs) {
      const auto known = whole.find(id);
      if (known == whole.end()) ADD_FAILURE() << what << ": a run " << id << " that was never kept";
      else if (known->second != text_of_result(result)) ADD_FAILURE() << what << ": run " << id << " has other values";
      ++outcome.right;
    }
  } catch (const std::runtime_error& error) {
    outcome.refused = true;
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << what;
    EXPECT_NE(std::string(error.what()).find(Store::file_name), std::string::npos) << what << ": " << error.what();
  }
  return outcome;
}

TEST(DamagedStore, NoRandomDamageGivesOtherNumbers) {
  const TemporaryFolder folder;
  const auto path = folder.path() / Store::file_name;
  const auto runs = made_up_runs(12);
  Store(folder.path()).keep(runs);
  const std::string bytes = bytes_of(path);
  const auto columns = columns_of(path);
  std::map<std::string, std::string> whole;
  for (const RunRecord& run : runs) whole[run.id] = text_of_result(run.result);
  Random random(20240607);
  std::size_t refused = 0, with_damage = 0, with_loss = 0, as_before = 0;
  constexpr int trials = 600;
  for (int trial = 0; trial < trials; ++trial) {
    for (const char* suffix : {"-wal", "-shm", "-journal"}) std::filesystem::remove(path.string() + suffix);
    std::string what = "trial " + std::to_string(trial);
    if (trial % 2 == 0) {
      write_bytes(path, damaged_bytes(bytes, random));
    } else {
      write_bytes(path, bytes);
      const std::string sql = damaging_sql(columns, random);
      what += ": " + sql;
      sqlite3* db = nullptr;
      ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
      sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr);
      sqlite3_close(db);
    }
    const Outcome outcome = outcome_of(folder.path(), whole, what);
    if (outcome.refused) ++refused;
    else if (outcome.damaged > 0) ++with_damage;
    else if (outcome.right < runs.size()) ++with_loss;
    else ++as_before;
  }
  // All four kinds of end occur: the damage is neither too weak nor too strong to test anything.
  EXPECT_GT(refused, trials / 10);
  EXPECT_GT(with_damage, trials / 10);
  EXPECT_GT(with_loss, trials / 100);
  EXPECT_GT(as_before, trials / 50);
}

}  // namespace
}  // namespace polhode::study::store_tests::damage_test
