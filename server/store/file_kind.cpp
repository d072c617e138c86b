#include "server/store/file_kind.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <utility>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr std::string_view sqlite_magic("SQLite format 3\0", 16);

/// SQLite reads the missing end of a last page as zeros. After a crash, the log beside the file has that end.
Result<void> check_whole_pages(const std::string& path, const std::string& start) {
  CHECK(start.size() >= sqlite_magic.size() + 2);
  const auto byte = [&](size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(start[at])); };
  const unsigned stored = (byte(16) << 8U) | byte(17);  // SQLite file format, 1.3.2
  const unsigned page_bytes = stored == 1 ? 65536 : stored;
  std::error_code error;
  const uint64_t bytes = std::filesystem::file_size(path, error);
  if (page_bytes != 0 && bytes % page_bytes == 0) return {};
  if (std::filesystem::exists(path + "-wal", error)) return {};
  return fail(fmt::format("{}: damaged or cut short: {} bytes are no whole pages", path, bytes));
}

/// The first bytes of a file that has as many (SQLite file format, 1.3).
std::optional<std::string> sqlite_header(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;  // a pipe would be waited for
  constexpr size_t header_bytes = 100;
  std::string start(header_bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return file ? std::optional(std::move(start)) : std::nullopt;
}

int64_t application_id(const std::string& header) {
  constexpr size_t id_at = 68;  // SQLite file format, 1.3
  int64_t id = 0;
  for (size_t i = 0; i < 4; ++i)
    id = id * 256 + static_cast<int64_t>(static_cast<unsigned char>(header[id_at + i]));
  return id;
}

/// Refuses what no program of ours makes in such a file.
Result<void> check_schema(Database& database, const FileKind& kind) {
  const auto is_ours = [&kind](const std::string& name, const std::string& sql) {
    return sql == kind.index || std::ranges::any_of(kind.columns, [&](std::string_view columns) {
             return !columns.empty() && sql == fmt::format("CREATE TABLE {}{}", name, columns);
           });
  };
  return database.each_text(
      "SELECT type, name, sql FROM sqlite_master WHERE sql IS NOT NULL AND name <> 'sqlite_stat1'",
      [&](std::span<const std::string> row) -> Result<void> {
        if (is_ours(row[1], row[2])) return {};
        return fail(fmt::format(
            "{} has a {} \"{}\" that no {} has. It may do harm when the file is read, so the file is "
            "not used: remove it (sqlite3), or take a copy from somebody whom you trust",
            database.path(), row[0], row[1], kind.noun));
      });
}

}  // namespace

Result<void> check_file(const std::string& path, const FileKind& kind) {
  const std::string is_none = fmt::format("{} is no {}: ", path, kind.noun);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return fail(path + ": there is no such file");
  if (!std::filesystem::is_regular_file(path, error)) return fail(path + " is not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(path + " cannot be read: check its permissions");
  std::string start(sqlite_magic.size() + 2, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (static_cast<size_t>(file.gcount()) < start.size())
    return fail(fmt::format("{}it has only {} bytes", is_none, file.gcount()));
  if (!start.starts_with(sqlite_magic)) return fail(is_none + "it is not an SQLite file");
  return check_whole_pages(path, start);
}

bool lacks_log(const std::string& path, const FileKind& kind) {
  std::error_code error;
  const auto start = sqlite_header(path);
  if (!start) return false;
  const int64_t id = application_id(*start);
  const bool another = id != 0 && id != kind.application_id;  // 0: it says so in its log yet
  constexpr char by_log = 2;                                  // SQLite file format, 1.3.3
  return !another && (*start)[18] == by_log && (*start)[19] == by_log &&
         !std::filesystem::exists(path + "-wal", error);
}

bool is_foreign(const std::string& path, const FileKind& kind) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return false;
  if (!std::filesystem::is_regular_file(path, error)) return true;
  const auto start = sqlite_header(path);
  if (!start) return std::filesystem::file_size(path, error) > 0;
  const int64_t id = application_id(*start);
  return !start->starts_with(sqlite_magic) || (id != 0 && id != kind.application_id);
}

std::string missing_log_hint(const std::string& path) {
  return fmt::format(
      "; it is a file that was being written, and its log {}-wal is missing: copy that, too, or the file "
      "after its program has ended",
      path);
}

Result<void> check_format(Database& database, const FileKind& kind) {
  const auto id = TRY(database.number("PRAGMA application_id"));
  const std::string noun(kind.noun);
  if (id.value_or(0) != kind.application_id)
    return fail(fmt::format("{} is no {}: it is an SQLite file of another program", database.path(), noun));
  const auto format = database.number("PRAGMA user_version");
  TRY(format);
  if (format->value_or(0) < kind.oldest || format->value_or(0) > kind.format)
    return fail(fmt::format("{} is a {} of format {}; this program reads formats {} to {}: {}",
                            database.path(), noun, format->value_or(0), kind.oldest, kind.format,
                            kind.way_out));
  return check_schema(database, kind);
}

Result<void> check_pages(Database& database) {
  const auto check = TRY(database.text("PRAGMA quick_check(1)"));
  if (check != "ok") return fail(fmt::format("{}: damaged or cut short: {}", database.path(), check));
  return {};
}

}  // namespace scree
