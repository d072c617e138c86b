// The filter of system calls of a process that reads a foreign file. Internal to import/process.
#pragma once

#include "shared/base/result.h"

namespace scree {

bool has_filters();

/// From now on, no sockets, no programs, no processes, no signals to others, and no file opened for writing:
/// such calls fail with EACCES. Threads may start. Does nothing where the kernel has no filters.
Result<void> filter_system_calls();

}  // namespace scree
