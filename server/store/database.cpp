#include "server/store/database.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <xxhash.h>

#include "server/store/limits.h"
#include "server/store/store_fault.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Time that one program waits for another one that has the file open, ms.
constexpr int busy_timeout_ms = 2000;

int64_t checksum_of(std::span<const uint8_t> data) {
  return static_cast<int64_t>(XXH3_64bits(data.data(), data.size()));
}

/// What the system said to the call that failed last, if it is one of the reasons that somebody can act on:
/// SQLite's own code does not say. 0: another.
int refused_by_system(sqlite3* database) {
  const int now = errno;  // SQLite keeps it for some calls alone
  for (const int refused : {sqlite3_system_errno(database), now}) {
    const auto fault = fault_of_system(refused);
    if (fault && row_of(*fault).is_refusal) return refused;
  }
  return 0;
}

std::optional<StoreFault> fault_of_code(int code) {
  switch (code & 0xFF) {  // without what extends it
    case SQLITE_FULL:
      return StoreFault::full;
    case SQLITE_BUSY:
      return StoreFault::held;
    case SQLITE_READONLY:
      return code == SQLITE_READONLY_DBMOVED ? StoreFault::moved : StoreFault::read_only;
    case SQLITE_CANTOPEN:
      return StoreFault::closed;
    case SQLITE_IOERR:
      return StoreFault::fails;
    default:
      return std::nullopt;
  }
}

/// What SQLite advises for files of strangers (sqlite.org/security.html): what the file brings of SQL does
/// not run.
void distrust(sqlite3* database) {
  constexpr std::array<std::pair<int, int>, 4> options{{{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                                        {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                                        {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                                        {SQLITE_DBCONFIG_ENABLE_VIEW, 0}}};
  for (const auto& [option, value] : options) {
    int now = -1;
    CHECK_EQ(sqlite3_db_config(database, option, value, &now), SQLITE_OK);
    CHECK_EQ(now, value);
  }
}

}  // namespace

void DatabaseCloser::operator()(sqlite3* database) const {
  sqlite3_close_v2(database);
}
void StatementCloser::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

/// The reason in words for people; what is none of the system's or of other programs' is SQLite's.
tl::unexpected<Error> Database::failure(const std::string& what) const {
  const int code = sqlite3_errcode(database_.get());
  const std::string own = sqlite3_errmsg(database_.get());
  auto fault = fault_of_code(code);
  int refused = 0;
  if (fault == StoreFault::fails) refused = refused_by_system(database_.get());
  if (fault == StoreFault::closed) refused = sqlite3_system_errno(database_.get());
  if (fault == StoreFault::read_only && has_moved()) fault = StoreFault::moved;
  if (const auto known = fault_of_system(refused)) fault = known;
  return fail(fmt::format("{}: {}: {}", path_, what, fault ? words_of(fault, refused) : own));
}

Result<Database> Database::create(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored))
    return fail(path + " exists already: choose another name, or move it away");
  // SQLite does not say why the system refused a file that it makes itself.
  constexpr mode_t as_sqlite = S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH;
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, as_sqlite);
  if (file < 0) {
    const int refused = errno;
    return fail(fmt::format("{}: cannot be created: {}", path, words_of(fault_of_system(refused), refused)));
  }
  ::close(file);
  sqlite3* raw = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_EXRESCODE;
  const int code = sqlite3_open_v2(path.c_str(), &raw, flags, nullptr);
  Database database(path, raw);
  if (code != SQLITE_OK) return database.failure("cannot be created");
  sqlite3_busy_timeout(raw, busy_timeout_ms);
  return database;
}

Result<Database> Database::open(const std::string& path) {
  sqlite3* raw = nullptr;
  // A crash leaves a log beside the file. Only a process that may write can merge it; others read it in
  // place.
  int code = sqlite3_open_v2(path.c_str(), &raw, SQLITE_OPEN_READWRITE | SQLITE_OPEN_EXRESCODE, nullptr);
  if (code != SQLITE_OK) {
    sqlite3_close_v2(raw);
    code = sqlite3_open_v2(path.c_str(), &raw, SQLITE_OPEN_READONLY | SQLITE_OPEN_EXRESCODE, nullptr);
  }
  Database database(path, raw);
  if (code != SQLITE_OK) return database.failure("cannot be opened");
  sqlite3_busy_timeout(raw, busy_timeout_ms);
  sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, static_cast<int>(limits::row_bytes_max));
  distrust(raw);
  return database;
}

Result<void> Database::execute(const std::string& sql, std::string_view fails) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    return failure(std::string(fails));
  return {};
}

Result<Statement> Database::prepare(const std::string& sql) {
  sqlite3_stmt* raw = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &raw, nullptr) != SQLITE_OK)
    return failure("cannot be read");
  return Statement(raw);
}

Result<std::optional<int64_t>> Database::number(const std::string& sql) {
  const auto statement = TRY(prepare(sql));
  const int code = sqlite3_step(statement.get());
  if (code == SQLITE_DONE) return std::optional<int64_t>();
  if (code != SQLITE_ROW) return failure("cannot be read");
  if (sqlite3_column_type(statement.get(), 0) == SQLITE_NULL) return std::optional<int64_t>();
  return std::optional<int64_t>(sqlite3_column_int64(statement.get(), 0));
}

Result<bool> Database::has_table(const std::string& table) {
  const auto count =
      number(fmt::format("SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = '{}'", table));
  TRY(count);
  return *count == 1;
}

Result<std::string> Database::text(const std::string& sql) {
  const auto statement = TRY(prepare(sql));
  if (sqlite3_step(statement.get()) != SQLITE_ROW) return failure("cannot be read");
  const auto* value = reinterpret_cast<const char*>(sqlite3_column_text(statement.get(), 0));
  return std::string(value == nullptr ? "" : value);
}

Result<void> Database::put(const Statement& insert, uint64_t tick, std::span<const uint8_t> data) {
  const auto key = static_cast<int64_t>(tick);
  return put(insert, {&key, 1}, data);
}

Result<void> Database::put(const Statement& insert, std::span<const int64_t> keys,
                           std::span<const uint8_t> data) {
  sqlite3_stmt* statement = insert.get();
  CHECK_EQ(static_cast<size_t>(sqlite3_bind_parameter_count(statement)), keys.size() + 2);
  CHECK(sqlite3_stmt_busy(statement) == 0);
  sqlite3_reset(statement);
  int at = 0;
  for (const int64_t key : keys) sqlite3_bind_int64(statement, ++at, key);
  // Without a pointer it would be null, and no blob.
  static constexpr uint8_t nothing = 0;
  sqlite3_bind_blob64(statement, ++at, data.empty() ? &nothing : data.data(), data.size(), SQLITE_STATIC);
  sqlite3_bind_int64(statement, ++at, checksum_of(data));
  const int code = sqlite3_step(statement);
  sqlite3_reset(statement);
  sqlite3_clear_bindings(statement);
  if (code != SQLITE_DONE) return failure("cannot be written");
  return {};
}

Result<void> Database::run(const Statement& prepared, uint64_t key) {
  const auto number = static_cast<int64_t>(key);
  return run(prepared, {&number, 1});
}

Result<void> Database::run(const Statement& prepared, std::span<const int64_t> numbers) {
  sqlite3_stmt* statement = prepared.get();
  CHECK_EQ(static_cast<size_t>(sqlite3_bind_parameter_count(statement)), numbers.size());
  sqlite3_reset(statement);
  int at = 0;
  for (const int64_t number : numbers) sqlite3_bind_int64(statement, ++at, number);
  const int code = sqlite3_step(statement);
  sqlite3_reset(statement);
  if (code != SQLITE_DONE) return failure("cannot be written");
  return {};
}

Result<void> Database::each(const std::string& select, const RowVisitor& visit) {
  const auto prepared = TRY(prepare(select));
  return each_of(prepared, visit);
}

Result<void> Database::each(const std::string& select, uint64_t key, const RowVisitor& visit) {
  const auto prepared = TRY(prepare(select));
  sqlite3_bind_int64(prepared.get(), 1, static_cast<int64_t>(key));
  return each_of(prepared, visit);
}

Result<void> Database::each_of(const Statement& prepared, const RowVisitor& visit) {
  sqlite3_stmt* statement = prepared.get();
  CHECK_EQ(sqlite3_column_count(statement), 3);
  for (;;) {
    const int code = sqlite3_step(statement);
    if (code == SQLITE_DONE) return {};
    if (code != SQLITE_ROW) return failure("cannot be read");
    const auto* data = static_cast<const uint8_t*>(sqlite3_column_blob(statement, 1));
    const std::span<const uint8_t> bytes(data, static_cast<size_t>(sqlite3_column_bytes(statement, 1)));
    const bool whole = sqlite3_column_int64(statement, 2) == checksum_of(bytes);
    if (Result<void> taken = visit(static_cast<uint64_t>(sqlite3_column_int64(statement, 0)), bytes, whole);
        !taken)
      return taken;
  }
}

Result<void> Database::each_number(const std::string& select, const NumbersVisitor& visit) {
  const auto prepared = TRY(prepare(select));
  std::vector<int64_t> columns(static_cast<size_t>(sqlite3_column_count(prepared.get())));
  for (;;) {
    const int code = sqlite3_step(prepared.get());
    if (code == SQLITE_DONE) return {};
    if (code != SQLITE_ROW) return failure("cannot be read");
    for (size_t i = 0; i < columns.size(); ++i)
      columns[i] = sqlite3_column_int64(prepared.get(), static_cast<int>(i));
    TRY(visit(columns));
  }
}

Result<void> Database::each_text(const std::string& select, const TextVisitor& visit) {
  const auto prepared = TRY(prepare(select));
  std::vector<std::string> columns(static_cast<size_t>(sqlite3_column_count(prepared.get())));
  for (;;) {
    const int code = sqlite3_step(prepared.get());
    if (code == SQLITE_DONE) return {};
    if (code != SQLITE_ROW) return failure("cannot be read");
    for (size_t i = 0; i < columns.size(); ++i) {
      const auto at = static_cast<int>(i);
      const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(prepared.get(), at));
      columns[i] = text == nullptr ? "" : text;
    }
    TRY(visit(columns));
  }
}

Result<void> Database::copy_to(const std::string& path, const CopyPace& pace) {
  auto to = TRY(create(path));
  sqlite3_backup* backup = sqlite3_backup_init(to.database_.get(), "main", database_.get(), "main");
  if (backup == nullptr) return to.failure("cannot be written");
  bool goes_on = true;
  while (goes_on && sqlite3_backup_step(backup, pace.pages) == SQLITE_OK)
    goes_on = pace.go_on == nullptr || pace.go_on();
  if (sqlite3_backup_finish(backup) != SQLITE_OK) return to.failure("cannot be written");
  if (!goes_on) return fail(fmt::format("{}: the copy was given up", path));
  return {};
}

bool Database::is_refusal(const Error& error) {
  const auto fault = fault_in(error.message);
  return fault && row_of(*fault).is_refusal;
}

bool Database::may_pass(const Error& error) {
  return fault_in(error.message).has_value();
}

bool Database::is_held(const Error& error) {
  return fault_in(error.message) == StoreFault::held;
}

bool Database::has_moved() const {
  int moved = 0;
  const int asked = sqlite3_file_control(database_.get(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
  return asked == SQLITE_OK && moved != 0;
}

void Database::wait_at_most(std::chrono::milliseconds time) {
  sqlite3_busy_timeout(database_.get(), static_cast<int>(time.count()));
}

Result<std::optional<std::vector<uint8_t>>> Database::get(const Statement& select, uint64_t tick) {
  sqlite3_stmt* statement = select.get();
  CHECK_EQ(sqlite3_bind_parameter_count(statement), 1);
  CHECK_EQ(sqlite3_column_count(statement), 2);
  CHECK(sqlite3_stmt_busy(statement) == 0);
  sqlite3_reset(statement);
  sqlite3_bind_int64(statement, 1, static_cast<int64_t>(tick));
  const int code = sqlite3_step(statement);
  if (code != SQLITE_ROW) {
    sqlite3_reset(statement);
    if (code == SQLITE_DONE) return std::optional<std::vector<uint8_t>>();
    return failure(fmt::format("row {} cannot be read", tick));
  }
  const auto* data = static_cast<const uint8_t*>(sqlite3_column_blob(statement, 0));
  const auto size = static_cast<size_t>(sqlite3_column_bytes(statement, 0));
  std::vector<uint8_t> bytes(data, data + size);
  const int64_t checksum = sqlite3_column_int64(statement, 1);
  sqlite3_reset(statement);
  if (checksum != checksum_of(bytes))
    return fail(fmt::format("{}: damaged: row {} is not what was written", path_, tick));
  return std::optional(std::move(bytes));
}

}  // namespace scree
