// Bounds of ground files. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Decoded tiles that a file keeps in memory: 32 MiB. Above: the one used longest ago is read again when it
/// is needed.
inline constexpr size_t file_tiles_cached_max = 512;

/// Ground files in a folder that are looked at for a world's ground: a look reads 128 bytes. Above: the rest
/// of the folder is not looked at.
inline constexpr size_t ground_files_max = 1000;

/// Decoded chunks that a file keeps in memory: 32 MiB at most. Above: as above.
inline constexpr size_t file_chunks_cached_max = 1024;

/// Chunks that a file stores: a world's surface of 2 km by 2 km, and its index fits 128 MiB. Above: refused.
inline constexpr size_t file_chunks_max = size_t{1} << 20;

}  // namespace scree::limits
