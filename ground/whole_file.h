// Files that are there whole or not at all.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "shared/base/result.h"

namespace scree {

/// Calls write(unfinished) with the name of a file beside `path`, which becomes it when all went well and is
/// removed otherwise. Returns the file's bytes. The error names `path`, and says why.
Result<uint64_t> write_whole(const std::string& path,
                             const std::function<Result<void>(const std::string& unfinished)>& write);

}  // namespace scree
