// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/database.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "experiments/study/store/folder_lock.hpp"

namespace polhode::study::inline store {
namespace {

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

/// Throws std::runtime_error for a pipe, a socket or a device: reading it may never end.
void refuse_special_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_other(path, ignored)) throw std::runtime_error(path.string() + ": is no regular file");
}

/// True if the file is in WAL mode, all of its content is in the file itself, and the folder takes no file: SQLite then
/// cannot make the shared memory that it reads such a file with.
bool is_frozen(const std::filesystem::path& path) {
  if (access(path.parent_path().c_str(), W_OK) == 0 || std::filesystem::exists(path.string() + "-wal")) return false;
  char header[20] = {};
  std::ifstream(path, std::ios::binary).read(header, sizeof header);
  return header[18] == 2;  // version of the file format that a writer needs: 2 is WAL (sqlite.org/fileformat2.html)
}

/// True if all of the content is in the file itself: no writer is at work, and none was killed. With a rollback journal
/// a writer is not seen between its transactions.
bool is_at_rest(const std::filesystem::path& path, Journal journal) {
  return journal == Journal::write_ahead && !std::filesystem::exists(path.string() + "-wal") &&
         !std::filesystem::exists(path.string() + "-journal");
}

/// The path as a URI, so that it can be opened as a file that does not change.
std::string immutable_uri(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '%') uri += "%25";
    else if (c == '?') uri += "%3f";
    else if (c == '#') uri += "%23";
    else uri += c;
  }
  return uri + "?immutable=1";
}

}  // namespace

void Database::Close::operator()(sqlite3* db) const { sqlite3_close(db); }

Database::Database(std::filesystem::path path, Access access, Journal journal) : path_(std::move(path)) {
  [[maybe_unused]] static const int filled = [] {
    sqlite3_vfs* vfs = sqlite3_vfs_find(nullptr);
    return vfs->xSetSystemCall(vfs, "mmap", reinterpret_cast<sqlite3_syscall_ptr>(map_filled));
  }();
  refuse_special_file(path_);
  bool unchanged = access == Access::read && is_frozen(path_);
  if (access == Access::look) {
    unchanged = is_at_rest(path_, journal);
    access = unchanged ? Access::read : Access::write;
  }
  int flags = SQLITE_OPEN_NOMUTEX;  // one thread at a time uses a connection
  flags |= access == Access::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE;
  if (access == Access::create) flags |= SQLITE_OPEN_CREATE;
  std::string name = path_.string();
  if (unchanged) {
    name = immutable_uri(path_);
    flags |= SQLITE_OPEN_URI;
  }
  sqlite3* db = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &db, flags, nullptr);
  db_.reset(db);
  if (code != SQLITE_OK) fail();
  sqlite3_busy_timeout(db, patience_ms);
  execute("PRAGMA page_size=8192");           // of a new file, bytes: each page is written and read by calls of its own
  execute("PRAGMA cache_size=-32768");        // KiB: the index of a million ids
  execute("PRAGMA wal_autocheckpoint=8192");  // pages, 64 MiB: a page that changes often is copied less often
  if (access != Access::read) set_journal(journal);
}

void Database::set_journal(Journal journal) {
  const auto set = [&](const std::string& mode) {
    Statement pragma(*this, "PRAGMA journal_mode=" + mode);
    const Value now = pragma.step() ? pragma.value(0) : Value();
    const auto* text = std::get_if<std::string_view>(&now);
    return text && *text == mode;
  };
  if (journal == Journal::write_ahead && set("wal")) {
    // A commit survives a crash of the process without waiting for the disk; SQLite syncs to disk at checkpoints only.
    execute("PRAGMA synchronous=NORMAL");
    return;
  }
  // With this lock SQLite reads a file in WAL mode, as it was left on another file system, without shared memory.
  if (journal == Journal::rollback) execute("PRAGMA locking_mode=EXCLUSIVE");
  if (!set("delete")) {
    throw std::runtime_error(path_.string() +
                             ": cannot leave the mode of write-ahead logging: " + sqlite3_errmsg(handle()));
  }
  execute("PRAGMA synchronous=FULL");
}

void Database::fail() const {
  if (!db_) throw std::runtime_error(path_.string() + ": out of memory");
  std::string why = sqlite3_errmsg(db_.get());
  const int code = sqlite3_errcode(db_.get()), reason = sqlite3_system_errno(db_.get());
  if (reason != 0) why += std::string(": ") + std::strerror(reason);
  if (code == SQLITE_BUSY) why += FolderLock::holder(path_.parent_path());
  const bool input_or_output = code == SQLITE_IOERR || code == SQLITE_CANTOPEN;
  if (code == SQLITE_FULL || (input_or_output && (reason == ENOSPC || reason == EDQUOT)))
    throw DiskFull(path_.string() + ": " + why);
  throw std::runtime_error(path_.string() + ": " + why);
}

void Database::execute(const std::string& sql) const {
  if (sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::int64_t Database::number(const std::string& sql) const {
  Statement statement(*this, sql);
  if (!statement.step()) throw std::runtime_error(path_.string() + ": the database is damaged");
  return statement.integer(0);
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Statement::Statement(const Database& db, const std::string& sql) : db_(&db) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(db.handle(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) db.fail();
  statement_.reset(statement);
  is_null_.assign(static_cast<std::size_t>(sqlite3_bind_parameter_count(statement)), true);
}

void Statement::bind(int parameter, const Value& value) {
  // Most parameters of a row of results are NULL in all rows.
  const bool null = std::holds_alternative<std::monostate>(value);
  const auto place = static_cast<std::size_t>(parameter - 1);
  if (null && is_null_.at(place)) return;
  is_null_.at(place) = null;
  sqlite3_stmt* s = statement_.get();
  const auto set = [&]<class T>(const T& v) {
    if constexpr (std::is_same_v<T, std::monostate>) {
      return sqlite3_bind_null(s, parameter);
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      return sqlite3_bind_int64(s, parameter, v);
    } else if constexpr (std::is_same_v<T, double>) {
      return sqlite3_bind_double(s, parameter, v);
    } else if constexpr (std::is_same_v<T, std::string_view>) {
      return sqlite3_bind_text64(s, parameter, v.data() ? v.data() : "", v.size(), SQLITE_STATIC, SQLITE_UTF8);
    } else {
      return sqlite3_bind_blob64(s, parameter, v.data() ? static_cast<const void*>(v.data()) : "", v.size(),
                                 SQLITE_STATIC);
    }
  };
  if (std::visit(set, value) != SQLITE_OK) db_->fail();
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW || code == SQLITE_DONE) return code == SQLITE_ROW;
  try {
    db_->fail();
  } catch (...) {
    reset();  // so that it does not hinder a rollback
    throw;
  }
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

int Statement::run(std::span<const Value> parameters) {
  for (std::size_t k = 0; k < parameters.size(); ++k) bind(static_cast<int>(k) + 1, parameters[k]);
  while (step()) {
  }
  reset();
  return sqlite3_changes(db_->handle());
}

Value Statement::value(int column) const {
  // Without mutexes this value may be read as any other (sqlite.org/c3ref/value.html), and is looked up once.
  sqlite3_value* v = sqlite3_column_value(statement_.get(), column);
  const auto size = [&] { return static_cast<std::size_t>(sqlite3_value_bytes(v)); };
  switch (sqlite3_value_type(v)) {
    case SQLITE_INTEGER: return static_cast<std::int64_t>(sqlite3_value_int64(v));
    case SQLITE_FLOAT: return sqlite3_value_double(v);
    case SQLITE_TEXT: {
      const auto* bytes = reinterpret_cast<const char*>(sqlite3_value_text(v));
      return std::string_view(bytes, size());
    }
    case SQLITE_BLOB: {
      const auto* bytes = static_cast<const std::byte*>(sqlite3_value_blob(v));
      return Blob(bytes, size());
    }
    default: return std::monostate();
  }
}

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }

std::string Statement::name(int column) const { return sqlite3_column_name(statement_.get(), column); }

std::int64_t Statement::integer(int column) const {
  const Value found = value(column);
  const auto* number = std::get_if<std::int64_t>(&found);
  if (!number) throw std::runtime_error(db_->path().string() + ": the database is damaged");
  return *number;
}

std::string quoted_name(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace polhode::study::store
