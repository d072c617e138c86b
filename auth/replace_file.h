// Small files that a server writes anew, whole: bans, secrets.
#pragma once

#include <string>
#include <string_view>

#include "shared/base/result.h"

namespace scree {

/// Puts a file with this text in the place of the file that is there, if any. It is written beside it as
/// PATH.new, on the disk, then renamed, so that one of the two is whole whatever happens. It has the access
/// rights of the former one; without one, `mode`. Follows no links, and leaves a device or a pipe alone.
Result<void> replace_file(const std::string& path, std::string_view text, unsigned mode);

}  // namespace scree
