// Files that these tools write.
#pragma once

#include <string>
#include <string_view>

#include "shared/base/result.h"

namespace scree {

enum class Existing { refused, replaced };

/// Writes a file and makes its folder where there is none.
Result<void> write_new_file(const std::string& path, std::string_view text, Existing existing);

}  // namespace scree
