// Bounds of files that people edit. Beyond each, a file is refused with the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Bytes of a palette's file: 255 materials with a kibibyte each.
inline constexpr size_t palette_file_bytes_max = size_t{256} << 10;

/// Bytes of one line of it. A line may nest tables by dots, each a frame of the stack when the parsed file
/// goes.
inline constexpr size_t palette_line_bytes_max = 500;

/// Models that a folder may have, and their bytes in all, which the server keeps in memory. Above: refused.
inline constexpr size_t models_max = 256;
inline constexpr size_t models_bytes_max = size_t{64} << 20;

/// Bytes of an image's path.
inline constexpr size_t image_path_bytes_max = 200;

}  // namespace scree::limits
