// Which options of scree-import are of use for which forms of files: others are refused, not ignored.
#pragma once

#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

/// Refuses an option that is of no use for any of the files; its name with "--". Options that are not in the
/// table are for all files.
Result<void> check_options_fit(const std::vector<std::string>& given, const std::vector<std::string>& files);

}  // namespace scree
