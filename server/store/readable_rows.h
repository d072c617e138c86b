// What can still be read of a damaged file: SQLite gives up a table at the first page that is not sound, but
// finds rows behind it by their keys.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "server/store/database.h"

namespace scree {

/// Takes what is lost: no row with a key from `first` to `last` can be read, and why not.
using LoseRows = std::function<void(uint64_t first, uint64_t last, const std::string& why)>;

/// Calls `visit` for each row that can be read, ordered by key. `select_from` selects (key, data, checksum)
/// of the rows from the key ?1 on, ordered by key. Errors of `visit` end it.
Result<void> each_readable(Database& database, const std::string& select_from,
                           const Database::RowVisitor& visit, const LoseRows& lose);

/// Copies an SQLite file and the log beside it; what is cut off its end is filled with zeros, so that SQLite
/// opens it. The log must not be written meanwhile.
Result<void> copy_for_reading(const std::string& path, const std::string& to);

}  // namespace scree
