// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/store.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/versions.hpp"
#include "experiments/study/store/result_tables.hpp"
#include "experiments/study/store/table_form.hpp"

namespace polhode::study::inline store {
namespace {

/// PRAGMA application_id of every store: "plhd" as four bytes.
constexpr std::int64_t application_id = 0x706c6864;

std::int64_t key_of(const std::string& id) { return static_cast<std::int64_t>(number_of_id(id)); }
std::string id_of_key(std::int64_t key) { return id_of_number(static_cast<std::uint64_t>(key)); }

bool is_empty(const Database& db) { return db.number("SELECT count(*) FROM sqlite_master") == 0; }

/// Throws std::runtime_error if the database is no store, or a store of another version.
void check_version(const Database& db) {
  if (is_empty(db)) {
    throw std::runtime_error(db.path().string() + ": is empty, because its study was stopped before the first run");
  }
  const std::int64_t application = db.number("PRAGMA application_id"), version = db.number("PRAGMA user_version");
  const bool unmarked = application == 0 && version == 0 &&  // stores had no version at first
                        db.number("SELECT count(*) FROM sqlite_master WHERE name = 'runs'") == 1;
  if (application != application_id && !unmarked) {
    throw std::runtime_error(fmt::format("{}: is a database, but no store of polhode (application_id {}, not {})",
                                         db.path().string(), application, application_id));
  }
  if (version != store_version) {
    throw std::runtime_error(fmt::format(
        "{}: the store has schema version {}, and this program reads version {}; use the version of polhode "
        "that made it, or make the study again in another folder",
        db.path().string(), version, store_version));
  }
}

std::vector<std::uint64_t> all_ids(const Database& db) {
  std::vector<std::uint64_t> ids;
  Statement rows(db, "SELECT id FROM runs WHERE typeof(id) = 'integer'");
  while (rows.step()) ids.push_back(static_cast<std::uint64_t>(rows.integer(0)));
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The three values as texts; absent if one is none.
std::optional<std::array<std::string, 3>> texts_of(std::span<const Value, 3> values) {
  std::array<std::string, 3> texts;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto* text = std::get_if<std::string_view>(&values[k]);
    if (!text) return std::nullopt;
    texts[k] = *text;
  }
  return texts;
}

}  // namespace

class Store::Transaction {
 public:
  explicit Transaction(const Database& db) : db_(db) { db_.execute("BEGIN IMMEDIATE"); }
  ~Transaction() {
    if (!committed_) sqlite3_exec(db_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit() {
    db_.execute("COMMIT");
    committed_ = true;
  }

 private:
  const Database& db_;
  bool committed_ = false;
};

std::string StoredRun::name() const {
  return RunKey{static_cast<std::int64_t>(number_of_id(id)), number, damage != id_damage}.name();
}

struct Store::Tables {
  explicit Tables(std::span<const Metric> all) : metrics(all), runs(runs_table(all)) {}

  std::span<const Metric> metrics;
  ResultTable runs, curves = curves_table(), timings = timings_table();
  TableForm configurations = configurations_form();
  TableForm scenarios{
      .name = "scenarios",
      .columns = {{"name", "TEXT"}, {"canonical", "TEXT"}, {"source", "TEXT"}, {"checksum", "INTEGER"}}};
  TableForm studies{.name = "studies",
                    .columns = {{"key", "INTEGER"}, {"experiment", "TEXT"}, {"command", "TEXT"}, {"manifest", "TEXT"}}};

  void create(const Database& db) const {
    Transaction transaction(db);
    if (is_empty(db)) {
      for (const ResultTable* table : {&runs, &curves, &timings}) db.execute(table->definition());
      for (const TableForm* form : {&configurations, &scenarios, &studies}) db.execute(form->definition());
      db.execute(fmt::format("PRAGMA application_id={}", application_id));
      db.execute(fmt::format("PRAGMA user_version={}", store_version));
    }
    transaction.commit();
  }
  void check(const Database& db) const {
    check_version(db);
    for (const ResultTable* table : {&runs, &curves, &timings}) table->check(db);
    for (const TableForm* form : {&configurations, &scenarios, &studies}) form->check(db);
  }
};

class Store::Writer {
 public:
  Writer(const Database& db, const Tables& tables)
      : metrics_(tables.metrics),
        runs_(db, tables.runs),
        new_run_(db, tables.runs.insertion("IGNORE")),
        curves_(db, tables.curves),
        timings_(db, tables.timings),
        configuration_(tables.runs.find(configuration_column)),
        configurations_(db),
        number_(db, "SELECT number FROM runs WHERE id = ?"),
        drop_curves_(db, "DELETE FROM curves WHERE number = ?"),
        last_(db,
              "SELECT max(ifnull((SELECT max(number) FROM runs), 0), ifnull((SELECT max(number) FROM curves), 0), "
              "ifnull((SELECT max(number) FROM timings), 0))") {}

  /// Finds the first number for new runs. Must be called once in a transaction, before write().
  void begin() {
    last_.step();
    next_ = last_.integer(0) + 1;
    last_.reset();
  }

  void write(const RunRecord& record) {
    for (const auto& measured : record.result.further) {
      const std::string& column = measured.first;
      if (std::none_of(metrics_.begin(), metrics_.end(), [&](const Metric& m) { return m.column == column; })) {
        throw std::logic_error("the metric " + column + " is measured, but is not in the table of metrics");
      }
    }
    const std::int64_t id = key_of(record.id);
    std::int64_t number = next_;
    const bool known = new_run_.run(runs_.row.values(number, id, record)) == 0;
    if (known) {
      number = number_of(id);
      runs_.write(number, id, record);
    } else {
      ++next_;
    }
    timings_.write(number, id, record);
    configurations_.keep(runs_.row.integer(configuration_), record.config);
    if (!record.result.series.empty() || !record.result.attitude_errors.empty()) {
      curves_.write(number, id, record);
    } else if (known) {
      const Value parameter = number;
      drop_curves_.run({&parameter, 1});
    }
  }

 private:
  struct Rows {
    Rows(const Database& db, const ResultTable& table) : row(table), insertion(db, table.insertion("REPLACE")) {}
    void write(std::int64_t number, std::int64_t id, const RunRecord& record) {
      insertion.run(row.values(number, id, record));
    }

    RowWriter row;
    Statement insertion;
  };

  /// The number of a run that is there. Where there is none, a damaged row has the next number, and is replaced.
  std::int64_t number_of(std::int64_t id) {
    number_.bind(1, id);
    const std::int64_t number = number_.step() ? number_.integer(0) : next_;
    number_.reset();
    return number;
  }

  std::span<const Metric> metrics_;
  Rows runs_;
  Statement new_run_;  // stores a run, unless one with its id is there
  Rows curves_, timings_;
  std::size_t configuration_;  // column of `runs`
  ConfigurationWriter configurations_;
  Statement number_, drop_curves_, last_;
  std::int64_t next_ = 1;
};

/// A SELECT over the runs with what belongs to them.
class Store::Reader {
 public:
  Reader(const Database& db, const Tables& tables, Curves curves, const std::string& condition)
      : runs_(tables.runs, 2),
        timings_(tables.timings, 2 + runs_.size()),
        configuration_(tables.runs.find(configuration_column)),
        varied_(tables.runs.find(varied_column)),
        has_curves_(tables.runs.find(has_curves)) {
    std::string columns =
        "runs.id, runs.number, " + RowReader::selection(tables.runs) + ", " + RowReader::selection(tables.timings);
    std::string joined = "runs LEFT JOIN timings ON timings.number = runs.number";
    if (curves == Curves::with) {
      curves_.emplace(tables.curves, 2 + runs_.size() + timings_.size());
      columns += ", " + RowReader::selection(tables.curves);
      joined += " LEFT JOIN curves ON curves.number = runs.number";
    }
    select_.emplace(db, "SELECT " + columns + " FROM " + joined + condition);
  }

  Statement& statement() { return *select_; }
  RunKey key() const { return RunKey::of(*select_, 0, 1); }  ///< that of the present row

  /// Reads the result of the run of the present row into a new one. Returns StoredRun::damage.
  std::string read(RunResult& result) {
    const RunKey run = key();
    if (!run.has_id) return std::string(id_damage);
    std::string damage = runs_.read(*select_, run.id, result);
    if (damage.empty()) damage = timings_.read(*select_, run.id, result);
    if (damage.empty() && curves_ && is_integer(runs_.value(has_curves_), 1))
      damage = curves_->read(*select_, run.id, result);
    return damage;
  }

  /// The run of the present row.
  StoredRun read() {
    StoredRun run;
    const RunKey own = key();
    run.id = id_of_key(own.id);
    run.number = own.number;
    run.damage = read(run.result);
    if (run.damage.empty()) {
      run.configuration = std::get<std::int64_t>(runs_.value(configuration_));
      run.varied = std::get<std::string_view>(runs_.value(varied_));
    }
    return run;
  }

 private:
  RowReader runs_, timings_;
  std::optional<RowReader> curves_;
  std::size_t configuration_, varied_, has_curves_;  // columns of `runs`
  std::optional<Statement> select_;
};

Store::Store(const std::filesystem::path& folder, std::span<const Metric> metrics, Access access,
             std::optional<Journal> journal)
    : journal_(journal ? *journal : journal_of(folder)),
      db_(folder / file_name, access, journal_),
      tables_(std::make_unique<const Tables>(metrics)) {
  if (access == Access::create && is_empty(db_)) tables_->create(db_);
  tables_->check(db_);
}

Store::~Store() = default;

Store::Reading::Reading(const Store& store) : store_(store) {
  auto& reader = store_.from_number_;
  if (!reader) {
    reader =
        std::make_unique<Reader>(store_.db_, *store_.tables_, Curves::without,
                                 " WHERE runs.number >= (SELECT number FROM runs WHERE id = ?) ORDER BY runs.number");
  }
  store_.db_.execute("BEGIN");
}

Store::Reading::~Reading() {
  store_.from_number_->statement().reset();
  sqlite3_exec(store_.db_.handle(), "COMMIT", nullptr, nullptr, nullptr);
}

std::optional<std::string> Store::Reading::find(std::uint64_t id, RunResult& result) {
  Reader& reader = *store_.from_number_;
  Statement& rows = reader.statement();
  const auto key = static_cast<std::int64_t>(id);
  if (!in_order_ || !rows.step() || reader.key().id != key) {
    rows.reset();
    rows.bind(1, key);
    if (!rows.step()) return std::nullopt;
  }
  const std::int64_t number = reader.key().number;
  in_order_ = number == std::exchange(number_, number) + 1;
  return reader.read(result);
}

void Store::for_each(Curves curves, const std::function<void(StoredRun&&)>& use) const {
  Reader reader(db_, *tables_, curves, " ORDER BY runs.number");
  while (reader.statement().step()) use(reader.read());
}

std::optional<StoredRun> Store::find(const std::string& id, Curves curves) const {
  auto& reader = curves == Curves::with ? finder_of_curves_ : finder_;
  if (!reader) reader = std::make_unique<Reader>(db_, *tables_, curves, " WHERE runs.id = ?");
  Statement& select = reader->statement();
  select.reset();
  select.bind(1, key_of(id));
  std::optional<StoredRun> run;
  if (select.step()) run = reader->read();
  select.reset();
  return run;
}

std::vector<std::uint64_t> Store::ids() const { return all_ids(db_); }

std::vector<std::int64_t> Store::rows_without_id() const {
  std::vector<std::int64_t> numbers;
  Statement rows(db_, "SELECT number FROM runs WHERE typeof(id) <> 'integer' ORDER BY number");
  while (rows.step()) numbers.push_back(rows.integer(0));
  return numbers;
}

std::vector<std::string> Store::ids_with(const std::string& beginning) const {
  const std::string first = beginning + std::string(16 - std::min<std::size_t>(beginning.size(), 16), '0');
  const std::string last = beginning + std::string(16 - std::min<std::size_t>(beginning.size(), 16), 'f');
  std::vector<std::string> ids;
  // All of them have the same first digit, so that their order as integers with sign is that of their digits.
  Statement rows(db_, "SELECT id FROM runs WHERE id BETWEEN ? AND ? AND typeof(id) = 'integer' ORDER BY id");
  rows.bind(1, key_of(first));
  rows.bind(2, key_of(last));
  while (rows.step()) ids.push_back(id_of_key(rows.integer(0)));
  return ids;
}

void Store::forget(std::span<const std::int64_t> numbers) {
  Transaction transaction(db_);
  for (const char* table : {"curves", "timings", "runs"}) {
    Statement deletion(db_, fmt::format("DELETE FROM {} WHERE number = ?", table));
    for (const Value number : numbers) deletion.run({&number, 1});
  }
  transaction.commit();
}

void Store::settle() const {
  if (journal_ == Journal::write_ahead)
    Database(db_.path(), Access::write, journal_).execute("PRAGMA wal_checkpoint(PASSIVE)");
}

Store::Keeping::Keeping(Store& store) : store_(store), transaction_(std::make_unique<Transaction>(store.db_)) {
  if (!store_.writer_) store_.writer_ = std::make_unique<Writer>(store_.db_, *store_.tables_);
  store_.writer_->begin();
}

Store::Keeping::~Keeping() {
  if (transaction_) store_.writer_.reset();  // it takes configurations and columns for stored that are rolled back
}

void Store::Keeping::add(std::span<const RunRecord> records) {
  for (const RunRecord& record : records) store_.writer_->write(record);
}

void Store::Keeping::commit() {
  transaction_->commit();
  transaction_.reset();
}

void Store::keep(std::span<const RunRecord> records) {
  Keeping keeping(*this);
  keeping.add(records);
  keeping.commit();
}

std::map<std::int64_t, Configuration> Store::configurations() const { return read_configurations(db_); }
std::unordered_set<std::int64_t> Store::configuration_keys() const { return store::configuration_keys(db_); }

void Store::keep_scenarios(std::span<const Scenario> scenarios) {
  Transaction transaction(db_);
  Statement insertion(db_, "INSERT OR REPLACE INTO scenarios (name, canonical, source, checksum) VALUES (?,?,?,?)");
  for (const Scenario& scenario : scenarios) {
    const std::string_view source = scenario.source ? std::string_view(*scenario.source) : std::string_view();
    const std::string canonical = scenario.canonical();
    Value row[] = {std::string_view(scenario.name), std::string_view(canonical), source, {}};
    row[3] = checksum_of(0, std::span(row).first(3));
    insertion.run(row);
  }
  transaction.commit();
}

std::map<std::string, StoredScenario> Store::scenarios() const {
  std::map<std::string, StoredScenario> all;
  Statement rows(db_, "SELECT name, canonical, source, checksum FROM scenarios");
  while (rows.step()) {
    const Value row[] = {rows.value(0), rows.value(1), rows.value(2)};
    const auto texts = texts_of(row);
    if (texts && is_integer(rows.value(3), checksum_of(0, row))) all[(*texts)[0]] = {(*texts)[1], (*texts)[2]};
  }
  return all;
}

std::vector<StoredStudy> Store::studies() const {
  std::vector<StoredStudy> all;
  Statement rows(db_, "SELECT experiment, command, manifest, key FROM studies ORDER BY experiment, command, key");
  while (rows.step()) {
    const Value row[] = {rows.value(0), rows.value(1), rows.value(2)};
    const auto texts = texts_of(row);
    if (texts && is_integer(rows.value(3), checksum_of(0, row))) all.push_back({(*texts)[0], (*texts)[1], (*texts)[2]});
  }
  return all;
}

void Store::keep_study(const std::string& experiment, const std::string& command, const std::string& manifest) {
  const Value texts[] = {std::string_view(experiment), std::string_view(command), std::string_view(manifest)};
  const Value row[] = {checksum_of(0, texts), texts[0], texts[1], texts[2]};
  Transaction transaction(db_);
  Statement(db_, "INSERT OR REPLACE INTO studies (key, experiment, command, manifest) VALUES (?,?,?,?)").run(row);
  transaction.commit();
}

std::vector<std::uint64_t> Store::ids_in(const std::filesystem::path& folder, std::span<const Metric> metrics) {
  const std::filesystem::path path = folder / file_name;
  if (!std::filesystem::exists(path)) return {};
  const Database db(path, Access::look, journal_of(folder));
  Statement whole(db, "PRAGMA integrity_check(1)");
  const Value said = whole.step() ? whole.value(0) : Value();
  const auto* text = std::get_if<std::string_view>(&said);
  if (!text || *text != "ok") throw std::runtime_error(path.string() + ": the database is damaged");
  if (is_empty(db)) return {};  // a program was killed just after it had made the file
  Tables(metrics).check(db);
  return all_ids(db);
}

bool Store::is_unbegun(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / file_name;
  return std::filesystem::exists(path) && is_empty(Database(path, Access::read, journal_of(folder)));
}

std::size_t Store::longest_folder() {
  // SQLite appends suffixes to the file name, the longest of which is "-journal".
  return static_cast<std::size_t>(sqlite3_vfs_find(nullptr)->mxPathname) - std::strlen("/-journal") -
         std::strlen(file_name);
}

}  // namespace polhode::study::store
