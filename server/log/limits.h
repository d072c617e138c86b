// Bounds of what is kept of the log in memory.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Bytes of the lines that administrators may read again. Above: the oldest go.
inline constexpr size_t recent_bytes_max = 65'536;

/// Bytes of one message among them. Above: it is cut.
inline constexpr size_t recent_message_bytes_max = 2'000;

}  // namespace scree::limits
