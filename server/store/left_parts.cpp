#include "server/store/left_parts.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>

#include "server/store/database.h"
#include "server/store/recording_parts.h"
#include "server/store/schema.h"
#include "server/store/store_fault.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// How long a part waits for another program that reads it: ticks wait meanwhile.
constexpr std::chrono::milliseconds reader_patience{100};

bool is_there(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// Refused while anybody else has the file open, so that no other server's recording is ended here.
Result<void> close_part(const std::string& part) {
  std::error_code error;
  // SQLite takes the log of a file without pages for an old one, and removes it.
  if (std::filesystem::file_size(part, error) == 0 || error) return fail(part + ": it has no bytes");
  auto database = TRY(Database::open(part));
  database.wait_at_most(reader_patience);
  TRY(check_format(database, schema::recording));
  return database.execute("PRAGMA journal_mode = DELETE");
}

std::string line_of_left(const std::string& part, const Result<void>& closed) {
  if (!is_there(part))
    return fmt::format(
        "{0}-wal is left: it is the log of {0}, which was moved or removed. Put it beside that file, by the "
        "same name, before you play it",
        part);
  return fmt::format("{0}-wal is left, and has the last ticks of {0}: copy both{1}", part,
                     closed ? std::string() : fmt::format(" ({})", closed.error().message));
}

}  // namespace

void LeftParts::add(const std::string& part) {
  forget(part);
  parts_.push_back(part);
}

void LeftParts::find() {
  for (const std::string& part : recording_parts(family_))
    if (is_there(part + "-wal") && !is_foreign(part, schema::recording)) add(part);
}

void LeftParts::forget(const std::string& part) {
  std::erase(parts_, part);
}

void LeftParts::close() {
  std::erase_if(parts_, [](const std::string& part) {
    const bool is_gone = !is_there(part) && !is_there(part + "-wal");
    return is_gone || is_foreign(part, schema::recording) || close_part(part).has_value();
  });
}

std::vector<std::string> LeftParts::close_all(double until_s) {
  find();
  std::vector<std::string> lines;
  for (const std::string& part : parts_) {
    Result<void> closed;
    if (steady_now_s() <= until_s && is_there(part)) closed = close_part(part);
    if (is_there(part + "-wal")) lines.push_back(line_of_left(part, closed));
  }
  return lines;
}

}  // namespace scree
