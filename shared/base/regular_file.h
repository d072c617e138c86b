// Files that a command line names. A pipe may never end, and a device may do anything.
#pragma once

#include <string>
#include <string_view>

#include "shared/base/result.h"

namespace scree {

/// Refuses a place with something else than a file (or a link to one), and one with nothing. The error does
/// not name the place. Opens nothing.
Result<void> check_is_file(const std::string& path);

/// The same of a file of at most so many bytes. The error names the place.
Result<void> check_is_small_file(const std::string& path, size_t bytes_max);

/// As check_is_file(), but a place with nothing is left to the open that follows. The error names the place.
Result<void> check_no_device(const std::string& path);

/// Puts a file with this text in the place of the one that is there, if any, which has to be a file: written
/// beside it as PATH.new, on the disk, then renamed, so that one of the two is whole whatever happens. It has
/// the access rights of the former one. Follows no links.
Result<void> replace_file(const std::string& path, std::string_view text);

}  // namespace scree
