// Tells the kinds of our SQLite files apart, from foreign files, and from those of other releases.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/store/database.h"

namespace scree {

struct FileKind {
  std::string_view noun;       ///< "recording"
  int64_t application_id = 0;  ///< PRAGMA application_id
  int64_t format = 0;          ///< PRAGMA user_version
  int64_t oldest = 0;          ///< format that is read as well, as all between
  std::string_view way_out;    ///< what to do with another format
  /// What follows "CREATE TABLE NAME" in every table of such a file, and the only index; empty: there is
  /// none.
  std::array<std::string_view, 2> columns;
  std::string_view index;
};

/// Refuses, before SQLite opens it, what is no SQLite file, or is cut short.
Result<void> check_file(const std::string& path, const FileKind& kind);
/// Whether something is there that no program of ours has made under such a name: a folder, or a file of
/// another kind. A file that a crash left without content is none.
bool is_foreign(const std::string& path, const FileKind& kind);
/// Whether what was written last may be missing: the file was in use when it was copied, or its program
/// ended, and the log that belongs beside it is not there. Not of a file that says that it is of another
/// kind. To be asked before SQLite opens it.
bool lacks_log(const std::string& path, const FileKind& kind);
/// Appended to what is wrong with such a file.
std::string missing_log_hint(const std::string& path);
/// Refuses another kind of file, another format, and a file that holds more than tables and the index of its
/// kind: SQL of others, such as triggers and views, would run whenever the file is read or written.
Result<void> check_format(Database& database, const FileKind& kind);
/// Refuses a file whose pages are damaged: SQLite looks at all of them.
Result<void> check_pages(Database& database);

}  // namespace scree
