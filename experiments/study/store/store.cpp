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
#include <type_traits>
#include <variant>

#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline store {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, sqlite3* db) {
  if (!db) throw std::runtime_error(path.string() + ": out of memory");
  std::string why = sqlite3_errmsg(db);
  if (const int reason = sqlite3_system_errno(db)) why += std::string(": ") + std::strerror(reason);
  throw std::runtime_error(path.string() + ": " + why);
}

/// Thrown for a row with a value that no study writes; what() is the name of the column.
class Damage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A prepared statement with typed binding and reading; each call binds the next parameter or reads the next column.
/// Reading throws Damage if the column has another type, or a number that is not finite.
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
  /// Binds the text "name=value " of each entry; names are identifiers, values have all digits.
  void bind(const std::map<std::string, double>& values) {
    std::string all;
    for (const auto& [name, value] : values) all += name + "=" + exact(value) + " ";
    bind(all);
  }
  template <class Point>
  void bind(const std::vector<Point>& series) {
    static_assert(std::is_trivially_copyable_v<Point>);
    sqlite3_bind_blob(statement_, ++at_, series.data(), static_cast<int>(series.size() * sizeof(Point)),
                      SQLITE_TRANSIENT);
  }

  /// Advances to the next row. Returns false if there is none.
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
  /// The next column: a number, which may be infinite, or nothing for NULL.
  std::optional<double> any_real() {
    const int type = next();
    if (type == SQLITE_NULL) return std::nullopt;
    if (type != SQLITE_FLOAT) damaged();
    return sqlite3_column_double(statement_, column_);
  }
  template <class Point>
  std::vector<Point> series() {
    const int type = next();
    if (type == SQLITE_NULL) return {};  // an empty series is stored as NULL
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

std::string sql_type(const Metric& metric) {
  const auto of_member = []<class M>(M) {
    if (std::is_same_v<M, std::int64_t RunResult::*>) return "INTEGER";
    const bool text =
        std::is_same_v<M, std::string RunResult::*> || std::is_same_v<M, std::map<std::string, double> RunResult::*>;
    return text ? "TEXT" : "REAL";
  };
  return std::visit(of_member, metric.member);
}

/// Column definitions of the table `runs`, in the order of pack() and unpack().
std::string columns_of(std::span<const Metric> metrics) {
  std::string text = "id TEXT PRIMARY KEY";
  for (const Metric& metric : metrics) text += ", " + metric.column + " " + sql_type(metric);
  return text + ", t_reached_s REAL, wall_s REAL, series BLOB, attitude_errors BLOB";
}

/// Binds the columns of a row. Throws std::logic_error if the result has a number of a metric that is not in `metrics`.
void pack(Statement& row, const RunRecord& record, std::span<const Metric> metrics) {
  const RunResult& r = record.result;
  for (const auto& measured : r.further) {
    const std::string& column = measured.first;
    if (std::none_of(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.column == column; })) {
      throw std::logic_error("the metric " + column + " is measured, but is not in the table of metrics");
    }
  }
  row.bind(record.id);
  for (const Metric& metric : metrics) with_value(metric, r, [&](const auto& value) { row.bind(value); });
  row.bind(r.t_reached);
  row.bind(r.seconds);
  row.bind(r.series);
  row.bind(r.attitude_errors);
}

/// Reads the columns of a row after the id. Throws Damage.
void unpack(Statement& row, RunResult& r, std::span<const Metric> metrics) {
  for (const Metric& metric : metrics) {
    with_value(metric, r, [&]<class Value>(Value& value) {
      if constexpr (std::is_same_v<Value, std::optional<double>>) {
        value = metric.may_be_infinite ? row.any_real() : row.optional_real();
      } else if constexpr (std::is_same_v<Value, std::int64_t>) {
        value = row.count();
      } else if constexpr (std::is_same_v<Value, std::string>) {
        value = row.text();
      } else {
        value = row.named_numbers();
      }
    });
  }
  if (r.status != "ok" && r.status != "diverged" && r.status != "failed") throw Damage("status");
  r.t_reached = row.real();
  r.seconds = row.real();
  r.series = row.series<SeriesPoint>();
  r.attitude_errors = row.series<AttitudeError>();
}

/// Longest time to wait while another program locks the store, ms.
constexpr int patience_ms = 5000;

/// Replacement of mmap for SQLite: allocates the mapped part of the file first. SQLite writes only one byte of each
/// page of its shared-memory file before it maps the file. If a block of the file system is smaller than a page, the
/// other blocks are holes, and access to a hole on a full disk kills the program (SIGBUS).
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

/// Throws std::runtime_error if the database is damaged, or has a table `runs` with other columns.
void check(const std::filesystem::path& path, sqlite3* db, std::span<const Metric> metrics) {
  Statement whole(path, db, "PRAGMA integrity_check(1)");
  if (!whole.step() || whole.text() != "ok") throw std::runtime_error(path.string() + ": the database is damaged");
  Statement made(path, db, "SELECT sql FROM sqlite_master WHERE name = 'runs'");
  if (made.step() && made.text() != "CREATE TABLE runs (" + columns_of(metrics) + ")") {
    throw std::runtime_error(path.string() + ": its table runs is not that of this version of polhode");
  }
}

}  // namespace

void Store::Close::operator()(sqlite3* db) const { sqlite3_close(db); }

Store::Store(const std::filesystem::path& folder, std::span<const Metric> metrics)
    : path_(folder / file_name), metrics_(metrics) {
  db_.reset(open_database(path_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE));
  // A commit survives a crash of the process without waiting for the disk; SQLite syncs to disk at checkpoints only.
  execute("PRAGMA journal_mode=WAL");
  execute("PRAGMA synchronous=NORMAL");
  execute("CREATE TABLE IF NOT EXISTS runs (" + columns_of(metrics_) + ")");
}

Store::~Store() = default;

void Store::execute(const std::string& sql) const {
  if (sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail(path_, db_.get());
}

Store::Loaded Store::load() const {
  Loaded loaded;
  Statement rows(path_, db_.get(), "SELECT * FROM runs");
  while (rows.step()) {
    const std::string id = rows.text();
    RunResult result;
    try {
      unpack(rows, result, metrics_);
      loaded.runs[id] = std::move(result);
    } catch (const Damage& damage) {
      loaded.damaged.emplace(id, std::string("runs.") + damage.what());
    }
  }
  return loaded;
}

void Store::forget(const std::string& id) {
  Statement row(path_, db_.get(), "DELETE FROM runs WHERE id = ?");
  row.bind(id);
  row.step();
}

void Store::keep(std::span<const RunRecord> records) {
  const std::string columns = columns_of(metrics_);
  std::string parameters = "?";
  for (auto more = std::count(columns.begin(), columns.end(), ','); more > 0; --more) parameters += ",?";
  execute("BEGIN IMMEDIATE");
  try {
    Statement insert(path_, db_.get(), "INSERT OR REPLACE INTO runs VALUES (" + parameters + ")");
    for (const RunRecord& record : records) {
      pack(insert, record, metrics_);
      insert.step();
      insert.reset();
    }
    execute("COMMIT");
  } catch (...) {
    sqlite3_exec(db_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

std::set<std::string> Store::ids_in(const std::filesystem::path& folder, std::span<const Metric> metrics) {
  std::set<std::string> ids;
  const std::filesystem::path path = folder / file_name;
  if (!std::filesystem::exists(path)) return ids;
  const std::unique_ptr<sqlite3, Close> db(open_database(path, SQLITE_OPEN_READWRITE));
  try {
    check(path, db.get(), metrics);
    // A program that was killed just after its start leaves a store without the table.
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
  // SQLite appends suffixes to the file name, the longest of which is "-journal".
  return static_cast<std::size_t>(sqlite3_vfs_find(nullptr)->mxPathname) - std::strlen("/-journal") -
         std::strlen(file_name);
}

}  // namespace polhode::study::store
