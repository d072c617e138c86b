// Small text files that people write and edit.
#pragma once

#include <cstddef>
#include <string>

#include "shared/base/result.h"

namespace scree {

/// The whole file. Refuses one over limits::text_file_bytes_max; the error names the file.
Result<std::string> read_text(const std::string& file);

/// Writes a temporary file and renames it, so that no reader gets half of it. Makes the folder if it is
/// missing.
Result<void> write_text(const std::string& file, const std::string& text);

}  // namespace scree
