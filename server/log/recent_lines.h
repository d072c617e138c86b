// The newest lines of this process's log, for administrators who ask. From any thread.
#pragma once

#include <string>
#include <vector>

namespace scree {

/// As JSON (log_config.h), the oldest first; together at most limits::recent_bytes_max. Long messages are
/// cut. None before begin_log().
std::vector<std::string> recent_lines();

}  // namespace scree
