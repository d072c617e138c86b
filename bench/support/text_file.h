// Text files of benches and studies.
#pragma once

#include <filesystem>
#include <string>

#include "shared/base/result.h"

namespace scree {

/// Replaces the file; makes its folder where there is none.
Result<void> write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace scree
