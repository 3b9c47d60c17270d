// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/store.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "experiments/study/record/result_numbers.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, sqlite3* db) {
  if (!db) throw std::runtime_error(path.string() + ": out of memory");
  std::string why = sqlite3_errmsg(db);
  if (const int reason = sqlite3_system_errno(db)) why += std::string(": ") + std::strerror(reason);
  throw std::runtime_error(path.string() + ": " + why);
}

/// A row of the store that holds what no study wrote; what() names the column.
class Damage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A prepared statement with typed binding and reading; columns and parameters are taken in order. Reading throws
/// Damage where a column holds another type, or a number that is not finite.
class Statement {
 public:
  Statement(const std::filesystem::path& path, sqlite3* db, const std::string& sql) : path_(path), db_(db) {
    if (sqlite3_prepare_v2(db, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) fail(path_, db_);
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(const std::string& text) {
    sqlite3_bind_text(statement_, ++at_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void bind(std::int64_t n) { sqlite3_bind_int64(statement_, ++at_, n); }
  void bind(double x) { sqlite3_bind_double(statement_, ++at_, x); }
  void bind(const std::optional<double>& x) {
    if (x) bind(*x);
    else sqlite3_bind_null(statement_, ++at_);
  }
  template <class Point>
  void bind(const std::vector<Point>& series) {
    static_assert(std::is_trivially_copyable_v<Point>);
    sqlite3_bind_blob(statement_, ++at_, series.data(), static_cast<int>(series.size() * sizeof(Point)),
                      SQLITE_TRANSIENT);
  }

  /// True while there are rows.
  bool step() {
    column_ = -1;
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) fail(path_, db_);
    return code == SQLITE_ROW;
  }
  void reset() {
    sqlite3_reset(statement_);
    at_ = 0;
  }

  std::string text() {
    if (next() != SQLITE_TEXT) damaged();
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column_));
    return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column_))};
  }
  std::int64_t count() {
    if (next() != SQLITE_INTEGER) damaged();
    const std::int64_t n = sqlite3_column_int64(statement_, column_);
    if (n < 0) damaged();
    return n;
  }
  double real() {
    const auto x = optional_real();
    if (!x) damaged();
    return *x;
  }
  std::optional<double> optional_real() {
    const auto x = any_real();
    if (x && !std::isfinite(*x)) damaged();
    return x;
  }
  /// Infinite too.
  std::optional<double> any_real() {
    const int type = next();
    if (type == SQLITE_NULL) return std::nullopt;
    if (type != SQLITE_FLOAT) damaged();
    return sqlite3_column_double(statement_, column_);
  }
  template <class Point>
  std::vector<Point> series() {
    const int type = next();
    if (type == SQLITE_NULL) return {};  // as an empty one is kept
    const void* bytes = sqlite3_column_blob(statement_, column_);
    const auto n = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column_));
    if (type != SQLITE_BLOB || n % sizeof(Point) != 0) damaged();
    std::vector<double> numbers(n / sizeof(double));
    if (n > 0) std::memcpy(numbers.data(), bytes, n);
    if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) damaged();
    std::vector<Point> points(n / sizeof(Point));
    if (n > 0) std::memcpy(points.data(), bytes, n);
    return points;
  }
  std::map<std::string, double> named_numbers() {
    std::map<std::string, double> values;
    const std::string all = text();
    for (std::size_t at = 0; at < all.size();) {
      const auto equals = all.find('=', at), end = all.find(' ', at);
      if (equals == std::string::npos || end == std::string::npos || equals > end) damaged();
      double x = 0;
      const auto read = std::from_chars(all.data() + equals + 1, all.data() + end, x);
      if (read.ec != std::errc() || read.ptr != all.data() + end || !std::isfinite(x)) damaged();
      values[all.substr(at, equals - at)] = x;
      at = end + 1;
    }
    return values;
  }

 private:
  int next() { return sqlite3_column_type(statement_, ++column_); }

  [[noreturn]] void damaged() const { throw Damage(sqlite3_column_name(statement_, column_)); }

  const std::filesystem::path& path_;
  sqlite3* db_;
  sqlite3_stmt* statement_ = nullptr;
  int at_ = 0, column_ = -1;
};

/// name=value, a blank after each; names are identifiers and numbers read back exactly.
std::string pack(const std::map<std::string, double>& values) {
  std::string text;
  for (const auto& [name, value] : values) text += name + "=" + exact(value) + " ";
  return text;
}

struct Table {
  std::string name, columns;
};

const std::vector<Table>& tables() {
  static const std::vector<Table> all = {
      {"runs",
       "id TEXT PRIMARY KEY, status TEXT, message TEXT, t_reached_s REAL, steps INTEGER, rhs_evaluations INTEGER,"
       " energy_initial_J REAL, energy_drift_max_rel REAL, energy_drift_final_rel REAL, energy_drift_rate_W REAL,"
       " drift_class TEXT, linear_momentum_drift_max_rel REAL, angular_momentum_drift_max_rel REAL,"
       " invariant_drifts_max_rel TEXT, orientation_defect_max REAL, position_error_max_m REAL,"
       " attitude_error_max_rad REAL, angular_velocity_error_max_rel REAL, wall_s REAL, series BLOB"},
      // How the energy drift grows, and the error along the polhode and off it.
      {"drifts",
       "id TEXT PRIMARY KEY, energy_drift_rate_ci_W REAL, drift_exponent REAL, drift_exponent_low REAL,"
       " drift_exponent_high REAL, polhode_phase_error_max_s REAL, polhode_phase_error_max_rad REAL,"
       " polhode_off_error_max_rel REAL"},
      // What energy drifts are judged by.
      {"energies",
       "id TEXT PRIMARY KEY, energy_scale_J REAL, energy_drift_max_J REAL, energy_round_off_J REAL,"
       " drift_decided_after_s REAL"},
      // Of the runs that were judged by a reference, how uncertain it is.
      {"references_used", "id TEXT PRIMARY KEY, position_m REAL, attitude_rad REAL, angular_velocity_rel REAL"},
      // Of the runs with contact.
      {"contacts",
       "id TEXT PRIMARY KEY, first_impact_s REAL, impact_loss_J REAL, friction_loss_J REAL, penetration_J REAL,"
       " energy_rise_max_J REAL, energy_change_max_J REAL, penetration_max_m REAL, penetration_end_m REAL,"
       " displacement_after_2s_max_m REAL, left_place_s REAL"},
      // Of the runs with an exact motion, their attitude error over time.
      {"attitude_errors", "id TEXT PRIMARY KEY, series BLOB"}};
  return all;
}

/// A row is put into the table by this, with a parameter for each column.
std::string insertion(const std::string& name) {
  const auto table = std::find_if(tables().begin(), tables().end(), [&](const Table& t) { return t.name == name; });
  std::string sql = "INSERT OR REPLACE INTO " + name + " VALUES (?";
  for (auto more = std::count(table->columns.begin(), table->columns.end(), ','); more > 0; --more) sql += ",?";
  return sql + ")";
}

/// How long another program that looks into the store may hold it.
constexpr int patience_ms = 5000;

/// SQLite maps the file of a store's shared memory, having written one byte of each page of it. Where a block of the
/// file system is smaller than a page, the others are holes, and to touch one on a full disk would kill the program.
void* map_filled(void* at, std::size_t length, int protection, int flags, int file, off_t offset) {
  if ((protection & PROT_WRITE) && fallocate(file, 0, offset, static_cast<off_t>(length)) != 0 &&
      (errno == ENOSPC || errno == EDQUOT)) {
    return MAP_FAILED;
  }
  return mmap(at, length, protection, flags, file, offset);
}

sqlite3* open_database(const std::filesystem::path& path, int flags) {
  [[maybe_unused]] static const int filled = [] {
    sqlite3_vfs* vfs = sqlite3_vfs_find(nullptr);
    return vfs->xSetSystemCall(vfs, "mmap", reinterpret_cast<sqlite3_syscall_ptr>(map_filled));
  }();
  sqlite3* db = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &db, flags, nullptr);
  if (code == SQLITE_OK) {
    sqlite3_busy_timeout(db, patience_ms);
    return db;
  }
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> failed(db, sqlite3_close);
  fail(path, db);
}

/// Throws where the database is damaged, or has a table of ours with other columns.
void check(const std::filesystem::path& path, sqlite3* db) {
  Statement whole(path, db, "PRAGMA integrity_check(1)");
  if (!whole.step() || whole.text() != "ok") throw std::runtime_error(path.string() + ": the database is damaged");
  for (const Table& table : tables()) {
    Statement made(path, db, "SELECT sql FROM sqlite_master WHERE name = '" + table.name + "'");
    if (made.step() && made.text() != "CREATE TABLE " + table.name + " (" + table.columns + ")") {
      throw std::runtime_error(path.string() + ": its table " + table.name + " is not that of this version of polhode");
    }
  }
}

}  // namespace

void Store::Close::operator()(sqlite3* db) const { sqlite3_close(db); }

Store::Store(const std::filesystem::path& folder) : path_(folder / file_name) {
  db_.reset(open_database(path_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE));
  // A commit survives the death of the process without waiting for the disk; the disk is waited for at checkpoints.
  execute("PRAGMA journal_mode=WAL");
  execute("PRAGMA synchronous=NORMAL");
  for (const Table& table : tables()) execute("CREATE TABLE IF NOT EXISTS " + table.name + " (" + table.columns + ")");
}

Store::~Store() = default;

void Store::execute(const std::string& sql) const {
  if (sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(path_, db_.get());
}

Store::Loaded Store::load() const {
  Loaded loaded;
  // Calls read(row, result) for each row of a table that belongs to a run; a run with a damaged one is none.
  const auto each_row = [&](const std::string& table, const auto& read) {
    Statement rows(path_, db_.get(), "SELECT * FROM " + table + " WHERE id IN (SELECT id FROM runs)");
    std::set<std::string> seen;
    while (rows.step()) {
      const std::string id = rows.text();
      seen.insert(id);
      try {
        read(rows, loaded.runs[id]);
      } catch (const Damage& damage) {
        loaded.damaged.emplace(id, table + "." + damage.what());
      }
    }
    return seen;
  };
  const auto ids = each_row("runs", [](Statement& row, RunResult& r) {
    r.status = row.text();
    if (r.status != "ok" && r.status != "diverged" && r.status != "failed") throw Damage("status");
    r.message = row.text();
    r.t_reached = row.real();
    r.steps = row.count();
    r.evaluations = row.count();
    r.energy_initial = row.optional_real();
    r.energy_drift_max_rel = row.optional_real();
    r.energy_drift_final_rel = row.optional_real();
    r.energy_drift_rate = row.optional_real();
    r.drift_class = row.text();
    r.linear_momentum_drift_max_rel = row.optional_real();
    r.angular_momentum_drift_max_rel = row.optional_real();
    r.invariant_drift_max_rel = row.named_numbers();
    r.orientation_defect_max = row.optional_real();
    r.position_error_max = row.optional_real();
    r.attitude_error_max = row.optional_real();
    r.angular_velocity_error_max_rel = row.optional_real();
    r.seconds = row.real();
    r.series = row.series<SeriesPoint>();
  });
  const auto need = [&](const std::string& table, const std::set<std::string>& seen) {
    for (const std::string& id : ids) {
      if (!seen.contains(id)) loaded.damaged.emplace(id, "no row in " + table);
    }
  };
  need("drifts", each_row("drifts", [](Statement& row, RunResult& r) {
         for (const auto member : drift_members) r.*member = row.optional_real();
       }));
  need("energies", each_row("energies", [](Statement& row, RunResult& r) {
         for (const auto member : energy_members) r.*member = row.optional_real();
       }));
  each_row("references_used", [](Statement& row, RunResult& r) {
    r.position_reference = row.any_real();
    r.attitude_reference = row.any_real();
    r.angular_velocity_reference_rel = row.any_real();
  });
  each_row("contacts", [](Statement& row, RunResult& r) {
    for (const auto member : contact_members) r.contact.*member = row.optional_real();
  });
  each_row("attitude_errors", [](Statement& row, RunResult& r) { r.attitude_errors = row.series<AttitudeError>(); });
  for (const auto& [id, why] : loaded.damaged) loaded.runs.erase(id);
  return loaded;
}

void Store::forget(const std::string& id) {
  for (const Table& table : tables()) {
    Statement row(path_, db_.get(), "DELETE FROM " + table.name + " WHERE id = ?");
    row.bind(id);
    row.step();
  }
}

void Store::keep(std::span<const RunRecord> records) {
  execute("BEGIN IMMEDIATE");
  try {
    Statement insert(path_, db_.get(), insertion("runs"));
    Statement drifts(path_, db_.get(), insertion("drifts"));
    Statement energies(path_, db_.get(), insertion("energies"));
    Statement used(path_, db_.get(), insertion("references_used"));
    Statement contacts(path_, db_.get(), insertion("contacts"));
    Statement errors(path_, db_.get(), insertion("attitude_errors"));
    for (const RunRecord& record : records) {
      const RunResult& r = record.result;
      if (!r.attitude_errors.empty()) {
        errors.bind(record.id);
        errors.bind(r.attitude_errors);
        errors.step();
        errors.reset();
      }
      insert.bind(record.id);
      insert.bind(r.status);
      insert.bind(r.message);
      insert.bind(r.t_reached);
      insert.bind(r.steps);
      insert.bind(r.evaluations);
      insert.bind(r.energy_initial);
      insert.bind(r.energy_drift_max_rel);
      insert.bind(r.energy_drift_final_rel);
      insert.bind(r.energy_drift_rate);
      insert.bind(r.drift_class);
      insert.bind(r.linear_momentum_drift_max_rel);
      insert.bind(r.angular_momentum_drift_max_rel);
      insert.bind(pack(r.invariant_drift_max_rel));
      insert.bind(r.orientation_defect_max);
      insert.bind(r.position_error_max);
      insert.bind(r.attitude_error_max);
      insert.bind(r.angular_velocity_error_max_rel);
      insert.bind(r.seconds);
      insert.bind(r.series);
      insert.step();
      insert.reset();
      drifts.bind(record.id);
      for (const auto member : drift_members) drifts.bind(r.*member);
      drifts.step();
      drifts.reset();
      energies.bind(record.id);
      for (const auto member : energy_members) energies.bind(r.*member);
      energies.step();
      energies.reset();
      if (r.contact.energy_change_max) {
        contacts.bind(record.id);
        for (const auto member : contact_members) contacts.bind(r.contact.*member);
        contacts.step();
        contacts.reset();
      }
      if (!r.position_reference && !r.attitude_reference && !r.angular_velocity_reference_rel) continue;
      used.bind(record.id);
      used.bind(r.position_reference);
      used.bind(r.attitude_reference);
      used.bind(r.angular_velocity_reference_rel);
      used.step();
      used.reset();
    }
    execute("COMMIT");
  } catch (...) {
    sqlite3_exec(db_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

std::set<std::string> Store::ids_in(const std::filesystem::path& folder) {
  std::set<std::string> ids;
  const std::filesystem::path path = folder / file_name;
  if (!std::filesystem::exists(path)) return ids;
  const std::unique_ptr<sqlite3, Close> db(open_database(path, SQLITE_OPEN_READWRITE));
  try {
    check(path, db.get());
    // A program killed at once leaves a store without its table.
    Statement table(path, db.get(), "SELECT name FROM sqlite_master WHERE name = 'runs'");
    if (!table.step()) return ids;
    Statement rows(path, db.get(), "SELECT id FROM runs");
    while (rows.step()) ids.insert(rows.text());
  } catch (const Damage& damage) {
    throw std::runtime_error(path.string() + ": a row without its " + damage.what());
  }
  return ids;
}

std::size_t Store::longest_folder() {
  // SQLite leaves room for what it adds to the name.
  return static_cast<std::size_t>(sqlite3_vfs_find(nullptr)->mxPathname) - std::strlen("/-journal") -
         std::strlen(file_name);
}

}  // namespace polhode::study
