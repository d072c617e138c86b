// A thin wrapper of SQLite: blobs by a number, each with a checksum, and errors that name the file. Internal
// to server/store and server/history. One thread at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace scree {

struct DatabaseCloser {
  void operator()(sqlite3* database) const;
};
struct StatementCloser {
  void operator()(sqlite3_stmt* statement) const;
};
using Statement = std::unique_ptr<sqlite3_stmt, StatementCloser>;

class Database {
 public:
  /// Creates a file. An error if it exists.
  static Result<Database> create(const std::string& path);
  /// Opens an existing file, without reading its content. Its triggers and views do not act.
  static Result<Database> open(const std::string& path);

  /// `fails`: what to say of the file when it fails, before the reason.
  Result<void> execute(const std::string& sql, std::string_view fails = "cannot be written");
  /// The first column of the first row; nothing when there is no row or it is null.
  Result<std::optional<int64_t>> number(const std::string& sql);
  /// The first column of the first row as text; no row is an error.
  Result<std::string> text(const std::string& sql);

  Result<bool> has_table(const std::string& table);

  Result<Statement> prepare(const std::string& sql);
  /// Runs an insert with the parameters (key, data, checksum). The key is a tick, or what the table is
  /// ordered by.
  Result<void> put(const Statement& insert, uint64_t key, std::span<const uint8_t> data);
  /// The same with the parameters (keys …, data, checksum).
  Result<void> put(const Statement& insert, std::span<const int64_t> keys, std::span<const uint8_t> data);
  /// Runs a statement with the parameter (key).
  Result<void> run(const Statement& statement, uint64_t key);
  /// The same with the parameters (numbers …).
  Result<void> run(const Statement& statement, std::span<const int64_t> numbers);
  /// Calls `visit(key, data, whole)` for each row of a select of (key, data, checksum); `whole`: the data
  /// matches its checksum. Ends at the first error, also one of `visit`.
  using RowVisitor = std::function<Result<void>(uint64_t key, std::span<const uint8_t> data, bool whole)>;
  Result<void> each(const std::string& select, const RowVisitor& visit);
  /// The same with the parameter (key).
  Result<void> each(const std::string& select, uint64_t key, const RowVisitor& visit);
  /// Calls `visit` with the columns of each row, which are whole numbers; ends at its first error.
  using NumbersVisitor = std::function<Result<void>(std::span<const int64_t> columns)>;
  Result<void> each_number(const std::string& select, const NumbersVisitor& visit);
  /// The same with columns of text.
  using TextVisitor = std::function<Result<void>(std::span<const std::string> columns)>;
  Result<void> each_text(const std::string& select, const TextVisitor& visit);
  /// Copies the whole database, as of one moment, into a new file. By a `pace` in parts of so many pages:
  /// after each one it calls `go_on`, which may wait; false gives the copy up. Who saves meanwhile does not
  /// begin it anew, where the file has a log (WAL).
  struct CopyPace {
    int pages = -1;                    ///< negative: all at once
    std::function<bool()> go_on = {};  ///< empty: true
  };
  Result<void> copy_to(const std::string& path, const CopyPace& pace);
  Result<void> copy_to(const std::string& path) { return copy_to(path, CopyPace{}); }
  /// How long calls wait for another program that holds the file.
  void wait_at_most(std::chrono::milliseconds time);
  /// Whether an error of a database says that the system refused, as on a full disk: nothing of the file.
  static bool is_refusal(const Error& error);
  /// The same, and all else that may pass by itself (store_fault.h): another program that holds the file, a
  /// failing disk, a file that may not be written just now, or that was moved.
  static bool may_pass(const Error& error);
  /// Whether an error says that another program holds the file.
  static bool is_held(const Error& error);
  /// Whether the file is not there any more under its name.
  bool has_moved() const;
  /// Runs a select with the parameter (tick) and the columns (data, checksum). Data that does not match its
  /// checksum is an error. Nothing when there is no row.
  Result<std::optional<std::vector<uint8_t>>> get(const Statement& select, uint64_t tick);

  const std::string& path() const { return path_; }

 private:
  Result<void> each_of(const Statement& prepared, const RowVisitor& visit);
  Database(std::string path, sqlite3* database) : path_(std::move(path)), database_(database) {}
  tl::unexpected<Error> failure(const std::string& what) const;

  std::string path_;
  std::unique_ptr<sqlite3, DatabaseCloser> database_;
};

}  // namespace scree
