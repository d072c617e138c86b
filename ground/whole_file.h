// Files that are there whole or not at all.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "shared/base/result.h"

namespace scree {

/// The name beside `path` under which this process writes it before it is whole.
std::string unfinished_name(const std::string& path);

/// Calls write(unfinished_name(path)); that file becomes `path` when all went well and is removed otherwise.
/// Returns the file's bytes. The error names `path`, and says why.
Result<uint64_t> write_whole(const std::string& path,
                             const std::function<Result<void>(const std::string& unfinished)>& write);

}  // namespace scree
