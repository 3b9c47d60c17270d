// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store.hpp"

#include <sqlite3.h>

#include <cstring>
#include <stdexcept>

#include "experiments/study/axes.hpp"

namespace polhode::study {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, sqlite3* db) {
  throw std::runtime_error(path.string() + ": " + (db ? sqlite3_errmsg(db) : "out of memory"));
}

/// A prepared statement with typed binding and reading; columns and parameters are taken in order.
class Statement {
 public:
  Statement(const std::filesystem::path& path, sqlite3* db, const char* sql) : path_(path), db_(db) {
    if (sqlite3_prepare_v2(db, sql, -1, &statement_, nullptr) != SQLITE_OK) fail(path_, db_);
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
    column_ = 0;
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) fail(path_, db_);
    return code == SQLITE_ROW;
  }
  void reset() {
    sqlite3_reset(statement_);
    at_ = 0;
  }

  std::string text() {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column_));
    const int n = sqlite3_column_bytes(statement_, column_++);
    return bytes ? std::string(bytes, static_cast<std::size_t>(n)) : std::string();
  }
  std::int64_t integer() { return sqlite3_column_int64(statement_, column_++); }
  double real() { return sqlite3_column_double(statement_, column_++); }
  std::optional<double> optional_real() {
    if (sqlite3_column_type(statement_, column_) == SQLITE_NULL) {
      ++column_;
      return std::nullopt;
    }
    return real();
  }
  template <class Point>
  std::vector<Point> series() {
    const void* bytes = sqlite3_column_blob(statement_, column_);
    const auto n = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column_++));
    std::vector<Point> points(n / sizeof(Point));
    if (!points.empty()) std::memcpy(points.data(), bytes, points.size() * sizeof(Point));
    return points;
  }

 private:
  const std::filesystem::path& path_;
  sqlite3* db_;
  sqlite3_stmt* statement_ = nullptr;
  int at_ = 0, column_ = 0;
};

/// name=value, separated by blanks; names are identifiers and numbers read back exactly.
std::string pack(const std::map<std::string, double>& values) {
  std::string text;
  for (const auto& [name, value] : values) text += name + "=" + exact(value) + " ";
  return text;
}
std::map<std::string, double> unpack(const std::string& text) {
  std::map<std::string, double> values;
  std::size_t at = 0;
  while (at < text.size()) {
    const auto equals = text.find('=', at), end = text.find(' ', at);
    values[text.substr(at, equals - at)] = std::stod(text.substr(equals + 1, end - equals - 1));
    at = end + 1;
  }
  return values;
}

/// The columns of the table `drifts`, in their order.
constexpr std::optional<double> RunResult::*drift_members[] = {&RunResult::energy_drift_rate_ci,
                                                               &RunResult::drift_exponent,
                                                               &RunResult::drift_exponent_low,
                                                               &RunResult::drift_exponent_high,
                                                               &RunResult::polhode_phase_error_max,
                                                               &RunResult::polhode_phase_error_max_rad,
                                                               &RunResult::polhode_off_error_max_rel};

/// The columns of the table `energies`, in their order.
constexpr std::optional<double> RunResult::*energy_members[] = {&RunResult::energy_scale, &RunResult::energy_drift_max,
                                                                &RunResult::energy_round_off,
                                                                &RunResult::drift_decided_after};

/// The columns of the table `contacts`, in their order.
constexpr std::optional<double> ContactMeasures::*contact_members[] = {
    &ContactMeasures::first_impact,    &ContactMeasures::impact_loss,       &ContactMeasures::friction_loss,
    &ContactMeasures::penetration_energy, &ContactMeasures::energy_rise_max, &ContactMeasures::energy_change_max,
    &ContactMeasures::penetration_max, &ContactMeasures::penetration_end,   &ContactMeasures::displacement_max,
    &ContactMeasures::left_place};

/// How long another program that looks into the store may hold it.
constexpr int patience_ms = 5000;

}  // namespace

void Store::Close::operator()(sqlite3* db) const { sqlite3_close(db); }

Store::Store(const std::filesystem::path& folder) : path_(folder / file_name) {
  sqlite3* db = nullptr;
  const int code = sqlite3_open(path_.c_str(), &db);
  db_.reset(db);
  if (code != SQLITE_OK) fail(path_, db);
  sqlite3_busy_timeout(db, patience_ms);
  // A commit survives the death of the process without waiting for the disk; the disk is waited for at checkpoints.
  execute("PRAGMA journal_mode=WAL");
  execute("PRAGMA synchronous=NORMAL");
  execute(
      "CREATE TABLE IF NOT EXISTS runs (id TEXT PRIMARY KEY, status TEXT, message TEXT, t_reached_s REAL, steps INTEGER,"
      " rhs_evaluations INTEGER, energy_initial_J REAL, energy_drift_max_rel REAL, energy_drift_final_rel REAL,"
      " energy_drift_rate_W REAL, drift_class TEXT, linear_momentum_drift_max_rel REAL,"
      " angular_momentum_drift_max_rel REAL, invariant_drifts_max_rel TEXT, orientation_defect_max REAL,"
      " position_error_max_m REAL, attitude_error_max_rad REAL, angular_velocity_error_max_rel REAL, wall_s REAL,"
      " series BLOB)");
  // How the energy drift grows, and the error along the polhode and off it.
  execute(
      "CREATE TABLE IF NOT EXISTS drifts (id TEXT PRIMARY KEY, energy_drift_rate_ci_W REAL, drift_exponent REAL,"
      " drift_exponent_low REAL, drift_exponent_high REAL, polhode_phase_error_max_s REAL,"
      " polhode_phase_error_max_rad REAL, polhode_off_error_max_rel REAL)");
  // What energy drifts are judged by.
  execute(
      "CREATE TABLE IF NOT EXISTS energies (id TEXT PRIMARY KEY, energy_scale_J REAL, energy_drift_max_J REAL,"
      " energy_round_off_J REAL, drift_decided_after_s REAL)");
  // Of the runs that were judged by a reference, how uncertain it is.
  execute(
      "CREATE TABLE IF NOT EXISTS references_used (id TEXT PRIMARY KEY, position_m REAL, attitude_rad REAL,"
      " angular_velocity_rel REAL)");
  // Of the runs with contact.
  execute(
      "CREATE TABLE IF NOT EXISTS contacts (id TEXT PRIMARY KEY, first_impact_s REAL, impact_loss_J REAL,"
      " friction_loss_J REAL, penetration_J REAL, energy_rise_max_J REAL, energy_change_max_J REAL, penetration_max_m REAL,"
      " penetration_end_m REAL, displacement_after_2s_max_m REAL, left_place_s REAL)");
  // Of the runs with an exact motion, their attitude error over time.
  execute("CREATE TABLE IF NOT EXISTS attitude_errors (id TEXT PRIMARY KEY, series BLOB)");
}

Store::~Store() = default;

void Store::execute(const char* sql) const {
  if (sqlite3_exec(db_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(path_, db_.get());
}

std::map<std::string, RunResult> Store::load() const {
  std::map<std::string, RunResult> results;
  Statement rows(path_, db_.get(), "SELECT * FROM runs");
  while (rows.step()) {
    RunResult& r = results[rows.text()];
    r.status = rows.text();
    r.message = rows.text();
    r.t_reached = rows.real();
    r.steps = rows.integer();
    r.evaluations = rows.integer();
    r.energy_initial = rows.optional_real();
    r.energy_drift_max_rel = rows.optional_real();
    r.energy_drift_final_rel = rows.optional_real();
    r.energy_drift_rate = rows.optional_real();
    r.drift_class = rows.text();
    r.linear_momentum_drift_max_rel = rows.optional_real();
    r.angular_momentum_drift_max_rel = rows.optional_real();
    r.invariant_drift_max_rel = unpack(rows.text());
    r.orientation_defect_max = rows.optional_real();
    r.position_error_max = rows.optional_real();
    r.attitude_error_max = rows.optional_real();
    r.angular_velocity_error_max_rel = rows.optional_real();
    r.seconds = rows.real();
    r.series = rows.series<SeriesPoint>();
  }
  Statement drifts(path_, db_.get(), "SELECT * FROM drifts WHERE id IN (SELECT id FROM runs)");
  while (drifts.step()) {
    RunResult& r = results[drifts.text()];
    for (const auto member : drift_members) r.*member = drifts.optional_real();
  }
  Statement energies(path_, db_.get(), "SELECT * FROM energies WHERE id IN (SELECT id FROM runs)");
  while (energies.step()) {
    RunResult& r = results[energies.text()];
    for (const auto member : energy_members) r.*member = energies.optional_real();
  }
  Statement used(path_, db_.get(), "SELECT * FROM references_used WHERE id IN (SELECT id FROM runs)");
  while (used.step()) {
    RunResult& r = results[used.text()];
    r.position_reference = used.optional_real();
    r.attitude_reference = used.optional_real();
    r.angular_velocity_reference_rel = used.optional_real();
  }
  Statement contacts(path_, db_.get(), "SELECT * FROM contacts WHERE id IN (SELECT id FROM runs)");
  while (contacts.step()) {
    RunResult& r = results[contacts.text()];
    for (const auto member : contact_members) r.contact.*member = contacts.optional_real();
  }
  Statement errors(path_, db_.get(), "SELECT * FROM attitude_errors WHERE id IN (SELECT id FROM runs)");
  while (errors.step()) {
    RunResult& r = results[errors.text()];
    r.attitude_errors = errors.series<AttitudeError>();
  }
  return results;
}

void Store::keep(std::span<const RunRecord> records) {
  execute("BEGIN IMMEDIATE");
  try {
    Statement insert(path_, db_.get(),
                     "INSERT OR REPLACE INTO runs VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
    Statement drifts(path_, db_.get(), "INSERT OR REPLACE INTO drifts VALUES (?,?,?,?,?,?,?,?)");
    Statement energies(path_, db_.get(), "INSERT OR REPLACE INTO energies VALUES (?,?,?,?,?)");
    Statement used(path_, db_.get(), "INSERT OR REPLACE INTO references_used VALUES (?,?,?,?)");
    Statement contacts(path_, db_.get(), "INSERT OR REPLACE INTO contacts VALUES (?,?,?,?,?,?,?,?,?,?,?)");
    Statement errors(path_, db_.get(), "INSERT OR REPLACE INTO attitude_errors VALUES (?,?)");
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
  sqlite3* db = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &db, SQLITE_OPEN_READWRITE, nullptr);
  const std::unique_ptr<sqlite3, Close> guard(db);
  if (code != SQLITE_OK) fail(path, db);
  sqlite3_busy_timeout(db, patience_ms);
  // A program killed at once leaves a store without its table.
  Statement table(path, db, "SELECT name FROM sqlite_master WHERE name = 'runs'");
  if (!table.step()) return ids;
  Statement rows(path, db, "SELECT id FROM runs");
  while (rows.step()) ids.insert(rows.text());
  return ids;
}

}  // namespace polhode::study
