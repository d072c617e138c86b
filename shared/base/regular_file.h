// Files that a command line names. A pipe may never end, and a device may do anything.
#pragma once

#include <cstddef>
#include <string>

#include "shared/base/result.h"

namespace scree {

/// Refuses a place with something else than a file (or a link to one), and one with nothing. The error does
/// not name the place. Opens nothing.
Result<void> check_is_file(const std::string& path);

/// The same of a file of at most so many bytes. The error names the place.
Result<void> check_is_small_file(const std::string& path, size_t bytes_max);

/// All bytes of a file; of one with more than `bytes_max` the first bytes_max + 1, so that it is seen to be
/// too long. The error does not name the place.
Result<std::string> read_bytes_of(const std::string& path, size_t bytes_max);

/// As check_is_file(), but a place with nothing is left to the open that follows. The error names the place.
Result<void> check_no_device(const std::string& path);

}  // namespace scree
