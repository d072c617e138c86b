// Files that their owner alone may read: they have names of persons, and keys. Any thread.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// From now on. The file is there.
Result<void> let_owner_alone_read(const std::string& path);

}  // namespace scree
