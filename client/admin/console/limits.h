// Bounds of what a person types. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Bytes of a line. Above: it is refused, and not kept.
inline constexpr size_t typed_line_bytes_max = 4096;

/// Lines that are kept for later. Above: the oldest are forgotten.
inline constexpr size_t typed_lines_kept = 1000;

/// Bytes of the file that keeps them. Above: it is no such file, and is left alone.
inline constexpr size_t typed_file_bytes_max = 2 * (typed_lines_kept + 1) * typed_line_bytes_max;

}  // namespace scree::limits
