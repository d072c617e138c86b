// A thin wrapper of SQLite: blobs by tick, each with a checksum, and errors that name the file. Internal to
// server/store. One thread at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
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
  /// Opens an existing file, without reading its content.
  static Result<Database> open(const std::string& path);

  Result<void> execute(const std::string& sql);
  /// The first column of the first row; nothing when there is no row or it is null.
  Result<std::optional<int64_t>> number(const std::string& sql);
  /// The first column of the first row as text; no row is an error.
  Result<std::string> text(const std::string& sql);

  Result<Statement> prepare(const std::string& sql);
  /// Runs an insert with the parameters (tick, data, checksum).
  Result<void> put(const Statement& insert, uint64_t tick, std::span<const uint8_t> data);
  /// Runs a select with the parameter (tick) and the columns (data, checksum). Data that does not match its
  /// checksum is an error. Nothing when there is no row.
  Result<std::optional<std::vector<uint8_t>>> get(const Statement& select, uint64_t tick);

  const std::string& path() const { return path_; }

 private:
  Database(std::string path, sqlite3* database) : path_(std::move(path)), database_(database) {}
  tl::unexpected<Error> failure(const std::string& what) const;

  std::string path_;
  std::unique_ptr<sqlite3, DatabaseCloser> database_;
};

}  // namespace scree
